// Hard cases A13, A15, F1 … F4, F7, F10: flights and driven flights. README.md lists them all.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/closed_forms.h"
#include "support/extended_reference.h"
#include "support/measured.h"
#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

Scene tumbling_box(const Vec3& at) {
  BodyDef box = test::body("box", Box{{1, 0.6, 0.2}}, at);
  box.linear_velocity = {4, -2, 10};
  box.angular_velocity = {3, 5, -1};
  return test::scene({box});
}

// A13. The parabola and the energy, both profiles.
TEST(HardFlight, ATumblingProjectileFollowsItsParabolaToRounding) {
  for (const Profile profile : test::kProfiles) {
    const Scene scene = test::with_profile(tumbling_box({1, 2, 3}), profile);
    CollisionLayer layer(scene);
    const double start = layer.energy(), scale = 0.5 * layer.world().mass[0] * 120;
    double off = 0, drift = 0;
    test::run_until(layer, 10, [&](const CollisionLayer& now) {
      const Vec3 exact =
          test::ballistic({1, 2, 3}, {4, -2, 10}, scene.simulation.gravity, now.time());
      off = std::max(off, (position(now.world().y, 0) - exact).norm() / exact.norm());
      drift = std::max(drift, std::abs(now.energy() - start));
    });
    // Potential and kinetic energy grow to 80 times the start; each is rounded.
    drift /= std::max(scale, kinetic_energy(layer.world()));
    EXPECT_LT(off, 1e-14);
    EXPECT_LT(drift, 1e-14);
    test::measured("position_relative", off);
    test::measured("energy_relative", drift);
  }
}

// A15. Far from the origin: the same motion, but for two units in the last place of the place.
TEST(HardFlight, FarFromTheOriginOnlyTheRoundingOfThePlaceIsLost) {
  CollisionLayer near(tumbling_box({1, 2, 3}));
  test::run_until(near, 10);
  for (const double offset : {1e6, 1e8}) {
    const Vec3 shift(offset, -offset, offset);
    CollisionLayer far(tumbling_box(Vec3(1, 2, 3) + shift));
    test::run_until(far, 10);
    const Vec3 moved = position(far.world().y, 0) - shift - position(near.world().y, 0);
    const double ulp = std::ldexp(kEpsilon, std::ilogb(offset));
    EXPECT_LE(moved.cwiseAbs().maxCoeff(), 2 * ulp) << offset;
    EXPECT_EQ(orientation(far.world().y, 0).coeffs(), orientation(near.world().y, 0).coeffs());
    test::measured(offset < 1e7 ? "ulps_at_1e6" : "ulps_at_1e8", moved.cwiseAbs().maxCoeff() / ulp);
  }
}

// F7. The same flight looked at 1, 30, 60, 240 times a second: the same bits where they coincide,
// but for the sign of q, which is continuous from look to look.
TEST(HardFlight, DoesNotDependOnHowOftenItIsLookedAt) {
  CollisionLayer reference(tumbling_box({1, 2, 3}));
  reference.advance_to(20);
  for (const int rate : {1, 30, 60, 240}) {
    CollisionLayer layer(tumbling_box({1, 2, 3}));
    for (int n = 1; n <= 20 * rate; ++n) layer.advance_to(static_cast<double>(n) / rate);
    const Eigen::Matrix<double, 13, 1> one = layer.world().y.col(0),
                                       other = reference.world().y.col(0);
    EXPECT_EQ(one.head<3>(), other.head<3>()) << rate;
    EXPECT_TRUE(one.segment<4>(3) == other.segment<4>(3) ||
                one.segment<4>(3) == -other.segment<4>(3))
        << rate;
    EXPECT_EQ(one.tail<6>(), other.tail<6>()) << rate;
  }
}

// F10. However often, and however late, an orientation is asked for, it is a unit quaternion.
TEST(HardFlight, AMillionOrientationsAreUnitToFourUlp) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> exponent(-3, 9);
  const Vec3 L(1, 6, 6);
  const TorqueFree flight(principal_axes(Vec3(1, 2, 3).asDiagonal()), Quat::Identity(), L);
  double worst = 0;
  for (int n = 0; n < 1'000'000; ++n)
    worst = std::max(worst, std::abs(flight.at(std::pow(10, exponent(random))).norm() - 1));
  test::measured("norm_error_ulp", worst / kEpsilon);
  EXPECT_LE(worst, 4 * kEpsilon);
}

BodyDef tumbling() {
  BodyDef body = test::free_body("body", 1, {1, 2, 3});
  body.angular_velocity = {1, 3, 2};
  return body;
}
Scene weightless(const BodyDef& body) {
  Scene scene = test::scene({body});
  scene.simulation.gravity.setZero();
  return scene;
}

struct Drift {
  double orientation = 0;  // [rad]
  double position = 0;     // [m]
};
// The largest errors at full seconds over 20 s in frames of 1/60 s.
Drift against(test::ExtendedReference reference, SimulationLayer& layer) {
  Drift worst;
  for (int n = 1; n <= 1200; ++n) {
    layer.advance_to(n / 60.0);
    if (n % 60 != 0) continue;
    reference.advance_to(n / 60.0);
    worst.orientation =
        std::max(worst.orientation, reference.orientation_error(orientation(layer.world().y, 0)));
    worst.position =
        std::max(worst.position, reference.position_error(position(layer.world().y, 0)));
  }
  test::measured("orientation_rad", worst.orientation);
  return worst;
}

// F1. A couple that is constant in the body, and one that is constant in the world.
TEST(HardFlight, AConstantCoupleIsFollowedForTwentySeconds) {
  for (const bool in_body : {true, false}) {
    const BodyDef body = tumbling();
    HeldWrench held;
    (in_body ? held.in_B : held.in_W).torque = {0.3, -0.2, 0.5};
    SimulationLayer layer(weightless(body));
    layer.world().held[0] = held;
    const Drift worst = against(
        test::reference_of({.mass = 1, .J_B = body.mass_properties.J, .held = held}, Vec3::Zero(),
                           Quat::Identity(), Vec3::Zero(), body.angular_velocity),
        layer);
    EXPECT_LT(worst.orientation, 1e-11) << in_body;
  }
}

// F2. Drag τ = −0.1 ω, and energy that never rises. Each of 1200 frames rounds L, which turns the
// rest of some 50 rad by as much.
TEST(HardFlight, AngularDragIsFollowedForTwentySecondsAndOnlyTakesEnergy) {
  BodyDef body = tumbling();
  body.drag.angular = 0.1;
  const Scene scene = weightless(body);
  SimulationLayer layer(scene);
  const Drift worst = against(
      test::reference_of({.mass = 1, .J_B = body.mass_properties.J, .drag_angular = 0.1},
                         Vec3::Zero(), Quat::Identity(), Vec3::Zero(), body.angular_velocity),
      layer);
  EXPECT_LT(worst.orientation, 1200 * kEpsilon * 50 / 2);
  SimulationLayer again(scene);
  double before = kinetic_energy(again.world());
  for (int n = 1; n <= 1200; ++n) {
    again.advance_to(n / 60.0);
    const double now = kinetic_energy(again.world());
    ASSERT_LT(now, before);
    before = now;
  }
}

// F3. The weight of 1 N at (0.1, 0.2, 0.3) off the centre: a top whose centre falls beside. What
// turns keeps ½ ω·L − F·R l.
TEST(HardFlight, AWeightOffTheCentreKeepsTheEnergyOfItsTurning) {
  struct Method {
    IntegratorKind kind;
    double tolerance, allowed;
  };
  // The row's bound for dop853 at 1e-12; series are cut at rounding, in 1200 frames.
  for (const Method& m : {Method{IntegratorKind::dop853, 1e-12, 2e-10},
                          {IntegratorKind::exact, 0, 1200 * 2 * kEpsilon}}) {
    Scene scene = weightless(tumbling());
    scene.simulation.integrator = m.kind;
    scene.simulation.tolerance = m.tolerance;
    SimulationLayer layer(scene);
    const Vec3 arm(0.1, 0.2, 0.3), weight(0, 0, -1);
    layer.world().held[0].add_force_at(arm, weight);
    const auto energy = [&] {
      const World& w = layer.world();
      return 0.5 * angular_velocity(w, 0).dot(angular_momentum(w.y, 0)) -
             weight.dot(orientation(w.y, 0) * arm);
    };
    const double start = energy();
    double drift = 0;
    for (int n = 1; n <= 1200; ++n) {
      layer.advance_to(n / 60.0);
      drift = std::max(drift, std::abs(energy() / start - 1));
    }
    EXPECT_LT(drift, m.allowed);
    test::measured(m.tolerance > 0 ? "dop853" : "taylor", drift);
  }
}

// F4. There are no torsion springs: four springs of 400 N/m on two arms hold the attitude as
// stiffly.
TEST(HardFlight, AnAttitudeOnStiffSpringsIsFollowedForTwentySeconds) {
  const BodyDef body = tumbling();
  Scene scene = weightless(body);
  test::ReferenceBody model{.mass = 1, .J_B = body.mass_properties.J};
  for (const Vec3& arm : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
    SpringDef spring;
    spring.a = "body";
    spring.point_a = arm;
    spring.point_b = 2 * arm;
    spring.stiffness = 400;
    spring.rest_length = 0.5;
    scene.springs.push_back(spring);
    model.springs.push_back({arm, 2 * arm, 400, 0, 0.5});
  }
  SimulationLayer layer(scene);
  const Drift worst = against(test::reference_of(model, Vec3::Zero(), Quat::Identity(),
                                                 Vec3::Zero(), body.angular_velocity, test::kQuick),
                              layer);
  test::measured("position_m", worst.position);
  EXPECT_LT(worst.orientation, 1e-8);
  EXPECT_LT(worst.position, 1e-8);
}

}  // namespace
}  // namespace poinsot
