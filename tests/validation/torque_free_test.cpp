// Free rotation against nature: the closed form over a million seconds, and over thousands of
// bodies against the solution in extended precision.

#include "poinsot/simulation/torque_free.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/closed_forms.h"
#include "support/extended_reference.h"
#include "support/random_bodies.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The largest orientation error [rad] over `frames` frames of 1/60 s.
double error_over_frames(const Vec3& omega, int frames) {
  BodyDef body = test::free_body("body", 1, {1, 2, 3});
  body.angular_velocity = omega;
  Scene scene = test::scene({body});
  scene.simulation.gravity.setZero();
  SimulationLayer layer(scene);
  test::ExtendedReference reference =
      test::reference_of({.mass = 1, .J_B = body.mass_properties.J}, Vec3::Zero(), Quat::Identity(),
                         Vec3::Zero(), omega);
  double worst = 0;
  for (int n = 1; n <= frames; ++n) {
    layer.advance_to(n / 60.0);
    if (n % 10 != 0) continue;
    reference.advance_to(n / 60.0);
    worst = std::max(worst, reference.orientation_error(orientation(layer.world().y, 0)));
  }
  return worst;
}

TEST(TorqueFreeRotation, OfTheTennisRacketIsExactForTwentySeconds) {
  EXPECT_LT(error_over_frames({1e-3, 5, 1e-3}, 1200), 1e-14);  // some 40 roundings; k′² = 8e-8
}

TEST(TorqueFreeRotation, OfATumblingBodyIsExactForTwentySeconds) {
  EXPECT_LT(error_over_frames({1, 3, 2}, 1200), 1e-14);
}

// Over many periods T of the polhode the reference needs one integration only: m_B returns, and the
// orientation has turned about L by an angle α. Then q(n T + τ) = Rot(L̂, n α) q(τ). T and α are
// read off after 20 periods, where they are right to rounding, 1e-16 / 20 each: over 1e6 s that is
// 1e6 · 4 rad/s · 1e-16 / 20 · a few = 1e-10 rad.
TEST(TorqueFreeRotation, LosesNothingInAMillionSeconds) {
  const Mat3 J = Vec3(1, 2, 3).asDiagonal();
  const Vec3 omega(1, 3, 2), L = J * omega;
  const auto reference_at = [&](double t) {
    test::ExtendedReference reference({.mass = 1, .J_B = J}, Vec3::Zero(), Quat::Identity(),
                                      Vec3::Zero(), L);
    reference.advance_to(t);
    return reference;
  };
  // L² and 2T give k′² and the period, Landau and Lifshitz §37 (axis 3 is circled here or axis 1:
  // the reference tells whether the period is right).
  const double E2 = omega.dot(L), G2 = L.squaredNorm();
  const double a = (3 - 2) * (G2 - E2 * 1), b = (2 - 1) * (E2 * 3 - G2);
  const double p = std::sqrt(std::max(a, b) / 6), k_prime2 = 1 - std::min(a, b) / std::max(a, b);
  const double guess = 20 * 4 * test::elliptic_K(k_prime2) / p;
  const test::ExtendedReference after = reference_at(guess);
  const Vec3 change = after.angular_momentum_B() - L;
  ASSERT_LT(change.norm(), 1e-9);  // it is the period
  const Vec3 rate = L.cross(omega);
  const double late = change.dot(rate) / rate.squaredNorm();  // [s] guess − 20 T
  const auto turned_back = [&](const Quat& q, double dt) {
    const Vec3 half = -0.5 * dt * omega;
    return q * Quat(1, half.x(), half.y(), half.z());
  };
  const Quat q20 = turned_back(after.orientation(), late);
  const Vec3 axis = L.normalized();
  const long double alpha = 2 * std::atan2(static_cast<long double>(q20.vec().dot(axis)),
                                           static_cast<long double>(q20.w()));
  const long double period = static_cast<long double>(guess) - static_cast<long double>(late);

  const TorqueFree flight(principal_axes(J), Quat::Identity(), L);
  for (const double t : {1e4, 1e5, 1e6}) {
    const long double n = std::floor(static_cast<long double>(t) / period);
    const long double tau = static_cast<long double>(t) - n * period;
    const long double turn = std::remainder(n * alpha, 4 * std::numbers::pi_v<long double>);
    const Quat expected = Quat(Eigen::AngleAxisd(static_cast<double>(turn), axis)) *
                          reference_at(static_cast<double>(tau)).orientation();
    EXPECT_LT(angle_between(flight.at(t), expected), 1e-9) << t;
    RecordProperty("error_at_" + std::to_string(std::lround(t)),
                   std::to_string(1e12 * angle_between(flight.at(t), expected)) + "e-12 rad");
  }
}

// Over 10 s the angle may be wrong by 1e-12 + 4 ε Φ, Φ the larger of ∫|ω|dt and the elliptic phase,
// which |L|/I₁·t bounds. The whole sweep of 10 000 bodies is `bench_torque_free_sweep`; here as
// many as fit a test.
TEST(TorqueFreeRotation, OfRandomBodiesStaysWithinTheBound) {
  std::mt19937_64 random(20);
  double worst = 0, budget = 5000;  // [rad] of reference per test run
  int bodies = 0;
  for (int n = 0; n < 300 && budget > 0; ++n) {
    const test::RandomFreeBody sample = test::random_free_body(random, n);
    const Vec3 L = sample.q * Vec3(sample.J * (sample.q.conjugate() * sample.omega));
    const double seconds = std::min(10.0, 60 / std::max(1.0, sample.omega.norm()));
    test::ExtendedReference reference({.mass = 1, .J_B = sample.J}, Vec3::Zero(), sample.q,
                                      Vec3::Zero(), L);
    reference.advance_to(seconds);
    const TorqueFree flight(principal_axes(sample.J), sample.q, L);
    const double error = reference.orientation_error(flight.at(seconds));
    const double phase = reference.spin_phase();
    EXPECT_LE(error, 1e-12 + 4 * kEpsilon * phase)
        << n << ": J " << sample.J.diagonal().transpose() << " ω " << sample.omega.transpose();
    worst = std::max(worst, error);
    budget -= phase;
    ++bodies;
  }
  RecordProperty("bodies", bodies);
  RecordProperty("worst_error", std::to_string(1e15 * worst) + "e-15 rad");
  EXPECT_GT(bodies, 50);
}

}  // namespace
}  // namespace poinsot
