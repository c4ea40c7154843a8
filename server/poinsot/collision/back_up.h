// Back from an overlap to the impact before it: the root of the gap in a bracket, by the gap's own
// rate (Newton's steps, quadratic at the root), safeguarded by bisection.

#pragma once

#include "poinsot/collision/nearest_axis.h"

namespace poinsot {

// The pair is apart at `apart` and overlaps at `overlaps` [s]. Goes to a root between, where the
// gap is 0 to rounding, and gives the axis there; if time does not resolve the root, to the last
// time at which the pair is apart.
NearestAxis back_up(PairMotion& motion, double apart, double overlaps, const NearestAxis& axis);

}  // namespace poinsot
