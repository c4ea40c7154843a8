// The extended-precision reference against closed forms, invariants and itself.

#include "support/extended_reference.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/closed_forms.h"

namespace poinsot::test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

ReferenceBody with_moments(double I1, double I2, double I3) {
  ReferenceBody body;
  body.mass = 2;
  body.J_B = Vec3(I1, I2, I3).asDiagonal();
  return body;
}

const Vec3 kOrigin = Vec3::Zero();
const Quat kUpright = Quat::Identity();
const Quat kTilted = Quat(0.5, 0.5, -0.5, 0.5);

TEST(ExtendedReference, TurnsASymmetricTopAsTheClosedFormSays) {
  const ReferenceBody body = with_moments(2, 2, 1);
  const Vec3 omega_B(1, 0.5, 3);
  ExtendedReference reference = reference_of(body, kOrigin, kUpright, kOrigin, omega_B);
  for (const double t : {0.3, 5.0, 20.0}) {
    reference.advance_to(t);
    const double phase = 4 * t;  // [rad] at least that of the closed form; its rounding dominates
    EXPECT_LE(reference.orientation_error(symmetric_top(kUpright, 2, 1, omega_B, t)),
              4 * kEpsilon * (1 + phase));
  }
}

TEST(ExtendedReference, KeepsEnergyAndAngularMomentumOfATumblingBody) {
  for (const Vec3& omega : {Vec3(1, 3, 2), Vec3(1e-3, 5, 1e-3)}) {
    ExtendedReference reference =
        reference_of(with_moments(1, 2, 3), kOrigin, kTilted, kOrigin, omega);
    reference.advance_to(20);
    EXPECT_LE(reference.energy_drift(), 1e-28);
    EXPECT_LE(reference.angular_momentum_drift(), 1e-28);
  }
}

TEST(ExtendedReference, SpinsUpAboutAPrincipalAxisUnderAConstantTorque) {
  ReferenceBody body = with_moments(1, 3, 2);
  body.held.in_B.torque = Vec3(0, 0, 1);
  ExtendedReference in_B = reference_of(body, kOrigin, kUpright, kOrigin, kOrigin);
  body.held = {};
  body.held.in_W.torque = Vec3(0, 0, 1);
  ExtendedReference in_W = reference_of(body, kOrigin, kUpright, kOrigin, kOrigin);
  const double t = 4, angle = 0.5 * t * t / 2;
  for (ExtendedReference* reference : {&in_B, &in_W}) {
    reference->advance_to(t);
    EXPECT_LE(reference->orientation_error(Quat(std::cos(angle / 2), 0, 0, std::sin(angle / 2))),
              4 * kEpsilon);
    EXPECT_NEAR(reference->spin_phase(), angle, 1e-6 * angle);
  }
}

TEST(ExtendedReference, AgreesWithItselfAtAnotherOrderAndStep) {
  ReferenceBody body = with_moments(1, 2, 3);
  body.gravity = Vec3(0, 0, -9.81);
  body.held.in_W.torque = Vec3(0.3, -0.2, 0.1);
  body.held.in_B = {Vec3(0.5, 0, 0.2), Vec3(0.1, 0.2, -0.1)};
  body.held.add_force_at(Vec3(0.1, -0.3, 0.2), Vec3(1, 2, 3));
  body.drag_linear = 0.2;
  body.drag_quadratic = 0.1;
  body.drag_angular = 0.05;
  body.springs = {{.point_B = Vec3(0.2, 0, 0.1),
                   .point_W = Vec3(0, 1, 5),
                   .stiffness = 20,
                   .damping = 0.3,
                   .rest_length = 1}};
  const Vec3 omega(1, 3, 2), velocity(1, 0, 2);
  ExtendedReference fine =
      reference_of(body, kOrigin, kTilted, velocity, omega, {.order = 36, .tolerance = 1e-32});
  ExtendedReference coarse =
      reference_of(body, kOrigin, kTilted, velocity, omega, {.order = 24, .tolerance = 1e-30});
  for (const double t : {1.0, 5.0}) {
    fine.advance_to(t);
    coarse.advance_to(t);
    EXPECT_LE(fine.orientation_error(coarse), 1e-25);
    EXPECT_LE(fine.position_error(coarse), 1e-25);
  }
}

// Tolerance: energy is off by some 1e-19 per step, and so, growing with time, is the spin.
TEST(ExtendedReference, IsQuickIn64BitsAndStillBetterThanDouble) {
  ReferenceBody body = with_moments(1, 2, 3);
  body.held.in_W.torque = Vec3(0.3, -0.2, 0.1);
  const Vec3 omega(1, 3, 2);
  ExtendedReference quick = reference_of(body, kOrigin, kTilted, kOrigin, omega, kQuick);
  ExtendedReference exact = reference_of(body, kOrigin, kTilted, kOrigin, omega);
  quick.advance_to(20);
  exact.advance_to(20);
  EXPECT_LE(quick.orientation_error(exact), 1e-19 * quick.spin_phase() * quick.spin_phase());
}

TEST(ExtendedReference, GivesTheSameWhetherItIsAskedOftenOrOnce) {
  const auto make = [] {
    return reference_of(with_moments(1, 2, 3), kOrigin, kUpright, kOrigin, Vec3(1, 3, 2));
  };
  ExtendedReference often = make(), once = make();
  for (int i = 1; i <= 120; ++i) often.advance_to(i / 60.0);
  once.advance_to(2);
  EXPECT_LE(often.orientation_error(once), 1e-33);
  EXPECT_NEAR(often.spin_phase(), once.spin_phase(), 1e-6 * once.spin_phase());
}

TEST(ExtendedReference, FollowsABallisticPath) {
  ReferenceBody body = with_moments(1, 2, 3);
  body.gravity = Vec3(0, 0, -10);
  ExtendedReference reference =
      reference_of(body, Vec3(1, 2, 3), kUpright, Vec3(4, 0, 16), Vec3(1, 2, 3));
  reference.advance_to(3);
  EXPECT_LE(reference.position_error(ballistic(Vec3(1, 2, 3), Vec3(4, 0, 16), body.gravity, 3)),
            1e-28);
}

TEST(ExtendedReference, SlowsDownByLinearDragExponentially) {
  ReferenceBody body = with_moments(2, 2, 2);
  body.drag_linear = 0.5;   // of a mass of 2 kg: 1/4 per second
  body.drag_angular = 0.5;  // likewise
  ExtendedReference reference = reference_of(body, kOrigin, kUpright, Vec3(3, 0, 0), Vec3(0, 0, 2));
  reference.advance_to(8);
  const double left = std::exp(-2);
  EXPECT_NEAR(reference.momentum().x(), 6 * left, 8 * kEpsilon);
  EXPECT_NEAR(reference.position().x(), 12 * (1 - left), 32 * kEpsilon);
  EXPECT_NEAR(reference.angular_velocity().z(), 2 * left, 8 * kEpsilon);
}

TEST(ExtendedReference, ReachesTerminalSpeedInAQuadraticMediumFromRest) {
  ReferenceBody body = with_moments(1, 2, 3);
  body.gravity = Vec3(0, 0, -10);
  body.drag_quadratic = 0.2;  // terminal speed √(m g/c) = 10 m/s, rate g/v = 1/s
  ExtendedReference reference = reference_of(body, kOrigin, kUpright, kOrigin, kOrigin);
  reference.advance_to(3);
  EXPECT_NEAR(reference.momentum().z(), -20 * std::tanh(3), 40 * kEpsilon);
  EXPECT_NEAR(reference.position().z(), -10 * std::log(std::cosh(3)), 40 * kEpsilon);
}

TEST(ExtendedReference, SwingsOnASpringAsTheOscillatorDoes) {
  ReferenceBody body = with_moments(1, 2, 3);
  body.springs = {{.point_W = Vec3(0, 0, 3), .stiffness = 32, .damping = 4, .rest_length = 1}};
  const double decay = 1, omega = std::sqrt(15);  // x″ + 2 x′ + 16 x = 0 about z = 2
  ExtendedReference reference = reference_of(body, Vec3(0, 0, 1.5), kUpright, kOrigin, kOrigin);
  reference.advance_to(2);
  const double x =
      -0.5 * std::exp(-decay * 2) * (std::cos(omega * 2) + decay / omega * std::sin(omega * 2));
  EXPECT_NEAR(reference.position().z(), 2 + x, 16 * kEpsilon);

  body.springs = {{.point_W = Vec3(0, 0, 3), .stiffness = 32}};
  ExtendedReference linear = reference_of(body, Vec3(0, 0, 1), kUpright, kOrigin, kOrigin);
  linear.advance_to(2);
  EXPECT_NEAR(linear.position().z(), 3 - 2 * std::cos(8.0), 16 * kEpsilon);
}

TEST(ExtendedReference, TakesTheEnergyThatAForceAtABodyPointGives) {
  ReferenceBody body = with_moments(1, 2, 3);
  const Vec3 p(0.3, -0.2, 0.5), F(1, -2, 0.5);
  body.held.add_force_at(p, F);
  ExtendedReference reference =
      reference_of(body, kOrigin, kTilted, Vec3(0.1, 0.2, 0.3), Vec3(1, 0.5, -1));
  const double before = reference.kinetic_energy();
  const Vec3 start = kTilted * p;
  reference.advance_to(5);
  const Vec3 end = reference.position() + reference.orientation() * p;
  EXPECT_NEAR(reference.kinetic_energy() - before, F.dot(end - start),
              64 * kEpsilon * reference.kinetic_energy());
}

TEST(ExtendedReference, StartsAnewWithAnotherWrench) {
  ReferenceBody body = with_moments(1, 2, 3);
  ExtendedReference reference = reference_of(body, kOrigin, kUpright, kOrigin, kOrigin);
  HeldWrench push;
  push.in_W.force = Vec3(4, 0, 0);
  reference.advance_to(1);
  reference.hold(push);
  reference.advance_to(3);
  EXPECT_NEAR(reference.position().x(), 0.5 * 2 * 4, 8 * kEpsilon);
}

}  // namespace
}  // namespace poinsot::test
