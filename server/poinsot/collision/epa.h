// Penetration of two convex cores that touch or overlap: the shortest translation that parts them.
//
// EPA grows a polytope inside the Minkowski difference A − B from where GJK ended, always at the
// face nearest the origin. The distance of that face bounds the depth from below, the support plane
// along its normal from above; it stops when the two meet to `kEpaGap` of the smaller body (flat
// faces: to rounding) or at `kEpaFaces`, and returns the upper bound, which is a valid parting
// translation. Cores that touch without a volume between them, such as crossed segments, part
// across their common plane or line, with depth 0.
//
// Source: van den Bergen 2001, "Proximity Queries and Penetration Depth Computation".

#pragma once

#include "poinsot/collision/gjk.h"

namespace poinsot {

inline constexpr double kEpaGap = 1e-9;   // [-] upper − lower bound, of the smaller radius
inline constexpr double kEpaFlat = 1e-9;  // [-] thinner differences, likewise, have no volume
inline constexpr int kEpaFaces = 512;

struct Penetration {
  double depth = 0;  // [m] upper bound; below 0 by no more than gjk's touch where they barely part
  double lower = 0;  // [m] lower bound
  Vec3 normal;       // unit, from B to A, in A's frame: moving A by depth·normal parts them
  Vec3 on_a, on_b;   // [m] deepest points, in A's frame
};

// `ended` is the result of gjk() with separated == false. `accuracy`: upper − lower bound of the
// smaller radius; when coarse, the depth returned is still a least one to rounding, but another one
// that is shallower by up to `accuracy` may have been missed.
Penetration penetration(const ConvexPair& pair, const GjkResult& ended, double accuracy = kEpaGap);

}  // namespace poinsot
