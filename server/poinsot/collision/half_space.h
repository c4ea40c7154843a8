// Any convex shape against a half-space: closed forms.
//
// The gap of a point is its height above the plane, exact. The facing face, cap or edge contributes
// its corners within the margin, and the deepest point is always among them.

#pragma once

#include "poinsot/collision/manifold.h"

namespace poinsot {

// Normal from the half-space to the shape; in the shape's frame S. `plane_normal`, `plane_offset`
// are those of the half-space in S.
void shape_on_half_space(const Collider& shape, const Vec3& plane_normal, double plane_offset,
                         double margin, Manifold& manifold);

}  // namespace poinsot
