// Hard cases D1 … D4: Coulomb friction on planes, against closed forms (hard-case numbers in the
// README).

#include <cmath>

#include <gtest/gtest.h>

#include "support/closed_forms.h"
#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;
constexpr double kPi = 3.14159265358979324;
constexpr int kDirections = 24;

// A block on a plane that falls by θ towards the azimuth φ: gravity is turned instead of the plane.
Scene incline(double theta, double phi, double mu, const Vec3& size = Vec3(1, 1, 0.5)) {
  BodyDef block = test::body("block", Box{size}, {0, 0, size.z() / 2});
  block.material.friction = mu;
  Scene scene = test::scene({test::ground(mu), block});
  const Vec3 down(std::cos(phi), std::sin(phi), 0);
  scene.simulation.gravity = kG * (std::sin(theta) * down - std::cos(theta) * Vec3::UnitZ());
  scene.collision.sleeping = false;
  return scene;
}

double azimuth(int k) {
  return 2 * kPi * k / kDirections;
}

class HardFriction : public testing::TestWithParam<Profile> {
 protected:
  bool accurate() const { return GetParam() == Profile::accurate; }
  Scene profiled(Scene scene) const {
    scene = test::with_profile(std::move(scene), GetParam());
    scene.collision.sleeping = false;  // it has to hold by its contacts
    return scene;
  }
};
INSTANTIATE_TEST_SUITE_P(Profiles, HardFriction, testing::Values(Profile::accurate, Profile::fast),
                         test::profile_name);

// D1: μ = 0.5 holds below 26.5650512°.
TEST_P(HardFriction, ABlockSticksOneMicroradianBelowTheFrictionAngle) {
  const double below = std::atan(0.5) - (accurate() ? 1e-6 : 1e-2);
  double drift = 0;
  for (int k = 0; k < kDirections; k += 5) {
    CollisionLayer layer(profiled(incline(below, azimuth(k), 0.5)));
    test::run_until(layer, 10);
    drift = std::max(drift, position(layer.world().y, 1).head<2>().norm());
  }
  RecordProperty("drift_m", std::to_string(drift * 1e12) + "e-12");
  EXPECT_LT(drift, accurate() ? 1e-9 : 1e-3);
}

TEST_P(HardFriction, ABlockSlidesOneMicroradianAboveTheFrictionAngle) {
  const double above = std::atan(0.5) + (accurate() ? 1e-6 : 1e-2);
  const double a = test::incline_acceleration(kG, above, 0.5);
  for (int k = 0; k < kDirections; k += 5) {
    CollisionLayer layer(profiled(incline(above, azimuth(k), 0.5)));
    test::run_until(layer, 10);
    // The difference of two near-equal forces: known to 1e-9 of each at best.
    const double way = position(layer.world().y, 1).head<2>().norm();
    EXPECT_NEAR(way, 50 * a, accurate() ? 50 * kG * 1e-9 : 0.05 * 50 * a) << k;
  }
}

TEST_P(HardFriction, ASlidingBlockAcceleratesAsItShouldInEveryDirection) {
  const double a = test::incline_acceleration(kG, kPi / 6, 0.5);
  double least = 1e9, most = 0;
  for (int k = 0; k < kDirections; ++k) {
    CollisionLayer layer(profiled(incline(kPi / 6, azimuth(k), 0.5)));
    test::run_until(layer, 2);
    const Vec3 c = position(layer.world().y, 1);
    least = std::min(least, c.head<2>().norm());
    most = std::max(most, c.head<2>().norm());
    EXPECT_NEAR(std::remainder(std::atan2(c.y(), c.x()) - azimuth(k), 2 * kPi), 0, 1e-9);
  }
  EXPECT_NEAR(least, 2 * a, 2 * a * (accurate() ? 1e-6 : 2e-2));
  EXPECT_NEAR(most, 2 * a, 2 * a * (accurate() ? 1e-6 : 2e-2));
  EXPECT_LT(most - least, 1e-9 * 2 * a);  // D4: isotropic
}

// D2: a block of b/h = 0.5 and enough friction tips where tan θ = b/h.
TEST_P(HardFriction, ABlockTipsAboveTheAngleAtWhichItsWeightLeavesItsBase) {
  const double threshold = std::atan(0.5), off = accurate() ? 1e-6 : 1e-2;
  const auto tilt_after = [&](double theta, double seconds) {
    CollisionLayer layer(profiled(incline(theta, 0, 1, {0.5, 0.5, 1})));
    test::run_until(layer, seconds);
    return orientation(layer.world().y, 1).angularDistance(Quat::Identity());
  };
  // The tilt grows by e in 1/p, p² = 3g/4R: from 1e-6 to 0.1 rad in some 4.5 s.
  EXPECT_GT(tilt_after(threshold + off, 8), 0.1);
  EXPECT_LT(tilt_after(threshold - off, 8), accurate() ? 1e-9 : 1e-3);
}

// D3: v0 = 5, μ = 0.3.
TEST_P(HardFriction, ASlidingBlockStopsWhereItShouldAndNeverLiftsOff) {
  Scene scene = incline(0, 0, 0.3);
  scene.bodies[1].linear_velocity = {5, 0, 0};
  CollisionLayer layer(profiled(scene));
  double lift = 0;
  test::run_until(layer, 3, [&](const CollisionLayer& now) {
    lift = std::max(lift, position(now.world().y, 1).z() - 0.25);
  });
  // Fast: stepped, v0 h / 2.
  const double tolerance = accurate() ? 1e-9 : 5 * layer.time() / 180 / 4 / 2;
  EXPECT_NEAR(position(layer.world().y, 1).x(), 4.24736663, 5e-9 + tolerance);
  EXPECT_LT(lift, accurate() ? 1e-9 : 1e-6);
  EXPECT_LT(linear_velocity(layer.world(), 1).norm(), 1e-9);
}

// B5: a solid sphere, v0 = 7, μ = 0.2.
TEST_P(HardFriction, ASlippingSphereRollsAfterItsClosedForm) {
  BodyDef ball = test::body("ball", Sphere{0.5}, {0, 0, 0.5});
  ball.material.friction = 0.2;
  ball.linear_velocity = {7, 0, 0};
  CollisionLayer layer(profiled(test::scene({test::ground(0.2), ball})));
  test::run_until(layer, 2);
  const double tolerance = accurate() ? 1e-9 : 0.02;
  EXPECT_NEAR(linear_velocity(layer.world(), 1).x(), 5, 5 * tolerance);
  EXPECT_NEAR(angular_velocity(layer.world(), 1).y(), 10, 10 * tolerance);
  EXPECT_NEAR(position(layer.world().y, 1).x(), 6.11620795 + 5 * (2 - 1.01936799),
              11 * tolerance + 1e-8);  // of the digits given
}

// B8: rolling down 30°: sphere, cylinder, hoop.
TEST_P(HardFriction, RoundBodiesRollDownAsTheirInertiaSays) {
  BodyDef hoop = test::body("body", Cylinder{0.5, 0.2}, {0, 0, 0.5});
  const double m = hoop.mass_properties.mass;
  hoop.mass_properties.J = (m * 0.25 * Vec3(0.5, 0.5, 1)).asDiagonal();
  struct Case {
    BodyDef body;
    double acceleration;
  } cases[] = {{test::body("body", Sphere{0.5}, {0, 0, 0.5}), 3.50357142857142857},
               {test::body("body", Cylinder{0.5, 0.2}, {0, 0, 0.5}), 3.27},
               {hoop, 2.4525}};
  for (Case& one : cases) {
    if (std::holds_alternative<Cylinder>(one.body.shapes[0].shape))
      one.body.pose.q = Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
    Scene scene = incline(kPi / 6, 0, 1);
    one.body.material.friction = 1;
    scene.bodies[1] = one.body;
    CollisionLayer layer(profiled(scene));
    test::run_until(layer, 2);
    const double v = linear_velocity(layer.world(), 1).x();
    EXPECT_NEAR(v, 2 * one.acceleration, 2 * one.acceleration * (accurate() ? 1e-9 : 0.02));
    EXPECT_NEAR(position(layer.world().y, 1).x(), 2 * one.acceleration,
                2 * one.acceleration * (accurate() ? 1e-8 : 0.02));
  }
}

}  // namespace
}  // namespace poinsot
