// FCL as an oracle, in calls that are exact: unsigned distance and box against box.

#pragma once

#include <memory>

#include <fcl/geometry/collision_geometry.h>

#include "poinsot/collision/collider.h"

namespace poinsot::test {

// A shape and a pose as FCL has them.
std::shared_ptr<fcl::CollisionGeometryd> to_fcl(const Shape& shape);
fcl::Transform3d to_fcl(const Pose& pose);

// Unsigned distance [m], −1 or 0 when the shapes overlap. Not for half-spaces. Exact to 1e-14 of
// the size for polyhedra, to about 1e-5 at worst for cylinders and cones.
double fcl_distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

// Depth of two boxes by FCL's separating axes, 0 when apart. Up to 5 % more than minimal.
double fcl_box_depth(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b);

}  // namespace poinsot::test
