// The boxes that bodies cannot leave: all that a body can reach until some time.
//
// In flight the centre of mass keeps to its parabola, and no point is farther from it than the
// body's arm, nor turned by more than the bound of |ω| allows: a box holds for as long as the
// flight, and is made for several frames at once. What acts on a body, or may strike it, is bounded
// by speeds (motion_bound.h).

#pragma once

#include "poinsot/collision/collision_state.h"

namespace poinsot {

// All that a collider of a body can reach from `from`, at which the body's state is, to `to`, on
// its own: without impacts or contacts.
Aabb reach_box(CollisionState& state, const Collider& collider, double from, double to);

// Speed of the fastest point of a body now, and what gravity and pushes add until `duration` has
// passed [m/s].
double fastest_point(const CollisionState& state, Eigen::Index i, double duration);

// Until when a box for body i is worth making: the longer it lasts the larger it grows [s].
double worthwhile(const CollisionState& state, Eigen::Index i, double from, double to);

}  // namespace poinsot
