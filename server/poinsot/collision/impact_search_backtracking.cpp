// Backtracking: test the pair at the end of a short stretch; if it overlaps there, go back to the
// impact. Source: lesson "Rigid Body Dynamics", slides "Backtracking Approach".

#include <algorithm>

#include "poinsot/collision/back_up.h"
#include "poinsot/collision/touching_pair.h"

namespace poinsot {
namespace {

constexpr double kTurn = 0.25;   // [rad] between two poses
constexpr double kTravel = 0.5;  // [-] of the smaller shape

// [s] from the time gone to; at most `most`, and no less than what `gap` [m] allows.
double stretch(const PairMotion& motion, double gap, double most) {
  const double free = gap / motion.closing(most);
  if (free >= most) return most;
  const double travel = kTravel * motion.size();
  if (most * motion.turning() > kTurn) most = kTurn / motion.turning();
  if (most * motion.closing(0) > travel) most = travel / motion.closing(0);
  if (most * motion.closing(most) > travel) most = travel / motion.closing(most);
  return std::max(most, free);
}

}  // namespace

SearchResult search_backtracking(const CoursePair& pair, const SearchSpan& span,
                                 SearchMemory& memory, SearchWork& work) {
  PairMotion motion(pair, work);
  const std::uint64_t most_poses = work.poses + kMostPoses;
  NearestAxis axis;
  auto result = start_search(motion, axis, span, memory);
  while (!result && motion.time() < span.to && work.poses < most_poses) {
    const double apart = motion.time();
    motion.go_to(std::min(span.to, motion.next_time(stretch(motion, axis.gap, span.to - apart))));
    axis.n = first_axis(motion, axis.n);
    axis.gap = motion.gap_along(axis.n);
    if (axis.gap <= 0) axis = nearest_axis(motion, axis.n);
    if (axis.gap > 0) continue;
    axis = back_up(motion, apart, motion.time(), axis);
    result = meeting_at(motion, axis, Meeting::impact);
  }
  remember(motion, axis.n, memory);
  if (result) return *result;
  return motion.time() < span.to ? meeting_at(motion, axis, Meeting::unsure) : no_meeting(span.to);
}

}  // namespace poinsot
