// Impacts located by the one-sided search, against closed forms.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "poinsot/collision/collision_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;

// A ball of radius 0.1 m over the half-space z ≤ 0, released at rest `height` above it [m].
Scene dropped_ball(double height, double restitution) {
  BodyDef ball = test::body("ball", Sphere{0.1}, {0, 0, 0.1 + height});
  ball.material.restitution = restitution;
  return test::scene({test::ground(), ball});
}

// The closed form: the n-th impact at t₁ + 2 (v₁/g) (e + … + eⁿ), after it a parabola.
struct Bounce {
  double start, speed;  // [s] [m/s] of the flight that contains t; speed 0: at rest
};
Bounce bounce_at(double height, double e, double t) {
  double start = std::sqrt(2 * height / kG), speed = e * kG * start;
  for (int n = 0; n < 1000; ++n) {
    const double flight = 2 * speed / kG;
    if (start + flight > t) return {start, speed};
    start += flight;
    speed *= e;
  }
  return {t, 0};
}
double height_at(double height, double e, double t) {
  if (t * t < 2 * height / kG) return height - 0.5 * kG * t * t;
  const Bounce b = bounce_at(height, e, t);
  const double x = t - b.start;
  return b.speed * x - 0.5 * kG * x * x;
}
double ball_height(const CollisionLayer& layer) {
  return layer.world().y(2, 1) - 0.1;
}

TEST(ExactImpacts, ABallBouncesByItsClosedFormUntilItRests) {
  const double e = 0.8, h = 10;
  CollisionLayer layer(dropped_ball(h, e));
  double next = std::sqrt(2 * h / kG), speed = kG * next;
  int bounces = 0;
  for (int frame = 1; frame <= 900; ++frame) {
    layer.advance_to(frame / 60.0);
    for (const ImpactEvent& impact : layer.impacts()) {
      EXPECT_NEAR(impact.time, next, 1e-10) << bounces;
      EXPECT_NEAR(impact.v_a_before.z(), -speed, 1e-9);
      EXPECT_NEAR(impact.normal.z(), 1, 1e-12);
      speed *= e;
      next += 2 * speed / kG;
      ++bounces;
    }
    ASSERT_NEAR(ball_height(layer), height_at(h, e, frame / 60.0), 1e-9) << frame;
  }
  EXPECT_GT(bounces, 50);
  EXPECT_EQ(layer.report().asleep, 1u);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);
}

TEST(ExactImpacts, AnElasticBallKeepsItsHeightAndItsTimeForAThousandBounces) {
  CollisionLayer layer(dropped_ball(1, 1));
  const double first = std::sqrt(2 / kG);
  int bounces = 0;
  for (int frame = 1; bounces < 1000; ++frame) {
    layer.advance_to(frame / 60.0);
    for (const ImpactEvent& impact : layer.impacts()) {
      const double expected = (2 * bounces + 1) * first;
      ASSERT_NEAR(impact.time, expected, 1e-10 * expected);
      ++bounces;
    }
  }
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);
}

TEST(ExactImpacts, AWholeSequenceOfBouncesFitsIntoOneLongFrame) {
  const double e = 0.9;
  CollisionLayer layer(dropped_ball(1, e));
  for (int frame = 1; frame <= 2; ++frame) {
    layer.advance_to(10.0 * frame);
    EXPECT_NEAR(ball_height(layer), height_at(1, e, 10.0 * frame), 1e-9);
    EXPECT_FALSE(layer.report().crowded);
  }
  EXPECT_LT(linear_velocity(std::as_const(layer).world(), 1).norm(), 1e-9);
}

Scene cradle(int moving) {
  std::vector<BodyDef> balls;
  for (int k = 0; k < 6; ++k) {
    const double x = k < moving ? -1 + 0.2 * k : 0.2 * k;
    BodyDef ball = test::body("ball" + std::to_string(k), Sphere{0.1}, {x, 0, 0});
    ball.material = {0, 1};
    if (k < moving) ball.linear_velocity = {2, 0, 0};
    balls.push_back(ball);
  }
  Scene scene = test::scene(balls);
  scene.simulation.gravity.setZero();
  return scene;
}

TEST(ExactImpacts, OfACradleAsManyBallsLeaveAsCame) {
  for (const int moving : {1, 2, 3}) {
    CollisionLayer layer(cradle(moving));
    for (int frame = 1; frame <= 90; ++frame) layer.advance_to(frame / 60.0);
    for (int k = 0; k < 6; ++k) {
      const Vec3 v = linear_velocity(std::as_const(layer).world(), k);
      EXPECT_NEAR((v - Vec3(k < 6 - moving ? 0 : 2, 0, 0)).norm(), 0, 1e-12) << moving << k;
    }
  }
}

TEST(ExactImpacts, TheUpperBallOfACannonRisesToNineTimesItsHeight) {
  // Limit of a small mass ratio: 9 h for the centre of the upper ball's bounce, to O(ratio).
  BodyDef heavy = test::body("heavy", Sphere{0.1}, {0, 0, 1.1}, 1e6);
  BodyDef light = test::body("light", Sphere{0.01}, {0, 0, 1.211}, 1e3);
  for (BodyDef* ball : {&heavy, &light}) ball->material = {0, 1};
  Scene scene = test::scene({test::ground(0, 1), heavy, light});
  scene.simulation.gravity = {0, 0, -kG};
  CollisionLayer layer(scene);
  double fastest = 0;
  for (int frame = 1; frame <= 40; ++frame) {
    layer.advance_to(frame / 60.0);
    for (const ImpactEvent& impact : layer.impacts())
      for (const Vec3& v : {impact.v_a_after, impact.v_b_after}) fastest = std::max(fastest, v.z());
  }
  EXPECT_NEAR(fastest * fastest / (2 * kG), 9, 0.02);  // the gap of 1 mm, and mass 1e-6
}

TEST(ExactImpacts, ABulletReachesAThinPlateOnTime) {
  BodyDef plate = test::body("plate", Box{{0.001, 2, 2}}, {7.5, 0, 0});
  plate.is_static = true;
  BodyDef bullet = test::body("bullet", Sphere{0.005}, {0, 0, 0});
  bullet.linear_velocity = {1000, 0, 0};
  Scene scene = test::scene({plate, bullet});
  scene.simulation.gravity.setZero();
  CollisionLayer layer(scene);
  layer.advance_to(1.0 / 60);
  ASSERT_EQ(layer.impacts().size(), 1u);
  EXPECT_NEAR(layer.impacts()[0].time, (7.5 - 0.0005 - 0.005) / 1000, 1e-12);
}

TEST(ExactImpacts, ABrickThatFallsFlatRisesWithoutSpin) {
  BodyDef brick = test::body("brick", Box{{1, 0.5, 0.3}}, {0, 0, 1.15});
  brick.material.restitution = 0.5;
  CollisionLayer layer(test::scene({test::ground(), brick}));
  for (int frame = 1; frame <= 30; ++frame) layer.advance_to(frame / 60.0);
  ASSERT_FALSE(std::as_const(layer).world().y.hasNaN());
  // Down 1 m in √(2/g), up again at half the speed.
  const double t = 0.5 - std::sqrt(2 / kG), v = 0.5 * std::sqrt(2 * kG);
  EXPECT_NEAR(std::as_const(layer).world().y(2, 1), 0.15 + v * t - 0.5 * kG * t * t, 1e-12);
  EXPECT_LT(angular_velocity(std::as_const(layer).world(), 1).norm(), 1e-13);
}

// Clearance of a ball that passes another: hit if it is negative, by 1e-6 m and by 1e-9 m.
TEST(ExactImpacts, AGrazingPassIsDecidedRight) {
  for (const double clearance : {1e-6, -1e-6, 1e-9, -1e-9}) {
    BodyDef post = test::body("post", Sphere{0.1}, {0, 0, 0});
    post.is_static = true;
    BodyDef ball = test::body("ball", Sphere{0.1}, {-1, 0.2 + clearance, 0});
    ball.linear_velocity = {5, 0, 0};
    Scene scene = test::scene({post, ball});
    scene.simulation.gravity.setZero();
    CollisionLayer layer(scene);
    std::size_t impacts = 0;
    double time = 0;
    for (int frame = 1; frame <= 30; ++frame) {
      layer.advance_to(frame / 60.0);
      for (const ImpactEvent& impact : layer.impacts()) time = impact.time;
      impacts += layer.impacts().size();
    }
    EXPECT_EQ(impacts, clearance < 0 ? 1u : 0u) << clearance;
    if (clearance > 0) continue;
    const double y = 0.2 + clearance, x = std::sqrt(0.04 - y * y);
    EXPECT_NEAR(time, (1 - x) / 5, 1e-8);
  }
}

}  // namespace
}  // namespace poinsot
