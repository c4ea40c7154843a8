// Signed distances in closed form: a sphere against a sphere, box, capsule or cylinder, and two
// capsules. Exact to rounding; both bounds are the same.

#pragma once

#include "poinsot/collision/proximity.h"

namespace poinsot {

// False, with `gap` untouched, for other pairs and where the axes of two capsules cross, which
// leaves the closed form no normal. a's shape comes no later than b's.
bool round_gap(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
               Gap& gap);

}  // namespace poinsot
