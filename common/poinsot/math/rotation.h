// Rotations: the quaternion's rate, roll-pitch-yaw, cross-product matrices.
// Source: lesson "Rigid Body Dynamics", slides "Linear and Angular Velocity".

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

// a× such that (a×) b = a × b.
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

// q′ = ½ Q(q) ω for an angular velocity ω [rad/s] in W; coefficients x y z w [1/s].
inline Eigen::Vector4d quaternion_rate(const Quat& q, const Vec3& omega) {
  return 0.5 * (Quat(0, omega.x(), omega.y(), omega.z()) * q).coeffs();
}

// Rotation about fixed axes: roll about x, then pitch about y, then yaw about z [rad].
// The same bits on every machine.
Quat from_roll_pitch_yaw(const Vec3& rpy);

// Angle of the rotation between two orientations [rad], accurate for small angles.
double angle_between(const Quat& a, const Quat& b);

}  // namespace poinsot
