// The wall: what the collision layer asks about two shapes. No FCL type crosses it.
//
// Poses that come in are finite and unit (the simulation layer sees to that). Should one not be, or
// the shapes be farther apart than a distance can be squared, nothing is known: no points, and a
// gap between −∞ and +∞. Supported pairs are in pair_table.h: all but those of half-spaces and
// meshes among themselves, whose bodies no force moves, so that they never meet.

#pragma once

#include <vector>

#include "poinsot/collision/manifold.h"

namespace poinsot {

// Points nearer than `margin` [m], in W, normal from b to a. Empty when there are none. Symmetric:
// exchanging a and b gives the same points and the opposite normal, bit for bit.
void find_manifold(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                   double margin, Manifold& manifold);

// The same for pairs that may touch along several planes, as with a mesh: one manifold for each,
// the deepest first; replaces `manifolds`.
void find_manifolds(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    double margin, std::vector<Manifold>& manifolds);

// Signed distance of two shapes with a certificate: lower ≤ true gap ≤ value, up to the rounding of
// the coordinates. Both bounds can be checked without trust: the points lie on the surfaces, and
// the slab between the supports along the normal is `lower` wide, which also holds for penetrating
// shapes. A mesh is not convex and has no such slab; where it is penetrated, both bounds are the
// depth that mesh_pairs.h defines.
struct Gap {
  double value = 0;             // [m] upper bound; negative: penetration depth
  double lower = 0;             // [m] lower bound of the true gap
  Vec3 normal = Vec3::UnitZ();  // unit, in W, from b to a: the direction that proves `lower`
  Vec3 point_a = Vec3::Zero();  // [m] in W: the nearest (deepest) points of the surfaces
  Vec3 point_b = Vec3::Zero();
};

// What a pair may keep from query to query: the direction to try first. It changes the time a query
// takes and the last bits of its answer, never the bounds' truth.
struct GapHint {
  Vec3 axis = Vec3::Zero();  // unit, in W, from b to a
  bool valid = false;
};

// Symmetric as find_manifold() is. `hint` is read if valid, and updated.
Gap find_gap(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
             GapHint* hint = nullptr);

}  // namespace poinsot
