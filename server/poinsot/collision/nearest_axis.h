// The axis along which the shapes of a pair are farthest apart, and where they are nearest, now.
//
// Where the gap is small beside the shapes, the nearest points of the cores say little about the
// normal: one shape is then moved apart along the last axis before the query, and the answer
// repeated from its own axis while it gains. Any axis is a proof: the gap reported is that of the
// supports along it, so a poor normal costs steps, never truth.

#pragma once

#include "poinsot/collision/pair_motion.h"

namespace poinsot {

struct NearestAxis {
  Vec3 n = Vec3::Zero();       // unit, in W, b → a
  double gap = 0;              // [m] along n
  Vec3 middle = Vec3::Zero();  // [m] in W, midway between the nearest points
};

// `hint`: the axis of before, unit, or zero.
NearestAxis nearest_axis(const PairMotion& motion, const Vec3& hint);

// A first axis without a query: the plane's normal, the hint, or the line of centres.
Vec3 first_axis(const PairMotion& motion, const Vec3& hint);

}  // namespace poinsot
