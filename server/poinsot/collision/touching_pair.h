// Pairs that touch: what becomes of them. The rule that all impact searches share.
//
// Within `touch` of each other, a pair that approaches meets. Any other is followed by times in
// which it provably does not sink by more than `touch`, until it is out of touch, or approaches
// after all, without having been out: then it is pressed together.

#pragma once

#include <optional>

#include "poinsot/collision/nearest_axis.h"

namespace poinsot {

enum class Touching : std::uint8_t {
  approaches,  // now
  leaves,      // is out of touch at the time gone to
  stays,       // in touch until the end, without being pressed
  pressed,     // comes back without having been out of touch
};

// From the time gone to, at which the pair is in touch along its nearest axis.
Touching follow_touching(PairMotion& motion, NearestAxis& axis, double to, double touch);

// The result of a search that ends at the time gone to.
SearchResult meeting_at(const PairMotion& motion, const NearestAxis& axis, Meeting meeting);

// The result of one in which nothing happens until `to` [s].
SearchResult no_meeting(double to);

// What is known at the start of a search: a result, if there is one already. Else the pair is out
// of touch at the time gone to, along `axis`.
std::optional<SearchResult> start_search(PairMotion& motion, NearestAxis& axis,
                                         const SearchSpan& span, const SearchMemory& memory);

// Axis kept for the next call.
void remember(const PairMotion& motion, const Vec3& n, SearchMemory& memory);

}  // namespace poinsot
