#include "poinsot/math/rotation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(CrossMatrix, IsTheCrossProduct) {
  const Vec3 a(1, 2, 3), b(-2, 5, 0.5);
  EXPECT_TRUE((cross_matrix(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST(QuaternionRate, IsTheSlidesMatrixTimesOmega) {
  const Quat q = Quat(0.3, -0.5, 0.7, 0.4).normalized();
  const Vec3 omega(0.4, -1, 2);
  Eigen::Matrix<double, 4, 3> Q;  // rows x y z w
  Q << q.w(), q.z(), -q.y(), -q.z(), q.w(), q.x(), q.y(), -q.x(), q.w(), -q.x(), -q.y(), -q.z();
  EXPECT_TRUE(quaternion_rate(q, omega).isApprox(0.5 * Q * omega, 1e-15));
}

TEST(QuaternionRate, IsTheDerivativeOfTheRotation) {
  // R′ = ω× R, checked by a central difference of error h².
  const Quat q = Quat(0.9, 0.1, -0.2, 0.3).normalized();
  const Vec3 omega(0.4, -1, 2);
  const double h = 1e-4;
  auto shifted = [&](double t) {
    Quat s = q;
    s.coeffs() += t * quaternion_rate(q, omega);
    return s.normalized().toRotationMatrix();
  };
  const Mat3 rate = (shifted(h) - shifted(-h)) / (2 * h);
  EXPECT_NEAR((rate - cross_matrix(omega) * q.toRotationMatrix()).norm(), 0, 10 * h * h);
}

TEST(RollPitchYaw, TurnsAboutFixedAxesInOrder) {
  const double half_pi = 1.5707963267948966;
  // Roll takes y to z; pitch then takes z to x; yaw then takes x to y.
  const Quat q = from_roll_pitch_yaw({half_pi, half_pi, half_pi});
  EXPECT_NEAR((q * Vec3::UnitY() - Vec3::UnitY()).norm(), 0, 1e-15);
  const Quat yaw = from_roll_pitch_yaw({0, 0, 0.3});
  EXPECT_NEAR((yaw * Vec3::UnitX() - Vec3(std::cos(0.3), std::sin(0.3), 0)).norm(), 0, 1e-15);
}

TEST(AngleBetween, IsAccurateForSmallAngles) {
  const Quat a = Quat(0.9, 0.1, -0.2, 0.3).normalized();
  const Quat b = a * Quat(Eigen::AngleAxisd(1e-9, Vec3(1, 2, 3).normalized()));
  EXPECT_NEAR(angle_between(a, b), 1e-9, 1e-15);
  Quat minus = b;
  minus.coeffs() *= -1;
  EXPECT_NEAR(angle_between(a, minus), 1e-9, 1e-15);
}

}  // namespace
}  // namespace poinsot
