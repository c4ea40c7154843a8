// Bodies in the air: parabolas, symmetric tops, the tennis racket.

#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "support/closed_forms.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

TEST(Flight, AProjectileFollowsItsParabolaWhileItTumbles) {
  BodyDef box = test::body("box", Box{{1, 0.6, 0.2}}, {1, 2, 3});
  box.linear_velocity = {4, -2, 10};
  box.angular_velocity = {3, 5, -1};
  const Scene scene = test::scene({box});
  CollisionLayer layer(scene);
  test::run_until(layer, 10);
  const Vec3 exact = test::ballistic({1, 2, 3}, {4, -2, 10}, scene.simulation.gravity, 10);
  // rk4 is exact for a parabola: rounding of 2400 sums of numbers up to 400.
  EXPECT_NEAR((position(layer.world().y, 0) - exact).norm(), 0, 2400 * 400 * 1.2e-16);
}

TEST(Flight, RotationDoesNotKnowOfGravity) {
  BodyDef box = test::body("box", Box{{1, 0.6, 0.2}}, {0, 0, 0});
  box.angular_velocity = {3, 5, -1};
  Scene scene = test::scene({box});
  CollisionLayer falling(scene);
  scene.simulation.gravity.setZero();
  CollisionLayer floating(scene);
  test::run_until(falling, 2);
  test::run_until(floating, 2);
  EXPECT_EQ(orientation(falling.world().y, 0).coeffs(),
            orientation(floating.world().y, 0).coeffs());
}

TEST(Flight, ASymmetricTopPrecesses) {
  BodyDef top = test::free_body("top", 1, {2, 2, 1});
  const Vec3 omega(1, 0.5, 3);
  top.angular_velocity = omega;
  CollisionLayer layer(test::scene({top}));
  test::run_until(layer, 10);
  const Quat exact = test::symmetric_top(Quat::Identity(), 2, 1, omega, 10);
  // Global error of rk4: about (|ω| h)⁴ |ω| t / 120 with h = 1/240.
  EXPECT_LT(angle_between(Quat(orientation(layer.world().y, 0)), exact), 1e-8);
}

TEST(Flight, TheTennisRacketFlipsWhenTheEllipticIntegralSays) {
  // I = (1, 2, 3), ω = (1e-3, 5, 1e-3): ω₂ changes sign every 2K/p. Landau, Lifshitz, §37.
  const Vec3 I(1, 2, 3), omega(1e-3, 5, 1e-3);
  BodyDef racket = test::free_body("racket", 1, I);
  racket.angular_velocity = omega;
  Scene scene = test::scene({racket});
  scene.collision.contact_step = 1e-3;
  CollisionLayer layer(scene);
  std::vector<double> flips;
  double last = 5, last_t = 0;
  test::run_until(layer, 20, [&](const CollisionLayer& now) {
    const World& world = now.world();
    const double along = (rotation(world, 0).transpose() * angular_velocity(world, 0)).y();
    if (last * along < 0) flips.push_back(last_t + last / (last - along) * (now.time() - last_t));
    last = along;
    last_t = now.time();
  });
  // k'² and p of this motion from its momenta, by the formulas of §37.
  const double half_period = 2 * test::elliptic_K(7.999999040e-8) / 2.88675151915;
  ASSERT_EQ(flips.size(), 3u);
  // The crossing is interpolated between frames, T²/8 of a curvature that vanishes with ω₂.
  EXPECT_NEAR(flips[1] - flips[0], half_period, 1e-4);
  EXPECT_NEAR(flips[2] - flips[1], half_period, 1e-4);
}

TEST(Flight, EnergyOfATumblingBodyIsKeptToTheOrderOfTheMethod) {
  const auto error = [](IntegratorKind kind, double step) {
    BodyDef box = test::body("box", Box{{1, 0.6, 0.2}}, {0, 0, 0});
    box.angular_velocity = {3, 5, -1};
    Scene scene = test::scene({box});
    scene.simulation.integrator = kind;
    scene.simulation.gravity.setZero();
    scene.collision.contact_step = step;
    CollisionLayer layer(scene);
    test::run_until(layer, 2);
    return std::abs(layer.energy_error());
  };
  const double rk4 =
      std::log2(error(IntegratorKind::rk4, 1.0 / 60) / error(IntegratorKind::rk4, 1.0 / 120));
  EXPECT_GT(rk4, 3.9);  // 5 for the energy of a linear oscillation, 4 in general
  const double euler = std::log2(error(IntegratorKind::semi_implicit_euler, 1.0 / 960) /
                                 error(IntegratorKind::semi_implicit_euler, 1.0 / 1920));
  EXPECT_NEAR(euler, 1, 0.1);
}

}  // namespace
}  // namespace poinsot
