// Hard cases A1 … A12: free rotation against closed forms. README.md lists them all.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/closed_forms.h"
#include "support/extended_reference.h"
#include "support/measured.h"
#include "support/profiles.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Scene spinning(const Vec3& moments, const Vec3& omega) {
  BodyDef body = test::free_body("body", 1, moments);
  body.angular_velocity = omega;
  Scene scene = test::scene({body});
  scene.simulation.gravity.setZero();
  return scene;
}

Quat orientation_at(const Scene& scene, double t) {
  SimulationLayer layer(scene);
  layer.advance_to(t);
  return Quat(orientation(layer.world().y, 0));
}

// Angular momentum in the body's axes after one frame of t seconds [kg·m²/s].
Vec3 body_momentum_at(const Scene& scene, double t) {
  const BodyDef& body = scene.bodies[0];
  const Vec3 L = body.mass_properties.J * body.angular_velocity;
  return orientation_at(scene, t).conjugate() * L;
}

// When the second component of the body's angular momentum changes sign, from a bracket.
double flip_between(const Scene& scene, double low, double high) {
  const bool before = body_momentum_at(scene, low).y() > 0;
  while (high - low > 4 * kEpsilon * high) {
    const double middle = 0.5 * (low + high);
    ((body_momentum_at(scene, middle).y() > 0) == before ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Landau, Lifshitz, §37, for moments 1, 2, 3, from ω₀: rate p of the elliptic argument, and k′².
// L² − 2 T I₁ = 2 ω₂² + 6 ω₃² and 2 T I₃ − L² = 2 ω₁² + 2 ω₂², so that nothing cancels.
struct Elliptic {
  double p, k_prime2;
};
Elliptic elliptic_123(const Vec3& omega) {
  const Vec3 w2 = omega.cwiseAbs2();
  const double larger = 2 * w2.y() + std::max(6 * w2.z(), 2 * w2.x());
  return {std::sqrt(larger / 6), std::abs(6 * w2.z() - 2 * w2.x()) / larger};
}

// A1. The racket flips every 2K/p = 6.62122398134 s.
TEST(HardRotation, TheRacketFlipsWhenTheEllipticIntegralSays) {
  for (const Profile profile : test::kProfiles) {
    const Scene scene = test::with_profile(spinning({1, 2, 3}, {1e-3, 5, 1e-3}), profile);
    const double first = flip_between(scene, 2, 4), second = flip_between(scene, 9, 11);
    const double full = 13.2424479626814;  // [s] 4K/p with p = 2.88675151915, K = 9.55691419342
    test::measured("flip_error_s", second - first - full / 2);
    EXPECT_NEAR(second - first, full / 2, 1e-11);
  }
}

// A1 by an integrator in frames, the sequential floor. A rounding ε while the body comes close to
// the axis changes what leaves it by ε/k′², and so the time of the next flip; that is some 60/λ =
// 21 frames at each of three flips, with ω = 5 rad/s.
TEST(HardRotation, SteppedByTaylorSeriesTheRacketStaysAboveTheSequentialFloor) {
  const Vec3 omega(1e-3, 5, 1e-3);
  Scene scene = spinning({1, 2, 3}, omega);
  scene.simulation.integrator = IntegratorKind::taylor;
  SimulationLayer layer(scene);
  test::ExtendedReference reference =
      test::reference_of({.mass = 1, .J_B = scene.bodies[0].mass_properties.J}, Vec3::Zero(),
                         Quat::Identity(), Vec3::Zero(), omega);
  double worst = 0;
  for (int n = 1; n <= 1200; ++n) {
    layer.advance_to(n / 60.0);
    if (n % 60 != 0) continue;
    reference.advance_to(n / 60.0);
    worst = std::max(worst, reference.orientation_error(orientation(layer.world().y, 0)));
  }
  test::measured("error_rad", worst);
  EXPECT_LT(worst, 3 * 21 * kEpsilon / 7.99999904e-8 * 5);
}

// A3. A generic body has its angular momentum back after 4K/p = 2.77337012863 s.
TEST(HardRotation, AGenericBodyReturnsAfterItsPeriod) {
  const Vec3 omega(1, 3, 2), L(1, 6, 6);
  const Elliptic e = elliptic_123(omega);
  EXPECT_NEAR(e.p, std::sqrt(7), 1e-15);
  EXPECT_NEAR(1 - e.k_prime2, 0.476190476, 1e-9);
  const double period = 4 * test::elliptic_K(e.k_prime2) / e.p;
  EXPECT_NEAR(period, 2.77337012863, 1e-11);
  const Vec3 back = body_momentum_at(spinning({1, 2, 3}, omega), period);
  test::measured("error_relative", (back - L).norm() / L.norm());
  EXPECT_NEAR((back - L).norm() / L.norm(), 0, 1e-14);
}

// A4. On the separatrix (moments 1, 2, 3; ω₁ = √3 ω₃): ω₂ = √7 tanh τ, ω₃ = √(7/3) sech τ,
// τ = λ t + artanh(2/√7), λ = √(7/3). √3 is rounded, and what it is off by grows as exp λt.
TEST(HardRotation, OnTheSeparatrixItFollowsTheHyperbolicTangent) {
  const Scene scene = spinning({1, 2, 3}, {std::sqrt(3.0), 2, 1});
  const double lambda = std::sqrt(7.0 / 3), start = std::atanh(2 / std::sqrt(7.0));
  double worst = 0;
  for (const double t : {0.5, 1.0, 2.0, 4.0, 8.0, 12.0}) {
    const double tau = lambda * t + start;
    const Vec3 omega(std::sqrt(7.0) / std::cosh(tau), std::sqrt(7.0) * std::tanh(tau),
                     std::sqrt(7.0 / 3) / std::cosh(tau));
    const Vec3 m = body_momentum_at(scene, t);
    const double error = (m - Vec3(1, 2, 3).cwiseProduct(omega)).norm() / m.norm();
    EXPECT_LT(error, 4 * kEpsilon * std::exp(lambda * t)) << t;
    worst = std::max(worst, error / (kEpsilon * std::exp(lambda * t)));
  }
  test::measured("worst_over_epsilon_exp", worst);
  SimulationLayer layer(scene);
  const double energy = kinetic_energy(layer.world());
  for (const double t : {20.0, 1e3, 1e6}) {
    layer.advance_to(t);
    ASSERT_TRUE(layer.world().y.allFinite());
    EXPECT_NEAR(kinetic_energy(layer.world()) / energy, 1, 1e-14);
  }
}

// A4. Exactly about the unstable axis it stays there for ever.
TEST(HardRotation, ExactlyAboutTheMiddleAxisItStays) {
  const Scene scene = spinning({1, 2, 3}, {0, 5, 0});
  double worst = 0;
  for (const double t : {1.0, 20.0, 1e3, 1e6}) {
    const Quat exact(Eigen::AngleAxisd(std::remainder(5 * t, 4 * M_PI), Vec3::UnitY()));
    // 4π is rounded, by up to 2e-16 in each of its turns.
    const double rounding = 5 * t / (4 * M_PI) * 5e-16;
    const double error = angle_between(orientation_at(scene, t), exact);
    EXPECT_LT(error, 1e-14 + rounding) << t;
    if (t <= 20) worst = std::max(worst, error);
  }
  test::measured("error_rad_20s", worst);
}

// A5. Near the separatrix the time between flips grows as the logarithm of the distance: 2K/p.
TEST(HardRotation, TheTimeBetweenFlipsGrowsAsTheLogarithmOfTheDistance) {
  double worst = 0;
  for (int exponent = 1; exponent <= 10; ++exponent) {
    const double little = std::pow(10, -exponent);
    const Vec3 omega(little, 5, little);
    const Elliptic e = elliptic_123(omega);
    const double half = 2 * test::elliptic_K(e.k_prime2) / e.p;
    const Scene scene = spinning({1, 2, 3}, omega);
    // From the start, close to a turning point of ω₂, the first flip comes within a half period.
    const double first = flip_between(scene, 0, 0.9 * half);
    const double second = flip_between(scene, first + 0.5 * half, first + 1.5 * half);
    EXPECT_NEAR(second - first, half, 1e-13 * (first + second)) << little;
    worst = std::max(worst, std::abs(second - first - half));
  }
  test::measured("spacing_error_s", worst);
}

// A8. All moments equal but for a few units in the last place: the axis stays.
TEST(HardRotation, ABodyThatIsASphereButForRoundingKeepsItsAxis) {
  const Vec3 omega(1, 3, 2);
  double worst = 0;
  for (const double t : {0.5, 1.0, 3.0, 10.0}) {
    const Quat exact(Eigen::AngleAxisd(omega.norm() * t, omega.normalized()));
    const double error =
        angle_between(orientation_at(spinning({1, 1 + 1e-15, 1 + 2e-15}, omega), t), exact);
    // What two units in the last place of the moments turn it by, at the most.
    EXPECT_LT(error, 1e-14 + 2e-15 * omega.norm() * t) << t;
    worst = std::max(worst, error);
  }
  test::measured("error_rad", worst);
}

// A9. A little beside the stable axis ω turns in the body with ω₃ √((I₃−I₁)(I₃−I₂)/I₁I₂) = 5 rad/s.
TEST(HardRotation, ALittleBesideTheStableAxisItPrecessesInTheBody) {
  const double small = 1e-4;
  const Scene scene = spinning({1, 2, 3}, {small, 0, 5});
  double worst = 0;
  for (const double t : {0.3, 1.0, 5.0, 20.0}) {
    const Vec3 m = body_momentum_at(scene, t);
    // ω₁′ = −ω₃ ω₂, ω₂′ = ω₃ ω₁ with these moments.
    const Vec3 linear(small * std::cos(5 * t), 2 * small * std::sin(5 * t), 15);
    const double error = (m - linear).norm();
    // What is left out is of second order, and grows with time at the most.
    EXPECT_LT(error, small * small * (1 + t)) << t;
    worst = std::max(worst, error / 15);
  }
  test::measured("error_relative", worst);
}

// A10. Beyond what matter can have, too: 1e-6 + 1 < 1.1.
TEST(HardRotation, NeedlesAndDiscsAreExact) {
  struct Case {
    Vec3 moments, omega;
    double t;
  };
  double worst = 0;
  for (const Case& c :
       {Case{{1e-6, 1, 1.1}, {1e3, 1, 1}, 1}, {{0.5, 0.500001, 1}, {1, 1, 5}, 20}}) {
    const Mat3 J = c.moments.asDiagonal();
    const Vec3 L = J * c.omega;
    test::ExtendedReference reference({.mass = 1, .J_B = J}, Vec3::Zero(), Quat::Identity(),
                                      Vec3::Zero(), L, test::kQuick);
    reference.advance_to(c.t);
    const TorqueFree flight(principal_axes(J), Quat::Identity(), L);
    const double error = reference.orientation_error(flight.at(c.t));
    EXPECT_LT(error, 1e-12);
    worst = std::max(worst, error);
  }
  test::measured("error_rad", worst);
}

// A11. So slow that it turns linearly, down to denormal numbers and nothing.
TEST(HardRotation, TheSlowestSpinTurnsLinearly) {
  double worst = 0;
  for (const double scale : {1e-12, 1e-160, 1e-310, 0.0}) {
    const Vec3 omega = scale * Vec3(1, 3, 2);
    for (const double t : {1.0, 1e3}) {
      const Quat q = orientation_at(spinning({1, 2, 3}, omega), t);
      ASSERT_TRUE(q.coeffs().allFinite());
      const Vec3 turned = 2 * q.vec() * (q.w() < 0 ? -1 : 1);
      // Quadratic terms: (ωt)² of the torque-free motion.
      const double error = (turned - t * omega).norm();
      EXPECT_LT(error, 1e-15 + 20 * scale * t * scale * t) << scale;
      worst = std::max(worst, error);
    }
  }
  test::measured("error_rad", worst);
}

// A12. A million seconds in frames: L to the bit, energy to rounding. The attitude then is measured
// by TorqueFreeRotation.LosesNothingInAMillionSeconds.
TEST(HardRotation, InAMillionSecondsNeitherEnergyNorMomentumDrift) {
  SimulationLayer layer(spinning({1, 2, 3}, {1, 3, 2}));
  const Vec3 L = angular_momentum(layer.world().y, 0);
  const double energy = kinetic_energy(layer.world());
  double drift = 0;
  for (int n = 1; n <= 1000; ++n) {
    layer.advance_to(1e3 * n);
    ASSERT_EQ(Vec3(angular_momentum(layer.world().y, 0)), L);
    drift = std::max(drift, std::abs(kinetic_energy(layer.world()) / energy - 1));
  }
  test::measured("energy_drift", drift);
  EXPECT_LT(drift, 4e-15);  // not a drift: some twenty roundings of one evaluation
}

}  // namespace
}  // namespace poinsot
