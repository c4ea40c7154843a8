// How a point of contact moves while its bodies do: which of its parts are fixed to which body.
//
// Corners stay where they are on their bodies, and the normal is that of a face of one of them, or
// of two edges. What round surfaces touch with rolls along.

#pragma once

#include "poinsot/collision/collision_state.h"

namespace poinsot {

struct PointMotion {
  bool is_round_a = false, is_round_b = false;
  // [-] of the angular velocity of a, and of b, that the normal turns with.
  double turns_a = 0, turns_b = 0;
};

PointMotion motion_of(const CollisionState& state, const PairRecord& record, const PairPoint& p);

}  // namespace poinsot
