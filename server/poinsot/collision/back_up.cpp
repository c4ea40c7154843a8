#include "poinsot/collision/back_up.h"

#include <cmath>
#include <limits>

#include "poinsot/collision/axis_turn.h"

namespace poinsot {
namespace {

constexpr int kSteps = 100;
// Normals of crossed edges are known to about this, and so is the gap between them [-], of the
// smaller shape: a gap this small that no longer shrinks is a root.
constexpr double kKnown = 1e-12;

}  // namespace

NearestAxis back_up(PairMotion& motion, double apart, double overlaps, const NearestAxis& axis) {
  NearestAxis now = axis;
  double t = overlaps, last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kSteps; ++step) {
    motion.go_to(t);
    now = nearest_axis(motion, now.n);
    const double size = std::abs(now.gap);
    const bool shrinks = size <= 0.5 * last;
    last = size;
    if (size <= motion.rounding() || (!shrinks && size <= kKnown * motion.size())) return now;
    (now.gap > 0 ? apart : overlaps) = t;
    const double middle = apart + 0.5 * (overlaps - apart);
    if (middle <= apart || middle >= overlaps) break;
    const double rate = gap_rate(motion, now);
    const double newton = t - now.gap / rate;
    const bool trusted = shrinks && rate < 0 && newton > apart && newton < overlaps;
    t = trusted ? newton : middle;
    if (!trusted) last = std::numeric_limits<double>::infinity();
  }
  motion.go_to(apart);
  return nearest_axis(motion, now.n);
}

}  // namespace poinsot
