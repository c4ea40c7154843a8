// Hard cases C1 … C21: impacts and events, from scene to impact. README.md lists them all.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/collision/collision_layer.h"
#include "support/measured.h"
#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;         // [m/s²]
constexpr double kSettled = 1e-12;  // [m/s] what rests is slower

Scene dropped_ball(double restitution) {
  BodyDef ball = test::body("ball", Sphere{0.1}, {0, 0, 1.1});
  ball.material.restitution = restitution;
  return test::scene({test::ground(), ball});
}

// C1. Times of the impacts, length of the path, and the time of rest: (1 + e)/(1 − e) √(2h/g).
TEST(HardImpacts, ABallThatBouncesForEverInFiniteTimeComesToRestThen) {
  struct Case {
    double e, rest, path;
  };
  const double first = 0.45152364;
  for (const Case& c : {Case{0.8, 4.06371277, 4.55555556}, {0.5, 1.35457092, 5.0 / 3}}) {
    CollisionLayer layer(test::with_profile(dropped_ball(c.e), Profile::accurate));
    double next = std::sqrt(2 / kG), speed = kG * next, path = 1, late = 0, last = 0;
    ASSERT_NEAR(next, first, 1e-8);
    test::run_until(layer, 5, [&](const CollisionLayer& now) {
      for (const ImpactEvent& impact : now.impacts()) {
        if (impact.v_a_before.z() > -kSettled) continue;  // it settles
        late = std::max(late, std::abs(impact.time - next));
        last = impact.time;
        speed *= c.e;
        next += 2 * speed / kG;
        path += impact.v_a_after.z() * impact.v_a_after.z() / kG;
      }
      // What is left of the sequence is not flown: 4e-3 of a sub-step is its longest flight.
      if (now.time() > c.rest) {
        ASSERT_LT(linear_velocity(now.world(), 1).norm(), kSettled);
        ASSERT_NEAR(position(now.world().y, 1).z(), 0.1, 1e-9);
      }
    });
    const double left_out = 4e-3 * collision_defaults(Profile::accurate).contact_step;
    EXPECT_LT(late, 1e-9);
    EXPECT_NEAR(path, c.path, 1e-8);  // digits given; what is left out is 1e-10
    EXPECT_GE(last, c.rest - left_out / (1 - c.e) - 1e-8);
    EXPECT_LE(last, c.rest + 1e-8);
    const std::string e = c.e > 0.6 ? "e8_" : "e5_";
    test::measured(e + "impact_time_s", late);
    test::measured(e + "rest_time_s", c.rest - last);
    test::measured(e + "path_m", path - c.path);
  }
}

// C1 [fast]. Sub-steps may know an impact to one of them only: v·h of height each time.
TEST(HardImpacts, InTheFastProfileABallRisesToRestitutionSquaredWithinItsSubStep) {
  const Scene scene = test::with_profile(dropped_ball(0.8), Profile::fast);
  CollisionLayer layer(scene);
  test::run_until(layer, 0.5);
  double top = 0;
  test::run_until(layer, 1.1, [&](const CollisionLayer& now) {
    top = std::max(top, position(now.world().y, 1).z() - 0.1);
  });
  const double v = std::sqrt(2 * kG);
  // The frames miss the apex by half of one.
  const double between_frames = kG / 8 / (test::kFrameRate * test::kFrameRate);
  test::measured("height_m", top - 0.64);
  EXPECT_NEAR(top, 0.64, 2 * v * scene.collision.contact_step + between_frames);
  test::run_until(layer, 6);
  EXPECT_NEAR(position(layer.world().y, 1).z(), 0.1, 1e-3);
  EXPECT_LT(linear_velocity(layer.world(), 1).norm(), 1e-6);
}

// C2. Ten thousand bounces: the height stays, the n-th impact is at (2n − 1) √(2h/g).
TEST(HardImpacts, AnElasticBallKeepsItsHeightForTenThousandBounces) {
  CollisionLayer layer(test::with_profile(dropped_ball(1), Profile::accurate));
  const double first = std::sqrt(2 / kG), start = layer.energy();
  int bounces = 0;
  double late = 0, drift = 0;
  for (int frame = 1; bounces < 10'000; ++frame) {
    layer.advance_to(0.5 * frame);
    drift = std::max(drift, std::abs(layer.energy() / start - 1));
    for (const ImpactEvent& impact : layer.impacts()) {
      const double expected = (2 * bounces + 1) * first;
      late = std::max(late, std::abs(impact.time / expected - 1));
      ++bounces;
    }
    ASSERT_LT(frame, 20'000);
  }
  test::measured("time_relative", late);
  test::measured("energy_relative", drift);
  EXPECT_LT(late, 1e-10);
  EXPECT_LT(drift, 1e-12);
}

// C4. Balls that touch and fall together, each a millionth of the one below: the top one leaves at
// (2ⁿ − 1) times the speed, to a few times the ratio.
TEST(HardImpacts, OfTouchingBallsThatFallTheTopOneLeavesAtSevenTimesTheSpeed) {
  for (const int n : {2, 3}) {
    std::vector<BodyDef> bodies{test::ground(0, 1)};
    double density = 1e9;
    for (int k = 0; k < n; ++k, density *= 1e-6) {
      bodies.push_back(
          test::body("ball" + std::to_string(k), Sphere{0.5}, {0, 0, 1.5 + k}, density));
      bodies.back().material = {0, 1};
    }
    CollisionLayer layer(test::with_profile(test::scene(bodies), Profile::accurate));
    const double v2 = 2 * kG;
    double fastest = 0;
    test::run_until(layer, 0.5, [&](const CollisionLayer& now) {
      for (const ImpactEvent& impact : now.impacts())
        for (const Vec3& v : {impact.v_a_after, impact.v_b_after})
          fastest = std::max(fastest, v.z());
    });
    const double height = fastest * fastest / v2, limit = std::pow(std::pow(2, n) - 1, 2);
    test::measured("height_relative_" + std::to_string(n), height / limit - 1);
    EXPECT_NEAR(height / limit, 1, 1e-5);
  }
}

// C6. Five balls, touching; further rows in ExactImpacts.OfACradleAsManyBallsLeaveAsCame.
TEST(HardImpacts, OfACradleOfFiveAsManyLeaveAsCame) {
  for (const int moving : {1, 2, 3}) {
    std::vector<BodyDef> balls;
    for (int k = 0; k < 5; ++k) {
      balls.push_back(test::body("ball" + std::to_string(k), Sphere{0.1},
                                 {0.2 * k - (k < moving ? 0.5 : 0), 0, 0}));
      balls.back().material = {0, 1};
      if (k < moving) balls.back().linear_velocity = {1, 0, 0};
    }
    Scene scene = test::with_profile(test::scene(balls), Profile::accurate);
    scene.simulation.gravity.setZero();
    CollisionLayer layer(scene);
    test::run_until(layer, 1);
    double worst = 0;
    for (int k = 0; k < 5; ++k)
      worst = std::max(
          worst, (linear_velocity(layer.world(), k) - Vec3(k < 5 - moving ? 0 : 1, 0, 0)).norm());
    EXPECT_LT(worst, 1e-12) << moving;
    test::measured("velocity_" + std::to_string(moving), worst);
  }
}

// C7. Two balls hit a third from ±60° at once, in either order of the bodies.
TEST(HardImpacts, AMirrorImageStaysOne) {
  for (const double e : {1.0, 0.5}) {
    StateArray reference;
    for (const bool exchanged : {false, true}) {
      const double c = 0.5, s = std::sqrt(3.0) / 2;
      std::vector<BodyDef> balls;
      for (const double side : exchanged ? std::array{-1.0, 1.0} : std::array{1.0, -1.0}) {
        balls.push_back(
            test::body(side > 0 ? "left" : "right", Sphere{0.1}, {-0.7 * c, side * 0.7 * s, 0}));
        balls.back().linear_velocity = {2 * c, -side * 2 * s, 0};
      }
      balls.push_back(test::body("third", Sphere{0.1}, {0, 0, 0}));
      for (BodyDef& ball : balls) ball.material = {0, e};
      Scene scene = test::with_profile(test::scene(balls), Profile::accurate);
      scene.simulation.gravity.setZero();
      CollisionLayer layer(scene);
      const double energy = layer.energy(), mass = layer.world().mass[0];
      Vec3 before = Vec3::Zero(), after = Vec3::Zero();
      for (int k = 0; k < 3; ++k) before += momentum(layer.world().y, k);
      test::run_until(layer, 1);
      const StateArray& y = std::as_const(layer).world().y;
      for (int k = 0; k < 3; ++k) after += momentum(y, k);
      const Vec3 one = momentum(y, 0) / mass, other = momentum(y, 1) / mass;
      const double asymmetry =
          std::max({std::abs(one.x() - other.x()), std::abs(one.y() + other.y()),
                    std::abs(momentum(y, 2).y()) / mass});
      EXPECT_LE(asymmetry, 1e-15) << e;
      EXPECT_LE((after - before).norm() / mass, 1e-14) << e;
      if (e == 1) {
        EXPECT_NEAR(layer.energy() / energy, 1, 1e-14);
      }
      test::measured(e == 1 ? "asymmetry_e1" : "asymmetry_e05", asymmetry);
      if (!exchanged) {
        reference = y;
        continue;
      }
      EXPECT_LE((y.col(0) - reference.col(1)).cwiseAbs().maxCoeff() / mass, 1e-15);
      EXPECT_LE((y.col(2) - reference.col(2)).cwiseAbs().maxCoeff() / mass, 1e-15);
    }
  }
}

// C10. A cube lands on its corner, its diagonal upright.
TEST(HardImpacts, ACubeThatLandsOnItsCornerDoesNotSpin) {
  BodyDef cube = test::body("cube", Box{{1, 1, 1}}, {0, 0, std::sqrt(3.0) / 2 + 1});
  cube.pose.q = Quat::FromTwoVectors(Vec3(-1, -1, -1), Vec3(0, 0, -1));
  cube.material.restitution = 0.7;
  for (const double friction : {0.0, 0.5}) {
    Scene scene =
        test::with_profile(test::scene({test::ground(friction), cube}), Profile::accurate);
    scene.bodies[1].material.friction = friction;
    CollisionLayer layer(scene);
    int impacts = 0;
    test::run_until(layer, 0.6, [&](const CollisionLayer& now) {
      for (const ImpactEvent& impact : now.impacts()) {
        ++impacts;
        const double asked = -0.7 * impact.v_a_before.z();
        EXPECT_NEAR(impact.v_a_after.z(), asked, 1e-13);
        EXPECT_NEAR(impact.v_a_after.head<2>().norm(), 0, 1e-13);
        EXPECT_NEAR(impact.w_a_after.norm(), 0, 1e-13);
        test::measured("spin_rad_s", impact.w_a_after.norm());
      }
    });
    EXPECT_EQ(impacts, 1);
  }
}

// C18 in both profiles: a brick falls flat. Sub-steps may be late by one: g h of speed.
TEST(HardImpacts, ABrickThatFallsFlatRisesFlat) {
  for (const Profile profile : test::kProfiles) {
    BodyDef brick = test::body("brick", Box{{1, 0.5, 0.3}}, {0, 0, 1.15});
    brick.material.restitution = 0.5;
    const Scene scene = test::with_profile(test::scene({test::ground(), brick}), profile);
    CollisionLayer layer(scene);
    test::run_until(layer, 0.5);
    const double fall = std::sqrt(2 / kG), v = 0.5 * kG * fall - kG * (0.5 - fall);
    const double speed_error = std::abs(linear_velocity(layer.world(), 1).z() - v);
    const double spin = angular_velocity(layer.world(), 1).norm();
    const bool accurate = profile == Profile::accurate;
    EXPECT_LT(speed_error, accurate ? 1e-12 : 2 * kG * scene.collision.contact_step);
    EXPECT_LT(spin, accurate ? 1e-13 : 1e-3);
    test::measured(accurate ? "speed" : "fast_speed", speed_error);
    test::measured(accurate ? "spin" : "fast_spin", spin);
  }
}

}  // namespace
}  // namespace poinsot
