// Closed forms of FCL behind the wall: a sphere against a sphere, box, capsule or cylinder.
//
// These are exact to rounding and cost 30 to 60 ns. Everything else that FCL offers for contacts is
// inexact, incomplete or aborts, and has kernels of our own (pair_table.h).

#pragma once

#include "poinsot/collision/manifold.h"

namespace poinsot {

// The nearest point of `other` to the sphere's centre if the gap is below the margin; in W, normal
// from `other` to the sphere.
void sphere_contact_fcl(const Collider& sphere, const Pose& pose, const Collider& other,
                        const Pose& pose_other, double margin, Manifold& manifold);

}  // namespace poinsot
