// Penetration of two convex cores that touch or overlap: the shortest translation that parts them.
//
// EPA grows a polytope inside the Minkowski difference A − B from where GJK ended, always at the
// face nearest the origin. The distance of that face bounds the depth from below, the support plane
// along its normal from above; it stops when the two meet to `kEpaGap` of the scale (flat shapes:
// exactly) or at `kEpaFaces`, and returns the upper bound, which is a valid parting translation.
//
// Source: van den Bergen 2001, "Proximity Queries and Penetration Depth Computation".

#pragma once

#include "poinsot/collision/gjk.h"

namespace poinsot {

inline constexpr double kEpaGap = 1e-9;  // [-] upper − lower bound, relative to the scale
inline constexpr int kEpaFaces = 512;

struct Penetration {
  double depth = 0;  // [m] ≥ 0, upper bound
  double lower = 0;  // [m] lower bound
  Vec3 normal;       // unit, from B to A, in A's frame: moving A by depth·normal parts them
  Vec3 on_a, on_b;   // [m] deepest points, in A's frame
};

// `ended` is the result of gjk() with separated == false.
Penetration penetration(const ConvexPair& pair, const GjkResult& ended);

}  // namespace poinsot
