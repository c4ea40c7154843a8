// How a pair's nearest axis turns, and how fast its gap closes, now.
//
// Where faces and edges are nearest, the supports along the axis are not single points: a fixed
// axis then bounds the gap by that of the corner that comes fastest, however far it is from the
// place of contact. An axis that turns with the features does not.

#pragma once

#include "poinsot/collision/nearest_axis.h"

namespace poinsot {

// Angular velocity ⟂ n [rad/s], in W, at which n stays normal to the features that are extreme
// along it: a face turns it with its body, two edges stay perpendicular to it. Zero if neither
// shape has more than a point there.
Vec3 axis_turn(const PairMotion& motion, const Vec3& n);

// Rate of the gap [m/s]: that of the pair of nearest points that closes fastest. Of a pair that is
// in touch or nearly so.
double gap_rate(const PairMotion& motion, const NearestAxis& axis);

// For how long [s] an axis that turns is worth following, at most `most`.
double turning_for(const PairMotion& motion, const Vec3& turn, double most);

// n after turning for x [s].
Vec3 turned_axis(const Vec3& n, const Vec3& turn, double x);

}  // namespace poinsot
