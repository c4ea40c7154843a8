#include "poinsot/contact/single_impact.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

// [J] of the impulse: p·(u + u⁺)/2.
double energy_change(const Mat3& A, const Vec3& u, const Vec3& p) {
  return p.dot(u) + 0.5 * p.dot(A * p);
}

// Of a body of unit mass touched at r from its centre by the ground.
Mat3 inverse_mass(const Vec3& r, const Vec3& inv_J) {
  Mat3 cross;
  cross << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return Mat3::Identity() + cross.transpose() * inv_J.asDiagonal() * cross;
}

// The equations of the header in small steps of the impulse, first order: an independent reference.
Vec3 reference(const Mat3& A, const Vec3& start, double e, double friction, int steps) {
  const double dp = -start.z() / A(2, 2) / steps;
  Vec3 u = start, p = Vec3::Zero();
  double compression = 0, restitution = 0;
  while (u.z() < 0 || restitution < e * e * compression) {
    const Eigen::Vector2d hold =
        -(A.topLeftCorner<2, 2>().inverse() * (A.topRightCorner<2, 1>() + u.head<2>() / dp));
    const Eigen::Vector2d f =
        hold.norm() <= friction ? hold : Eigen::Vector2d(-friction * u.head<2>().normalized());
    const Vec3 push(f.x() * dp, f.y() * dp, dp);
    const double before = u.z();
    u += A * push;
    p += push;
    (before < 0 ? compression : restitution) += dp * 0.5 * std::abs(before + u.z());
  }
  return p;
}

TEST(SingleImpact, WithoutFrictionTheNormalVelocityIsReversedTimesE) {
  const Mat3 A = inverse_mass({0.3, -0.2, -0.5}, {3, 5, 7});
  const Vec3 u(1, 2, -3);
  for (const double e : {0.0, 0.3, 1.0}) {
    const Vec3 p = *single_impact(A, u, e, 0);
    EXPECT_NEAR((u + A * p).z(), 3 * e, 1e-14);
    EXPECT_EQ(p.head<2>().norm(), 0);
  }
}

TEST(SingleImpact, ABallThatSlipsThroughoutLosesMuTimesTheNormalImpulse) {
  // Uniform ball, r = 0.1: ut⁺ = ut − μ (1 + e) |un| (1 + r²/J) while that is positive.
  const Mat3 A = inverse_mass({0, 0, -0.1}, Vec3::Constant(1 / (0.4 * 0.01)));
  const Vec3 u(3, 4, -1);
  const double e = 0.5, friction = 0.2;
  const Vec3 after = u + A * *single_impact(A, u, e, friction);
  EXPECT_NEAR(after.z(), 0.5, 1e-14);
  EXPECT_NEAR(after.head<2>().norm(), 5 - friction * 1.5 * 3.5, 1e-13);
  EXPECT_NEAR(after.x() * 4 - after.y() * 3, 0, 1e-13);
}

TEST(SingleImpact, ABallWithBackspinEndsRollingIfFrictionSuffices) {
  // It keeps 5/7 of what m v + J ω/r gives: the point stops, the angular momentum about it is kept.
  const double r = 0.1, inv_J = 1 / (0.4 * r * r);
  const Mat3 A = inverse_mass({0, 0, -r}, Vec3::Constant(inv_J));
  const double vx = 7, wy = -20;  // backspin
  const Vec3 u(vx - wy * r, 0, -4);
  const Vec3 p = *single_impact(A, u, 0.8, 10);
  EXPECT_NEAR((u + A * p).head<2>().norm(), 0, 1e-14);
  const double v_after = vx + p.x(), w_after = wy - r * p.x() * inv_J;
  EXPECT_NEAR(v_after, r * w_after, 1e-13);
  EXPECT_NEAR(v_after, (5 * vx + 2 * r * wy) / 7, 1e-13);
}

TEST(SingleImpact, CurvedSlipAgreesWithSmallSteps) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int sample = 0; sample < 40; ++sample) {
    const Vec3 r(unit(random), unit(random), unit(random));
    const Mat3 A = inverse_mass(r, {2 + unit(random), 3 + unit(random), 5 + unit(random)});
    const Vec3 u(unit(random), unit(random), -1 - unit(random) * 0.5);
    const double e = 0.5 + 0.5 * unit(random), friction = 0.6 + 0.5 * unit(random);
    const Vec3 p = *single_impact(A, u, e, friction);
    // The reference's error falls with its step; twice extrapolated it is far below the bound.
    const Vec3 coarse = reference(A, u, e, friction, 20'000);
    const Vec3 fine = reference(A, u, e, friction, 40'000);
    EXPECT_LE((p - fine).norm(), 4 * (coarse - fine).norm() + 2e-4 * p.norm()) << sample;
  }
}

TEST(SingleImpact, NoneGainsEnergyOrLeavesItsConeOrApproachesStill) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int sample = 0; sample < 20'000; ++sample) {
    const Vec3 r(unit(random), unit(random), unit(random));
    Vec3 inv_J;
    for (double& x : inv_J) x = std::pow(10, 1.5 * unit(random));
    const Mat3 A = inverse_mass(r, inv_J);
    const Vec3 u(unit(random), unit(random), -std::abs(unit(random)));
    const double e = 0.5 + 0.5 * unit(random), friction = 2.5 + 2.5 * unit(random);
    const std::optional<Vec3> p = single_impact(A, u, e, friction);
    ASSERT_TRUE(p) << sample;
    const double size = 0.5 * u.squaredNorm() / A(2, 2);
    // Of the integration, 1e-11 a step.
    ASSERT_LE(energy_change(A, u, *p), 1e-9 * size) << sample;
    ASSERT_LE(p->head<2>().norm(), friction * p->z() * (1 + 1e-14)) << sample;
    ASSERT_GE((u + A * *p).z(), -1e-9 * u.norm()) << sample;
  }
}

TEST(SingleImpact, TheWorkOfRestitutionIsThatOfCompressionTimesESquared) {
  // A planar impact that slips, stops within compression and sticks: by hand. m = 1, A as given.
  Mat3 A;
  A << 2, 0, 0.5, 0, 2, 0, 0.5, 0, 1;
  const Vec3 u(0.1, 0, -1);
  const double e = 0.6, friction = 1;
  // Slip: du = (0.5 − 2, 1 − 0.5) dp, stops at p = 1/15; then f = −1/4 ≥ −μ sticks, dun = 7/8 dp.
  const double p1 = 0.1 / 1.5, un1 = -1 + 0.5 * p1;
  const double compression = p1 * (1 - 0.25 * p1) + un1 * un1 / (2 * 0.875);
  const double after = e * std::sqrt(2 * 0.875 * compression);
  const Vec3 p = *single_impact(A, u, e, friction);
  EXPECT_NEAR((u + A * p).z(), after, 1e-14);
  EXPECT_NEAR((u + A * p).x(), 0, 1e-15);
}

TEST(SingleImpact, PainlevesRodIsStoppedByAFiniteImpulse) {
  // Slender rod, m = 1, length 2, sliding at θ from the horizontal: with tan θ = 2 and μ = 1.4,
  // p = 1 + 3 cos²θ − 3 μ sin θ cos θ = −0.08, so that pressing brings it down faster.
  const double theta = std::atan(2.0);
  const Vec3 r(-std::cos(theta), 0, -std::sin(theta));
  const Mat3 A = inverse_mass(r, {3, 3, 3});
  for (const double friction : {1.2, 4.0 / 3, 1.4, 5.0}) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 u(sign, 0, -1e-9);
      const std::optional<Vec3> p = single_impact(A, u, 0.5, friction);
      ASSERT_TRUE(p && p->allFinite());
      EXPECT_LE(energy_change(A, u, *p), 1e-15);
      EXPECT_GE((u + A * *p).z(), 0);
      EXPECT_LT(p->norm(), 10);
    }
  }
  // The inconsistent case is an impact without collision: an impulse of the size of m |ut|.
  const Vec3 u(1, 0, -1e-9);
  const Vec3 against = *single_impact(A, u, 0, 1.4),
             with = *single_impact(A, -u.cwiseAbs(), 0, 1.4);
  EXPECT_GT(std::max(against.norm(), with.norm()), 0.1);
}

}  // namespace
}  // namespace poinsot
