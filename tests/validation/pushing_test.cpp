// Pushes: what a held wrench does to a free body.

#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene floating(BodyDef body) {
  Scene scene = test::scene({std::move(body)});
  scene.simulation.gravity.setZero();
  return scene;
}

TEST(Pushing, AForceForATimeGivesItsImpulseAtTheCentreAndOffIt) {
  const Vec3 force(3, -4, 5);
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(0.3, 0.1, -0.2)}) {
    CollisionLayer layer(floating(test::body("box", Box{{1, 0.6, 0.2}}, {0, 0, 0})));
    const double m = layer.world().mass[0];
    layer.world().held[0].add_force_at(point, force);
    test::run_until(layer, 0.5);
    layer.world().held[0] = {};
    test::run_until(layer, 1);
    const Vec3 exact = 0.5 / m * force;
    EXPECT_LT((linear_velocity(layer.world(), 0) - exact).norm(), 1e-12 * exact.norm());
  }
}

TEST(Pushing, ACoupleTurnsADiscByHalfAlphaTSquared) {
  CollisionLayer layer(floating(test::free_body("disc", 1, {2, 2, 1})));
  layer.world().held[0].in_W.torque = {0, 0, 3};
  test::run_until(layer, 1);
  EXPECT_NEAR(angular_velocity(layer.world(), 0).z(), 3, 1e-13);
  const Quat exact(Eigen::AngleAxisd(1.5, Vec3::UnitZ()));
  EXPECT_LT(angle_between(Quat(orientation(layer.world().y, 0)), exact), 1e-9);
}

TEST(Pushing, ABodyForceOfATurningBodyGoesRoundInACircle) {
  // Spin Ω about z and a force F along the body's x: the velocity is F/(mΩ) (sin Ωt, 1 − cos Ωt,
  // 0).
  const double spin = 4, m = 2, F = 6;
  BodyDef disc = test::free_body("disc", m, {2, 2, 1});
  disc.angular_velocity = {0, 0, spin};
  CollisionLayer layer(floating(disc));
  layer.world().held[0].in_B.force = {F, 0, 0};
  test::run_until(layer, 1.5);
  const Vec3 exact = F / (m * spin) * Vec3(std::sin(spin * 1.5), 1 - std::cos(spin * 1.5), 0);
  EXPECT_LT((linear_velocity(layer.world(), 0) - exact).norm(), 1e-8);  // (Ωh)⁴ with h = 1/240
}

TEST(Pushing, AForceAtABodyPointFollowsThePointAsTheBodyTurns) {
  // A compass needle: force F along x at the tip (l, 0, 0) of a needle that starts along y swings
  // as a pendulum, J θ″ = −F l sin θ from rest at θ0 = 90°; energy gives θ′ at θ = 0.
  const double l = 0.5, J = 1, F = 3;
  BodyDef needle = test::free_body("needle", 1, {J, J, J});
  needle.pose.q = Quat(Eigen::AngleAxisd(1.57079632679489661923, Vec3::UnitZ()));
  CollisionLayer layer(floating(needle));
  layer.world().held[0].add_force_at({l, 0, 0}, {F, 0, 0});
  double largest = 0;
  test::run_until(layer, 3, [&](const CollisionLayer& now) {
    largest = std::max(largest, std::abs(angular_velocity(now.world(), 0).z()));
  });
  const double at_bottom = std::sqrt(2 * F * l / J);
  // The largest of the frames misses the peak by at most one frame of its parabola.
  const double curvature = 0.5 * at_bottom * F * l / J / (60.0 * 60.0);
  EXPECT_LE(largest, at_bottom + 1e-9);
  EXPECT_GE(largest, at_bottom - curvature);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-9);
}

TEST(Pushing, AStrongPushDoesNotDriveABodyThroughAThinWall) {
  BodyDef wall = test::body("wall", Box{{0.01, 2, 2}}, {0.5, 0, 0});
  wall.is_static = true;
  Scene scene = test::scene({wall, test::body("ball", Sphere{0.05}, {0, 0, 0})});
  scene.simulation.gravity.setZero();
  CollisionLayer layer(scene);
  layer.world().held[1].in_W.force = {1e6, 0, 0};  // 2e6 m/s²: 33 m in one sub-step
  test::run_until(layer, 0.2, [](const CollisionLayer& now) {
    ASSERT_LT(position(now.world().y, 1).x(), 0.5 - 0.005 - 0.05 + 1e-3);
  });
}

TEST(Pushing, ABodyThatIsFrozenLeavesThoseItTouchesAlone) {
  // One of two boxes on the ground gets an absurd momentum: it is frozen, the other rests on.
  CollisionLayer layer(test::scene({test::ground(), test::body("bad", Box{{1, 1, 1}}, {0, 0, 0.5}),
                                    test::body("good", Box{{1, 1, 1}}, {3, 0, 0.5})}));
  test::run_until(layer, 1);
  momentum(layer.world().y, 1) = Vec3(1e200, 0, -1e200);
  test::run_until(layer, 2);
  EXPECT_EQ(layer.simulation().quarantined(), 1u);
  EXPECT_TRUE(layer.world().moves(2));
  EXPECT_TRUE(layer.world().y.allFinite());
  EXPECT_NEAR((position(layer.world().y, 2) - Vec3(3, 0, 0.5)).norm(), 0, 1e-4);
  EXPECT_TRUE(std::isfinite(layer.energy_error()));
}

}  // namespace
}  // namespace poinsot
