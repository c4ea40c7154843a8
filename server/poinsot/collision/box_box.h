// Two boxes: separating axes and face clipping.
//
// The gap is the largest separation over the 15 axes of the pair: exact when they overlap (minimal
// parting translation) or when a face or an edge pair is nearest, a lower bound otherwise. Face
// axes win ties, so that stacked faces keep face normals. Source: Gottschalk, Lin, Manocha, OBBTree
// (1996).

#pragma once

#include "poinsot/collision/manifold.h"

namespace poinsot {

// In A's frame. Both colliders are boxes.
void box_box(const ConvexPair& pair, double margin, Manifold& manifold);

}  // namespace poinsot
