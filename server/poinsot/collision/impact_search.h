// Impact searches: when do two shapes meet, each on its own course?
//
// A search looks for the first root of the gap of a pair in (from, to]. It is one of a closed set,
// chosen in the scene (strategies.h), each in its own file:
//
//   conservative  one-sided: advances by times in which the gap provably cannot close. It never
//                 passes a root and never penetrates.
//   backtracking  tests poses a quarter radian or half a size apart and goes back from the first
//                 that overlaps, by the gap's rate. It misses what happens between two of them.
//   continuous    swept bounds of stretches of the motion, halved until they are apart or the pair
//                 overlaps; then back up to the root. It misses nothing deeper than `touch`.
//
// README.md, section "Impact search", says why the first never misses, and what each costs.
//
// The contract of all three:
//   Pairs farther apart than `touch` are followed until the gap has a root with the pair
//   approaching: `Meeting::impact`, with |gap| at rounding and a later time than `from`.
//   Pairs that start within `touch` and approach meet at once, at `from`. Those that start within
//   it and part are followed on; those that come back without having been out of `touch` are
//   pressed together, `Meeting::resting` at `from`: contacts that last. Those that stay in touch
//   with nothing to press them meet nothing.
//   A pass that comes close without a root is no impact.

#pragma once

#include <cstdint>

#include "poinsot/collision/collider.h"
#include "poinsot/simulation/course.h"

namespace poinsot {

// Work of one call: what is left then is `unsure`.
inline constexpr std::uint64_t kMostPoses = 2000;

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
