// The last digits of a distance: Newton's method on the two surface features that face each other.
//
// The separation of the supports along a unit normal n is stationary where the points of two
// features, a corner, an edge, a face, a rim, the side of a cylinder or of a cone, an ellipsoid,
// lie opposite each other along n. Unknown are n (two angles) and the places along straight
// features (none to two per shape, each with the condition that n is perpendicular to it). The
// curvature of the supports makes the equations well conditioned however near the surfaces are,
// touching and penetrating included, where a simplex of gjk or a face of epa degenerates. Which
// features face each other is guessed from where gjk or epa ended and mended on the way; whether
// the result is right is not assumed but shown by its bounds.
//
// Source: Newton's method with an active set: Nocedal, Wright, Numerical Optimization (2006),
// ch. 16.

#pragma once

#include "poinsot/collision/gjk.h"

namespace poinsot {

inline constexpr int kPolishIterations = 16;

// From where a search ended: its normal and the points whose blend is nearest. Settled when the
// bounds meet to `tolerance` [m].
Polished polish(const ConvexPair& pair, const Vec3& normal, const Blend& blend, double tolerance);

}  // namespace poinsot
