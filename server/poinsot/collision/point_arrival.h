// When a point of a pair that touches elsewhere arrives: a rocking block's next corner.

#pragma once

#include <algorithm>
#include <vector>

#include "poinsot/collision/manifold.h"
#include "poinsot/collision/pair_store.h"

namespace poinsot {

// The gap [m] of the point of the pair's manifold that is, seen from either body, where `point`
// was; infinite if the shapes are far apart. `manifolds` is scratch.
double gap_of_point(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    const PairPoint& point, std::vector<Manifold>& manifolds);

// Where a function that starts at `value` > 0 comes down to zero, by false position (Illinois);
// `to` if it is still positive there.
template <class Function>
double first_zero(const Function& f, double from, double value, double to) {
  constexpr int kMost = 60;
  double a = from, fa = value, b = to, fb = f(to);
  if (!(fb < 0)) return to;
  for (int k = 0; k < kMost; ++k) {
    const double x = std::clamp((a * fb - b * fa) / (fb - fa), a, b);
    if (x <= a || x >= b) break;
    const double fx = f(x);
    if (fx >= 0) {
      a = x;
      fa = fx;
      fb *= 0.5;
      if (fx <= 1e-15 * value) break;
    } else {
      b = x;
      fb = fx;
      fa *= 0.5;
    }
  }
  return a;
}

}  // namespace poinsot
