// Coulomb friction: blocks on planes.

#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "support/closed_forms.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

// A block on a plane tilted by θ about y: gravity is turned instead of the plane.
Scene incline(double theta, double mu) {
  BodyDef block = test::body("block", Box{{1, 1, 0.5}}, {0, 0, 0.25});
  block.material.friction = mu;
  Scene scene = test::scene({test::ground(mu), block});
  scene.simulation.gravity = 9.81 * Vec3(std::sin(theta), 0, -std::cos(theta));
  return scene;
}

TEST(Sliding, ABlockStopsAfterItsStoppingDistance) {
  Scene scene = incline(0, 0.3);
  scene.bodies[1].linear_velocity = {5, 0, 0};
  CollisionLayer layer(scene);
  double lift = 0;
  test::run_until(layer, 3, [&](const CollisionLayer& now) {
    lift = std::max(lift, position(now.world().y, 1).z() - 0.25);
  });
  // v²/2μg. The sub-step in which it stops is one force too long: error at most v dt of that step.
  EXPECT_NEAR(position(layer.world().y, 1).x(), 4.24736663, 0.3 * 9.81 / 240 / 240);
  EXPECT_LT(lift, 1e-6);
}

TEST(Sliding, ABlockSticksBelowTheFrictionAngleAndAcceleratesAboveIt) {
  const double mu = 0.5, friction_angle = std::atan(mu);
  {
    CollisionLayer layer(incline(friction_angle - 0.01, mu));
    test::run_until(layer, 10);
    EXPECT_LT(position(layer.world().y, 1).head<2>().norm(), 1e-5);
  }
  CollisionLayer layer(incline(friction_angle + 0.05, mu));
  test::run_until(layer, 2);
  const double a = test::incline_acceleration(9.81, friction_angle + 0.05, mu);
  EXPECT_NEAR(linear_velocity(layer.world(), 1).x(), 2 * a, 2 * a * 1e-3);
}

TEST(Sliding, FrictionIsTheSameInEveryDirection) {
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * 3.14159265358979324 * k / 24;
    Scene scene = incline(0, 0.3);
    scene.bodies[1].linear_velocity = 5 * Vec3(std::cos(angle), std::sin(angle), 0);
    CollisionLayer layer(scene);
    test::run_until(layer, 1);
    EXPECT_NEAR(linear_velocity(layer.world(), 1).norm(), 5 - 0.3 * 9.81, 1e-4);
  }
}

TEST(Sliding, ASphereSlipsUntilItRolls) {
  // v0 = 7, μ = 0.2: rolls from t = 2 v0 / 7 μ g with 5/7 v0.
  BodyDef ball = test::body("ball", Sphere{0.5}, {0, 0, 0.5});
  ball.material.friction = 0.2;
  ball.linear_velocity = {7, 0, 0};
  CollisionLayer layer(test::scene({test::ground(0.2), ball}));
  test::run_until(layer, 1);
  EXPECT_NEAR(linear_velocity(layer.world(), 1).x(), 7 - 0.2 * 9.81, 1e-3);
  test::run_until(layer, 2);
  EXPECT_NEAR(linear_velocity(layer.world(), 1).x(), 5, 1e-3);
  EXPECT_NEAR(angular_velocity(layer.world(), 1).y(), 5 / 0.5, 1e-3 / 0.5);
}

}  // namespace
}  // namespace poinsot
