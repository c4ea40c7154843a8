// Impact searches: when do two shapes meet, each on its own course?
//
// A search looks for the first root of the gap of a pair in (from, to]. It is one of a closed set,
// chosen in the scene (strategies.h), each in its own file:
//
//   conservative  one-sided: advances by times in which the gap provably cannot close. It never
//                 passes a root and never penetrates.
//   backtracking  tests the end and bisects back, then finds the root by the gap's rate; it sees
//                 only what samples at most kSampleTurn apart see.
//   continuous    swept bounds decide whether the pair can meet at all; if it does, the motion is
//                 backed up to the root.
//
// The contract of all three:
//   Pairs farther apart than `touch` are followed until the gap has a root with the pair
//   approaching: `Meeting::impact`, with |gap| at rounding and a later time than `from`.
//   Pairs that start within `touch` and approach meet at once, at `from`. Those that start within
//   it and part are followed on; those that neither approach nor get out of `touch` again, but are
//   pressed together, are `Meeting::resting` at `from`: contacts that last.
//   A pass that comes close without a root is no impact.

#pragma once

#include <cstdint>

#include "poinsot/collision/collider.h"
#include "poinsot/simulation/course.h"

namespace poinsot {

struct CoursePair {
  const Collider& a;
  const Course& course_a;
  const Collider& b;
  const Course& course_b;
};

struct SearchSpan {
  double from, to;  // [s]
  double touch;     // [m] gap below which the pair touches, > 0
};

// What a pair's search remembers from call to call: the axis along which it was last apart.
struct SearchMemory {
  Vec3 axis = Vec3::Zero();  // unit, in W, b → a; zero: none
};

enum class Meeting : std::uint8_t {
  none,     // no root until `to`
  impact,   // root at `time`
  resting,  // touching at `from`, and staying so
  unsure,   // the search gave up at `time`: no root before it (bounded work)
};

struct SearchResult {
  Meeting meeting = Meeting::none;
  double time = 0;             // [s] of the impact; `to` if none
  Vec3 normal = Vec3::Zero();  // unit, in W, b → a, at `time`; of impacts and resting pairs
  Vec3 point = Vec3::Zero();   // [m] in W, midway between the surfaces
};

// Work done, added up over calls.
struct SearchWork {
  std::uint64_t searches = 0;
  std::uint64_t poses = 0;  // evaluations of a pair's poses
  std::uint64_t gaps = 0;   // of those with a gap query of the narrow phase
};

SearchResult search_conservative(const CoursePair& pair, const SearchSpan& span,
                                 SearchMemory& memory, SearchWork& work);
SearchResult search_backtracking(const CoursePair& pair, const SearchSpan& span,
                                 SearchMemory& memory, SearchWork& work);
SearchResult search_continuous(const CoursePair& pair, const SearchSpan& span, SearchMemory& memory,
                               SearchWork& work);

}  // namespace poinsot
