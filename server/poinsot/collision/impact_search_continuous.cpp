// Continuous: whether the bounds of all the pair sweeps in a stretch of time meet; if they do, the
// stretch is halved, until they do not, or the pair overlaps at the end of a short one: then back
// up to the impact.

#include <algorithm>

#include "poinsot/collision/back_up.h"
#include "poinsot/collision/touching_pair.h"

namespace poinsot {
namespace {

constexpr double kShort = 1e-3;  // [-] travel in a stretch whose end is tested, of the smaller

// Whether the shapes stay apart within `half` [s] of the time gone to.
bool swept_apart(const PairMotion& motion, NearestAxis& axis, double half) {
  const auto apart = [&] { return axis.gap > half * motion.closing_along(axis.n, half); };
  axis.n = first_axis(motion, axis.n);
  axis.gap = motion.gap_along(axis.n);
  if (apart()) return true;
  if (motion.has_plane()) return false;
  const double travel = half * motion.closing(half);
  if (!bounds(motion.shape_a(), motion.pose_a())
           .grown(travel)
           .overlaps(bounds(motion.shape_b(), motion.pose_b())))
    return true;
  axis = nearest_axis(motion, axis.n);
  return apart();
}

}  // namespace

SearchResult search_continuous(const CoursePair& pair, const SearchSpan& span, SearchMemory& memory,
                               SearchWork& work) {
  PairMotion motion(pair, work);
  const std::uint64_t most_poses = work.poses + kMostPoses;
  NearestAxis axis;
  auto result = start_search(motion, axis, span, memory);
  double apart = motion.time();  // [s] until then nothing has happened
  double stretch = span.to - apart;
  while (!result && apart < span.to && work.poses < most_poses) {
    const double end = std::min(span.to, apart + stretch);
    const double half = 0.5 * (end - apart);
    motion.go_to(apart + half);
    if (swept_apart(motion, axis, half)) {
      apart = end;
      stretch *= 2;
      continue;
    }
    const double travel = 2 * half * motion.closing(half);
    stretch = half;
    if (travel > kShort * motion.size()) continue;
    motion.go_to(end);
    axis = nearest_axis(motion, axis.n);
    if (axis.gap <= 0) {
      axis = back_up(motion, apart, end, axis);
      result = meeting_at(motion, axis, Meeting::impact);
    } else if (travel <= span.touch) {
      apart = end;  // a pass without an overlap
    }
  }
  remember(motion, axis.n, memory);
  if (result) return *result;
  if (apart >= span.to) return no_meeting(span.to);
  motion.go_to(apart);
  return meeting_at(motion, axis, Meeting::unsure);
}

}  // namespace poinsot
