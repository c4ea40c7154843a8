// Conservative advancement along nested separating axes.
//
// Along its axis the pair is advanced by times in which the second-order bound (axis_bound.h)
// proves the gap open; when little is left of the gap, the narrow phase gives a new axis. Because
// the gap along any axis is a lower bound of the distance, no root is passed on the way; because
// the bound is exact to second order, the last steps to a root converge quadratically.
//
// Source: lesson "Rigid Body Dynamics", slide "One-Side Approach"; Mirtich 1996.

#include <algorithm>

#include "poinsot/collision/touching_pair.h"

namespace poinsot {
namespace {

constexpr double kSpent = 0.25;  // [-] of the gap an axis began with: a new one is asked for

// [s] from the time gone to in which the gap provably stays open; at most `most`.
double clear_for(const PairMotion& motion, const Vec3& n, double most) {
  const double balls = motion.balls_apart_until(most);
  return balls >= most ? balls : std::max(balls, motion.bound_along(n).clear_until(most));
}

}  // namespace

SearchResult search_conservative(const CoursePair& pair, const SearchSpan& span,
                                 SearchMemory& memory, SearchWork& work) {
  PairMotion motion(pair, work);
  const std::uint64_t most_poses = work.poses + kMostPoses;
  NearestAxis axis;
  auto result = start_search(motion, axis, span, memory);
  double began = axis.gap;  // [m] with this axis
  while (!result && work.poses < most_poses) {
    if (axis.gap <= std::max(kSpent * began, motion.rounding())) {
      axis = nearest_axis(motion, axis.n);
      began = axis.gap;
    }
    if (axis.gap <= motion.rounding()) {
      const Touching touching = follow_touching(motion, axis, span.to, span.touch);
      began = axis.gap;
      if (touching == Touching::stays)
        result = no_meeting(span.to);
      else if (touching != Touching::leaves)
        result = meeting_at(motion, axis, Meeting::impact);
      continue;
    }
    const double left = span.to - motion.time();
    const double x = clear_for(motion, axis.n, left);
    if (x >= left) {
      result = no_meeting(span.to);
    } else {
      motion.go_to(std::min(span.to, motion.next_time(x)));
      axis.n = first_axis(motion, axis.n);
      axis.gap = motion.gap_along(axis.n);
    }
  }
  remember(motion, axis.n, memory);
  return result ? *result : meeting_at(motion, axis, Meeting::unsure);
}

}  // namespace poinsot
