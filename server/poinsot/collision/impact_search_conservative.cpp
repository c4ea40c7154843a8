// Conservative advancement along nested separating axes.
//
// Along its axis the pair is advanced by times in which the second-order bound (axis_bound.h)
// proves the gap open; when little is left of the gap, the narrow phase gives a new axis. Because
// the gap along any axis is a lower bound of the distance, no root is passed on the way; because
// the bound is exact to second order, the last steps to a root converge quadratically.

#include "poinsot/collision/touching_pair.h"

namespace poinsot {
namespace {

constexpr std::uint64_t kMostPoses = 2000;
constexpr double kSpent = 0.25;  // [-] of the gap an axis began with: a new one is asked for

}  // namespace

SearchResult search_conservative(const CoursePair& pair, const SearchSpan& span,
                                 SearchMemory& memory, SearchWork& work) {
  PairMotion motion(pair, work);
  const std::uint64_t most_poses = work.poses + kMostPoses;
  NearestAxis axis;
  if (const auto known = start_search(motion, axis, span, memory)) {
    remember(motion, axis.n, memory);
    return *known;
  }
  double began = axis.gap;
  while (work.poses < most_poses) {
    if (axis.gap <= kSpent * began || axis.gap <= motion.rounding()) {
      axis = nearest_axis(motion, axis.n);
      began = axis.gap;
    }
    if (axis.gap <= motion.rounding()) {
      remember(motion, axis.n, memory);
      switch (follow_touching(motion, axis, span.to, span.touch)) {
        case Touching::approaches:
        case Touching::pressed:
          return meeting_at(motion, axis, Meeting::impact);
        case Touching::stays:
          return {Meeting::none, span.to, Vec3::Zero(), Vec3::Zero()};
        case Touching::leaves:
          began = axis.gap;
          continue;
      }
    }
    const double left = span.to - motion.time();
    const double apart = motion.balls_apart_until(left);
    const double x =
        apart >= left ? apart : std::max(apart, motion.bound_along(axis.n).clear_until(left));
    if (x >= left) {
      remember(motion, axis.n, memory);
      return {Meeting::none, span.to, Vec3::Zero(), Vec3::Zero()};
    }
    motion.go_to(motion.next_time(x));
    axis.n = first_axis(motion, axis.n);
    axis.gap = motion.gap_along(axis.n);
  }
  remember(motion, axis.n, memory);
  return meeting_at(motion, axis, Meeting::unsure);
}

}  // namespace poinsot
