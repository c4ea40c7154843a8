// What may sleep, what must not, and what wakes.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene tower(int boxes) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int k = 0; k < boxes; ++k)
    bodies.push_back(test::body("box" + std::to_string(k), Box{{1, 1, 1}}, {0, 0, 0.5 + k}));
  return test::scene(std::move(bodies));
}

TEST(Sleeping, ATowerFallsAsleepAndThenNothingIsDone) {
  CollisionLayer layer(tower(3));
  test::run_until(layer, 20);
  EXPECT_EQ(layer.report().asleep, 3u);
  EXPECT_EQ(layer.report().islands, 0u);
  EXPECT_EQ(layer.report().searches, 0u);
  const StateArray before = std::as_const(layer).world().y;
  test::run_until(layer, 21);
  EXPECT_EQ(std::as_const(layer).world().y, before);
}

// A tower that is built at rest is proven at the first look, whatever its height; one look is made
// every eight frames.
TEST(Sleeping, TowersSleepAtTheFirstLook) {
  for (const int boxes : {1, 10, 30}) {
    CollisionLayer layer(tower(boxes));
    test::run_until(layer, 0.3);
    EXPECT_EQ(layer.report().asleep, static_cast<std::uint32_t>(boxes));
  }
}

TEST(Sleeping, AWallSleepsAtTheFirstLook) {
  constexpr int kWide = 12, kHigh = 8;
  std::vector<BodyDef> bodies = {test::ground()};
  for (int z = 0; z < kHigh; ++z)
    for (int x = 0; x < kWide; ++x)
      bodies.push_back(test::body("brick" + std::to_string(kWide * z + x), Box{{0.98, 0.5, 0.5}},
                                  {x + 0.25 * (z % 2), 0, 0.25 + 0.5 * z}));
  CollisionLayer layer(test::scene(std::move(bodies)));
  test::run_until(layer, 0.5);
  EXPECT_EQ(layer.report().asleep, static_cast<std::uint32_t>(kWide * kHigh));
}

TEST(Sleeping, APushWakesTheWholeTower) {
  CollisionLayer layer(tower(3));
  test::run_until(layer, 20);
  ASSERT_EQ(layer.report().asleep, 3u);
  layer.world().held[2].in_W.force = {3000, 0, 0};
  test::run_until(layer, 20.1);
  EXPECT_EQ(layer.report().asleep, 0u);
  EXPECT_NE(linear_velocity(std::as_const(layer).world(), 3).norm(), 0);
}

TEST(Sleeping, WhatIsHitWakes) {
  Scene scene = tower(2);
  BodyDef ball = test::body("ball", Sphere{0.2}, {0, 0, 900});
  scene.bodies.push_back(ball);
  CollisionLayer layer(scene);
  double fell_asleep = 0, woke = 0;
  test::run_until(layer, 14, [&](const CollisionLayer& now) {
    if (fell_asleep == 0 && now.is_asleep(1)) fell_asleep = now.time();
    if (fell_asleep > 0 && woke == 0 && !now.is_asleep(1)) woke = now.time();
  });
  EXPECT_GT(fell_asleep, 0);
  EXPECT_NEAR(woke, std::sqrt(2 * (900 - 2.2) / 9.81), 2.0 / 60);
}

TEST(Sleeping, ABallThatRollsEvenlyNeverSleepsHoweverSlowly) {
  for (const double speed : {1e-3, 1e-5, 1e-7}) {
    BodyDef ball = test::body("ball", Sphere{0.5}, {0, 0, 0.5});
    ball.linear_velocity = {speed, 0, 0};
    ball.angular_velocity = {0, 2 * speed, 0};
    CollisionLayer layer(test::scene({test::ground(), ball}));
    test::run_until(layer, 10);
    EXPECT_FALSE(layer.is_asleep(1)) << speed;
    EXPECT_NEAR(std::as_const(layer).world().y(0, 1), 10 * speed, 1e-3 * speed);
  }
}

// 1e-4 rad short of sliding it may sleep; beyond it must slide.
TEST(Sleeping, ABlockOnAnInclineSleepsOnlyIfFrictionHoldsIt) {
  for (const double excess : {-0.05, 1e-4}) {
    const double slope = std::atan(0.5) + excess;
    BodyDef ground = test::ground(0.5);
    ground.pose.q = Quat(Eigen::AngleAxisd(slope, Vec3::UnitY()));
    BodyDef block = test::body("block", Box{{1, 1, 0.2}}, Vec3::Zero());
    block.pose.q = ground.pose.q;
    block.pose.c = ground.pose.q * Vec3(0, 0, 0.1);
    CollisionLayer layer(test::scene({ground, block}));
    test::run_until(layer, 10);
    EXPECT_EQ(layer.is_asleep(1), excess < 0) << excess;
  }
}

}  // namespace
}  // namespace poinsot
