// Vectors, matrices and quaternions of the house: Eigen's, in double.
//
// Quaternions are Hamilton, unit, B → W, stored x y z w (Eigen's own order, and the wire's).

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace poinsot {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

}  // namespace poinsot
