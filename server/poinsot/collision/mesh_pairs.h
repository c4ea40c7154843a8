// A convex shape against a triangle mesh. Private to the collision layer's narrow phase.
//
// A mesh is a surface; its outside is where its triangles' normals point. A body that is wholly on
// one side of it is stopped there, whichever side that is: gaps of bodies apart are exact distances
// from both. A body through the surface is pushed to the outside, unless all but a thousandth of it
// is behind: then back to where it came from. A body wholly inside of a closed mesh is apart from
// it.
//
// Depths are those of single triangles, each along the best of the directions that the surface
// there can push in: its normal, those across its ridges, or between them.

#pragma once

#include <vector>

#include "poinsot/collision/manifold.h"
#include "poinsot/collision/proximity.h"

namespace poinsot {

// b is a mesh or one of its triangles. In W.
Gap gap_to_mesh(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b);

// The manifolds of points nearer than `margin` [m], one for each normal, the deepest first; at most
// kMaxMeshManifolds. Replaces `out`. In W.
inline constexpr std::size_t kMaxMeshManifolds = 16;
void mesh_manifolds(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    double margin, std::vector<Manifold>& out);

// The triangles of a mesh collider whose boxes overlap the box [m] in W, sorted; grows `out` only.
// Such a triangle is a convex shape for the functions of proximity.h, at the pose of its mesh.
void triangles_near(const Collider& mesh, const Pose& pose, const Aabb& box_W,
                    std::vector<int>& out);
Collider triangle_collider(const Collider& mesh, int triangle);  // does not allocate

}  // namespace poinsot
