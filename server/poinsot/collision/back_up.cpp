#include "poinsot/collision/back_up.h"

#include <cmath>

namespace poinsot {
namespace {

constexpr int kSteps = 100;
constexpr int kNewtonPerBisection = 3;

}  // namespace

NearestAxis back_up(PairMotion& motion, double apart, double overlaps, const NearestAxis& axis) {
  NearestAxis now = axis;
  double t = overlaps;
  for (int step = 0; step < kSteps; ++step) {
    motion.go_to(t);
    now = nearest_axis(motion, now.n);
    if (std::abs(now.gap) <= motion.rounding()) return now;
    (now.gap > 0 ? apart : overlaps) = t;
    const double middle = apart + 0.5 * (overlaps - apart);
    if (middle <= apart || middle >= overlaps) break;
    const double rate = motion.bound_along(now.n).slope();
    const double newton = t - now.gap / rate;
    const bool bisect = step % (kNewtonPerBisection + 1) == kNewtonPerBisection;
    t = !bisect && rate < 0 && newton > apart && newton < overlaps ? newton : middle;
  }
  motion.go_to(apart);
  return nearest_axis(motion, now.n);
}

}  // namespace poinsot
