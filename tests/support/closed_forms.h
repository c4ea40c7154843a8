// What nature does, in closed form, with source and validity.

#pragma once

#include <cmath>

#include "poinsot/math/pose.h"

namespace poinsot::test {

// Centre of a body under uniform gravity alone, exact.
inline Vec3 ballistic(const Vec3& c0, const Vec3& v0, const Vec3& g, double t) {
  return c0 + t * v0 + 0.5 * t * t * g;
}

// Orientation of a torque-free body with moments (I1, I1, I3) in B. The body turns uniformly about
// its symmetry axis while that axis turns uniformly about L. Landau, Lifshitz, Mechanics, §35;
// exact.
inline Quat symmetric_top(const Quat& q0, double I1, double I3, const Vec3& omega0_B, double t) {
  const Vec3 L_W = q0 * Vec3(I1 * omega0_B.x(), I1 * omega0_B.y(), I3 * omega0_B.z());
  const double precession = L_W.norm() / I1;           // [rad/s] about L
  const double spin = omega0_B.z() * (1.0 - I3 / I1);  // [rad/s] about the body's axis
  const Quat about_L(Eigen::AngleAxisd(precession * t, L_W.normalized()));
  const Quat about_axis(Eigen::AngleAxisd(spin * t, Vec3::UnitZ()));
  return about_L * q0 * about_axis;
}

// Complete elliptic integral K of the first kind by the arithmetic-geometric mean, from k'² = 1 −
// k². Abramowitz, Stegun 17.6.
inline double elliptic_K(double k_prime2) {
  double a = 1, b = std::sqrt(k_prime2);
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 1.57079632679489661923 / a;
}

// Acceleration of a block that slides down a plane of angle θ with friction μ < tan θ. Coulomb.
inline double incline_acceleration(double g, double theta, double mu) {
  return g * (std::sin(theta) - mu * std::cos(theta));
}

}  // namespace poinsot::test
