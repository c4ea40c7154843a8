// Two boxes: separating axes and face clipping.
//
// The gap is the largest separation over the 15 axes of the pair: exact when they overlap (minimal
// parting translation, to kEdgeAdvantage) or when a face or an edge pair is nearest. Where it is
// not, corners near corners, gjk decides. Face axes win ties, so that stacked faces keep face
// normals. Source: Gottschalk, Lin, Manocha, OBBTree (1996); clipping: Sutherland, Hodgman (1974).

#pragma once

#include "poinsot/collision/manifold.h"

namespace poinsot {

// An edge axis must part the boxes by this much more than the best face, relative to the smaller.
inline constexpr double kEdgeAdvantage = 1e-6;

// In A's frame. Both colliders are boxes. False, with the manifold empty, when boxes within the
// margin are nearest at neither a face nor an edge pair: the general kernel then has to find out.
bool box_box(const ConvexPair& pair, double margin, Manifold& manifold);

}  // namespace poinsot
