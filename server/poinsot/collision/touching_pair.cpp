#include "poinsot/collision/touching_pair.h"

#include <algorithm>

#include "poinsot/collision/axis_turn.h"

namespace poinsot {
namespace {

constexpr int kSteps = 64;

}  // namespace

Touching follow_touching(PairMotion& motion, NearestAxis& axis, double to, double touch) {
  const double floor = std::min(axis.gap, 0.0) - touch;
  for (int step = 0; step < kSteps; ++step) {
    if (gap_rate(motion, axis) < -motion.rate_rounding())
      return step == 0 ? Touching::approaches : Touching::pressed;
    const double most = to - motion.time();
    const Vec3 turn = axis_turn(motion, axis.n);
    const double proven = turning_for(motion, turn, most);
    const AxisBound bound = turn == Vec3::Zero() ? motion.bound_along(axis.n)
                                                 : motion.bound_turning(axis.n, turn, proven);
    const double out = bound.leaves(touch, proven);
    const double x = out > 0 ? out : bound.above_until(floor, proven);
    if (out == 0 && x >= most) return Touching::stays;
    motion.go_to(std::min(to, motion.next_time(x)));
    axis.n = turned_axis(axis.n, turn, x);
    axis.gap = motion.gap_along(axis.n);
    if (out > 0) return Touching::leaves;
    axis = nearest_axis(motion, axis.n);
    if (axis.gap > touch) return Touching::leaves;
  }
  return Touching::pressed;
}

SearchResult meeting_at(const PairMotion& motion, const NearestAxis& axis, Meeting meeting) {
  const double side = motion.is_swapped() ? -1 : 1;
  return {meeting, motion.time(), side * axis.n, axis.middle};
}

SearchResult no_meeting(double to) {
  return {Meeting::none, to, Vec3::Zero(), Vec3::Zero()};
}

std::optional<SearchResult> start_search(PairMotion& motion, NearestAxis& axis,
                                         const SearchSpan& span, const SearchMemory& memory) {
  motion.go_to(span.from);
  const double side = motion.is_swapped() ? -1 : 1;
  axis.n = first_axis(motion, side * memory.axis);
  axis.gap = motion.gap_along(axis.n);
  if (axis.gap > span.touch) return std::nullopt;
  axis = nearest_axis(motion, axis.n);
  if (axis.gap > span.touch) return std::nullopt;
  const NearestAxis start = axis;
  switch (follow_touching(motion, axis, span.to, span.touch)) {
    case Touching::approaches:
      return meeting_at(motion, axis, Meeting::impact);
    case Touching::leaves:
      return std::nullopt;
    case Touching::stays:  // overlapping bodies have to be pushed apart
      if (start.gap < -span.touch) break;
      return no_meeting(span.to);
    case Touching::pressed:
      break;
  }
  motion.go_to(span.from);
  return meeting_at(motion, start, Meeting::resting);
}

void remember(const PairMotion& motion, const Vec3& n, SearchMemory& memory) {
  memory.axis = motion.is_swapped() ? Vec3(-n) : n;
}

}  // namespace poinsot
