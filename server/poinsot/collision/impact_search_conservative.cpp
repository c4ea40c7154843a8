// Conservative advancement along nested separating axes.
//
// Along its axis the pair is advanced by times in which the second-order bound (axis_bound.h)
// proves the gap open; when little is left of the gap, the narrow phase gives a new axis. Because
// the gap along any axis is a lower bound of the distance, no root is passed on the way; because
// the bound is exact to second order, the last steps to a root converge quadratically.
//
// Source: lesson "Rigid Body Dynamics", slide "One-Side Approach"; Mirtich 1996.

#include <algorithm>

#include "poinsot/collision/axis_turn.h"
#include "poinsot/collision/touching_pair.h"

namespace poinsot {
namespace {

constexpr double kNear = 0.5;    // [-] gaps below this, of the smaller shape, are closed turning
constexpr double kSpent = 0.25;  // [-] of the gap an axis began with: a new one is asked for

// A time in which the gap provably stays open, and how the axis turns meanwhile.
struct Clear {
  double x;  // [s]
  Vec3 turn;
};

Clear clear_for(const PairMotion& motion, const NearestAxis& axis, bool is_near, double most) {
  const double balls = motion.balls_apart_until(most);
  if (balls >= most) return {most, Vec3::Zero()};
  Clear best{std::max(balls, motion.bound_along(axis.n).clear_until(most)), Vec3::Zero()};
  if (!is_near || best.x >= most) return best;
  const Vec3 turn = axis_turn(motion, axis.n);
  if (turn == Vec3::Zero()) return best;
  const double proven = turning_for(motion, turn, most);
  const double x = motion.bound_turning(axis.n, turn, proven).clear_until(proven);
  return x > best.x ? Clear{x, turn} : best;
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
    const bool is_near = axis.gap == began && axis.gap <= kNear * motion.size();
    const Clear clear = clear_for(motion, axis, is_near, left);
    if (clear.x >= left) {
      result = no_meeting(span.to);
    } else {
      motion.go_to(std::min(span.to, motion.next_time(clear.x)));
      axis.n = first_axis(motion, turned_axis(axis.n, clear.turn, clear.x));
      axis.gap = motion.gap_along(axis.n);
    }
  }
  remember(motion, axis.n, memory);
  return result ? *result : meeting_at(motion, axis, Meeting::unsure);
}

}  // namespace poinsot
