// Impacts with fixed sub-steps: what they promise is first order in the sub-step.

#include <cmath>

#include <gtest/gtest.h>

#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene ball(double restitution, double contact_step) {
  BodyDef def = test::body("ball", Sphere{0.1}, {0, 0, 1.1});
  def.material.restitution = restitution;
  Scene scene = test::scene({test::ground(), def});
  scene.collision.contact_step = contact_step;
  return scene;
}

double highest(CollisionLayer& layer, double from, double to) {
  test::run_until(layer, from);
  double top = 0;
  test::run_until(layer, to, [&](const CollisionLayer& now) {
    top = std::max(top, position(now.world().y, 1).z() - 0.1);
  });
  return top;
}

TEST(Bouncing, ABallRisesToRestitutionSquaredWithinTheSubStep) {
  // First impact after 0.4515 s; apex of the first bounce e² h at 0.4515 (1 + e) s.
  const double e = 0.8, v = std::sqrt(2 * 9.81);
  for (const double step : {1.0 / 240, 1.0 / 960}) {
    CollisionLayer layer(ball(e, step));
    // Contact is made up to one sub-step late or early: v·step in height before and after.
    EXPECT_NEAR(highest(layer, 0.5, 1.1), e * e, 2 * v * step) << step;
  }
}

TEST(Bouncing, AnElasticBallNeitherGainsNorLosesHeightInThirtyBounces) {
  const double step = 1.0 / 3840;
  CollisionLayer layer(ball(1, step));
  const double start = layer.energy();
  test::run_until(layer, 27);
  const double v = std::sqrt(2 * 9.81);
  // Each of the 30 bounces errs by at most v·step of height, either way: 3 % of 1.1 m in all.
  EXPECT_NEAR(layer.energy() / start, 1, 30 * v * step / 1.1);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);  // the books balance all the same
}

TEST(Bouncing, ABallWithoutRestitutionStaysDown) {
  CollisionLayer layer(ball(0, 1.0 / 240));
  test::run_until(layer, 2);
  EXPECT_NEAR(position(layer.world().y, 1).z(), 0.1, 1e-5 * 0.2);  // allowed penetration
  EXPECT_LT(linear_velocity(layer.world(), 1).norm(), 1e-9);
}

TEST(Bouncing, ACubeDroppedFlatDoesNotSpin) {
  BodyDef cube = test::body("cube", Box{{1, 1, 1}}, {0, 0, 1.5});
  cube.material.restitution = 0.5;
  Scene scene = test::scene({test::ground(), cube});
  CollisionLayer layer(scene);
  test::run_until(layer, 1.0);
  // Four corners solved one after the other until no visit changes a velocity by 1e-7 m/s; the
  // residual is that over 1 − the rate of convergence.
  EXPECT_LT(angular_velocity(layer.world(), 1).norm(), 1e-5);
  EXPECT_GT(linear_velocity(layer.world(), 1).z(), 0);
}

TEST(Bouncing, TwoBallsExchangeMomentum) {
  BodyDef left = test::body("left", Sphere{0.1}, {-1, 0, 0});
  BodyDef right = test::body("right", Sphere{0.1}, {0, 0, 0});
  left.linear_velocity = {2, 0, 0};
  left.material.restitution = 1;
  Scene scene = test::scene({left, right});
  scene.simulation.gravity.setZero();
  CollisionLayer layer(scene);
  test::run_until(layer, 1);
  EXPECT_NEAR(linear_velocity(layer.world(), 0).norm(), 0, 1e-12);
  EXPECT_NEAR((linear_velocity(layer.world(), 1) - Vec3(2, 0, 0)).norm(), 0, 1e-12);
}

TEST(Bouncing, AFastBallDoesNotPassAThinWall) {
  BodyDef wall = test::body("wall", Box{{0.01, 2, 2}}, {5, 0, 0});
  wall.is_static = true;
  for (const double speed : {50.0, 100.0, 300.0}) {
    BodyDef ball = test::body("ball", Sphere{0.05}, {0, 0, 0});
    ball.linear_velocity = {speed, 0, 0};
    ball.material.restitution = 0.5;
    CollisionLayer layer(test::scene({wall, ball}));
    test::run_until(layer, 0.5, [&](const CollisionLayer& now) {
      ASSERT_LT(position(now.world().y, 1).x(), 5 - 0.005 - 0.05 + 1e-6) << speed;
    });
    // It is slowed to arrive at the end of a sub-step, and leaves as if it had not been.
    EXPECT_NEAR(linear_velocity(layer.world(), 1).x(), -0.5 * speed, 1e-9 * speed);
  }
}

}  // namespace
}  // namespace poinsot
