// A point at which two bodies touch or nearly touch, as a contact solver sees it. A solver takes
// arrays and knows no world and no shape.

#pragma once

#include <span>

#include "poinsot/math/types.h"

namespace poinsot {

// One body as a solver sees it. Bodies that do not move have zero inverse mass and inertia.
struct ContactBody {
  Vec3 c;                       // [m] centre of mass, in W
  Vec3 v;                       // [m/s]
  Vec3 omega;                   // [rad/s] in W
  double inv_mass = 0;          // [1/kg]
  Mat3 inv_J_W = Mat3::Zero();  // [1/(kg·m²)]
};

struct Contact {
  int a = 0, b = 0;  // bodies
  Vec3 point;        // [m] in W
  Vec3 normal;       // unit, in W, from b to a
  double gap = 0;    // [m] > 0 apart, < 0 penetrating
  double restitution = 0;
  double friction = 0;
  // [m/s] in W: what the relative velocity that counts has beside that of the bodies at `point`,
  // because arms turn until it does. ConvexNewton only.
  Vec3 carried = Vec3::Zero();

  // Impulse on a (and its opposite on b) [N·s]: the start of the next solve.
  double normal_impulse = 0;             // ≥ 0
  Vec3 friction_impulse = Vec3::Zero();  // perpendicular to the normal, in W
};

// Two bodies held together at a point: a bilateral row of each axis. The relative velocity of a's
// point and b's is `target` after the solve, whatever impulse that takes.
struct PointJoint {
  int a, b;                     // bodies
  Vec3 point;                   // [m] in W, midway between the two points
  Vec3 target = Vec3::Zero();   // [m/s] in W
  Vec3 impulse = Vec3::Zero();  // [N·s] on a (its opposite on b), in W: the start of the next solve
};

}  // namespace poinsot
