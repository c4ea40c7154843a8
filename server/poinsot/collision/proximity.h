// The wall: what the collision layer asks about two shapes. No FCL type crosses it.
//
// Poses that come in are finite and unit (the simulation layer sees to that). Supported pairs are
// in pair_table.h; two half-spaces are the only pair that is not, and bodies that cannot move never
// meet.

#pragma once

#include "poinsot/collision/manifold.h"

namespace poinsot {

// Points nearer than `margin` [m], in W, normal from b to a. Empty when there are none. Symmetric:
// exchanging a and b gives the same points and the opposite normal, bit for bit.
void find_manifold(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                   double margin, Manifold& manifold);

// Signed distance of two shapes with a certificate.
struct Gap {
  double value = 0;  // [m] upper bound; negative: penetration depth
  double lower = 0;  // [m] lower bound of the true gap
};
Gap find_gap(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b);

}  // namespace poinsot
