// The world is changed between frames: bodies are moved and kicked. What a change does not concern
// goes on to the bit.

#include "support/changes.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

using test::brick, test::column, test::fingerprint, test::on_ground, test::state_of, test::tower,
    test::world_of;

class Changes : public testing::TestWithParam<Profile> {
 protected:
  static CollisionLayer layer(const Scene& scene) {
    return CollisionLayer(test::with_profile(scene, GetParam()));
  }
};
INSTANTIATE_TEST_SUITE_P(Profiles, Changes, testing::ValuesIn(test::kProfiles), test::profile_name);

// Kicks -------------------------------------------------------------------------------------------

TEST_P(Changes, AKickGivesExactlyItsImpulseAndTheBodyHitsWhereItShould) {
  Scene scene = on_ground({test::body("ball", Sphere{0.1}, {0, 0, 5})});
  scene.bodies[1].linear_velocity = {1, 0, 2};
  CollisionLayer sut = layer(scene);
  test::run_until(sut, 0.5);
  const Eigen::Index i = column(sut, "ball");
  const double m = world_of(sut).mass[1];
  const Vec3 P = momentum(world_of(sut).y, i);
  const Vec3 J(0.3 * m, -0.7 * m, 1.1 * m), H(0.01, 0.02, -0.03);
  sut.kick(i, {J, H});
  EXPECT_EQ(Vec3(momentum(world_of(sut).y, i)), Vec3(P + J));
  EXPECT_EQ(Vec3(angular_momentum(world_of(sut).y, i)), H);
  EXPECT_NEAR((linear_velocity(world_of(sut), i) - (P + J) / m).norm(), 0, 1e-15 * 5);
  // A homogeneous ball: ω = H / (2/5 m r²).
  EXPECT_NEAR((angular_velocity(world_of(sut), i) - H / (0.4 * m * 0.01)).norm(), 0, 1e-14);

  const Vec3 c = position(world_of(sut).y, i), v = (P + J) / m;
  const double g = 9.81, fall = (v.z() + std::sqrt(v.z() * v.z() + 2 * g * (c.z() - 0.1))) / g;
  ImpactEvent first{};
  bool hit = false;
  test::run_until(sut, 3, [&](const CollisionLayer& now) {
    if (hit || now.impacts().empty()) return;
    first = now.impacts().front();
    hit = true;
  });
  ASSERT_TRUE(hit);
  EXPECT_NEAR(first.time, 0.5 + fall, 1e-9);
  EXPECT_NEAR(first.point.x(), c.x() + fall * v.x(), 1e-9);
  EXPECT_NEAR(first.point.y(), c.y() + fall * v.y(), 1e-9);
}

// About a principal axis the turn rate is H / J; off the centre, the caller adds r × J.
TEST_P(Changes, AKickedBoxTurnsAboutItsAxisAsTheClosedFormSays) {
  Scene scene = test::scene({test::box("box", {0, 0, 0}, {1, 2, 3}, 6)});
  scene.simulation.gravity = Vec3::Zero();
  CollisionLayer sut = layer(scene);
  test::run_until(sut, 0.25);
  const double J_z = 6.0 / 12 * (1 + 4), omega = 0.8;
  sut.kick(0, {Vec3::Zero(), {0, 0, J_z * omega}});
  test::run_until(sut, 1.25);
  const Quat expected(std::cos(0.5 * omega), 0, 0, std::sin(0.5 * omega));
  EXPECT_NEAR(orientation(world_of(sut).y, 0).angularDistance(expected), 0, 1e-14);
}

TEST_P(Changes, TheWorkOfAKickIsCountedAndItsEnergyIsNoError) {
  CollisionLayer sut = layer(test::scene({test::body("ball", Sphere{0.1}, {0, 0, 5})}));
  test::run_until(sut, 0.5);
  const double before = sut.energy(), work = sut.simulation().work();
  sut.kick(0, {{1, 2, -3}, {0.1, 0, 0}});
  EXPECT_GT(sut.energy() - before, 0.1);
  EXPECT_NEAR(sut.simulation().work() - work, sut.energy() - before, 1e-12);
  test::run_until(sut, 0.8);
  EXPECT_LT(std::abs(sut.energy_error()), 1e-13);
}

TEST_P(Changes, AKickWakesASleepingTowerAndItSlides) {
  CollisionLayer sut = layer(on_ground(tower(3)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 3u);
  const double m = world_of(sut).mass[3];
  sut.kick(column(sut, "box2"), {{m, 0, 0}, Vec3::Zero()});
  EXPECT_FALSE(sut.is_asleep(column(sut, "box0")));
  test::run_until(sut, 4);
  // It slides until friction has taken 1 m/s, so by v²/(2 µ g).
  const double error = GetParam() == Profile::fast ? 1e-2 : 1e-3;
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box2")).x(), 1 / (2 * 0.5 * 9.81), error);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box0")).x(), 0, error);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box2")).z(), 2.5, error);
}

// What rests and is kicked into its support bounces with the pair's restitution.
TEST(Changes, ABallAtRestThatIsKickedDownBounces) {
  Scene scene = test::scene({test::ground(0.5, 0.5), test::body("ball", Sphere{0.1}, {0, 0, 0.1})});
  CollisionLayer sut(scene);
  test::run_until(sut, 1);
  const double m = world_of(sut).mass[1];
  sut.kick(1, {{0, 0, -2 * m}, Vec3::Zero()});
  sut.advance_to(1 + 1.0 / 60);
  ASSERT_EQ(sut.impacts().size(), 1u);
  EXPECT_NEAR(linear_velocity(world_of(sut), 1).z(), 1 - 9.81 / 60, 1e-12);
  EXPECT_LT(std::abs(sut.energy_error()), 1e-12);
}

// States --------------------------------------------------------------------------------------

TEST_P(Changes, ABodyThatIsPutBackRepeatsItsFlightToTheBit) {
  Scene scene = test::scene({test::box("box", {0, 0, 0}, {1, 2, 3})});
  scene.bodies[0].linear_velocity = {1, 2, 3};
  scene.bodies[0].angular_velocity = {0.1, 2, 0.2};
  CollisionLayer fresh = layer(scene), sut = layer(scene);
  scene.bodies[0].linear_velocity = {-4, 0, 1};
  CollisionLayer other = layer(scene);
  const BodyDef& def = scene.bodies[0];
  other.set_state(0, def.pose, {{1, 2, 3}, def.angular_velocity});
  for (int n = 1; n <= 60; ++n) {
    fresh.advance_to(n / 60.0);
    other.advance_to(n / 60.0);
    ASSERT_EQ(state_of(fresh, "box"), state_of(other, "box"));
  }
}

TEST_P(Changes, SetStateIsWhatItSaysOfABodyWhoseCentreOfMassIsNotItsOrigin) {
  Scene scene = test::scene({test::box("box", {0, 0, 5}, {1, 2, 3})});
  scene.bodies[0].mass_properties.center_of_mass = {0.1, 0.2, 0.3};
  CollisionLayer sut = layer(scene);
  test::run_until(sut, 0.3);
  const Pose pose{{1, 2, 3}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  const Velocity velocity{{4, 5, 6}, {0.7, 0.8, 0.9}};
  sut.set_state(0, pose, velocity);
  EXPECT_LT((body_pose(world_of(sut), 0).c - pose.c).norm(), 1e-15);
  EXPECT_EQ(body_pose(world_of(sut), 0).q.coeffs(), pose.q.coeffs());
  EXPECT_LT((linear_velocity(world_of(sut), 0) - velocity.linear).norm(), 1e-14);
  EXPECT_LT((angular_velocity(world_of(sut), 0) - velocity.angular).norm(), 1e-14);
  EXPECT_LT(std::abs(sut.energy_error()), 1e-15);
}

TEST_P(Changes, SleepersWakeWhenTheirSupportIsTakenFromUnderThem) {
  CollisionLayer sut = layer(on_ground(tower(3)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 3u);
  sut.set_state(column(sut, "box0"), {{50, 0, 0.5}, Quat::Identity()}, {});
  test::run_until(sut, 2.1);
  EXPECT_LT(linear_velocity(world_of(sut), column(sut, "box2")).z(), -0.5);
  test::run_until(sut, 6);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box1")).z(), 0.5, 1e-3);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box2")).z(), 1.5, 1e-3);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box0")).x(), 50, 1e-3);
  EXPECT_EQ(sut.report().asleep, 3u);
}

TEST_P(Changes, WhatRestsOnAStaticBodyFallsWhenThatIsMovedAway) {
  const BodyDef table = test::made_static(brick("table", {0, 0, 0.5}));
  CollisionLayer sut = layer(on_ground({table, brick("box", {0, 0, 1.5})}));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 1u);
  sut.set_state(column(sut, "table"), {{5, 0, 0.5}, Quat::Identity()}, {});
  EXPECT_FALSE(sut.is_asleep(column(sut, "box")));
  test::run_until(sut, 5);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box")).z(), 0.5, 1e-6);
  EXPECT_EQ(position(world_of(sut).y, column(sut, "table")).x(), 5);
}

// Pushed out at bounded speed, as at time 0.
TEST_P(Changes, AStaticBodyThatIsMovedIntoASleeperWakesItAndPushesItOut) {
  const BodyDef table = test::made_static(brick("table", {9, 0, 0.5}));
  CollisionLayer sut = layer(on_ground({table, brick("box", {0, 0, 0.5})}));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 1u);
  sut.set_state(column(sut, "table"), {{0.9, 0, 0.5}, Quat::Identity()}, {});
  double fastest = 0;
  test::run_until(sut, 8, [&](const CollisionLayer& now) {
    fastest = std::max(fastest, linear_velocity(now.world(), 2).norm());
  });
  EXPECT_LT(position(world_of(sut).y, column(sut, "box")).x(), -0.0999);
  EXPECT_GT(position(world_of(sut).y, column(sut, "box")).x(), -0.15);
  EXPECT_LT(fastest, 1.1);
}

TEST_P(Changes, ABodyThatIsPutIntoASleepingPileWakesItAndIsPushedOut) {
  std::vector<BodyDef> bodies = tower(3);
  bodies.push_back(brick("other", {20, 0, 0.5}));
  CollisionLayer sut = layer(on_ground(std::move(bodies)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 4u);
  sut.set_state(column(sut, "other"), {{0.7, 0.1, 1}, Quat::Identity()}, {});
  test::run_until(sut, 2.05);
  EXPECT_FALSE(sut.is_asleep(column(sut, "box0")));
  test::run_until(sut, 30);
  EXPECT_EQ(sut.report().asleep, 4u);
  for (const char* name : {"box0", "box1", "box2", "other"})
    EXPECT_GT(position(world_of(sut).y, column(sut, name)).z(), 0.499) << name;
  EXPECT_LT(sut.report().max_penetration, 1e-2);
}

TEST_P(Changes, AKinematicBodyGoesOnEvenlyFromWhereItIsPut) {
  BodyDef belt = test::made_kinematic(brick("belt", {0, 0, 10}));
  belt.linear_velocity = {1, 0, 0};
  CollisionLayer sut = layer(test::scene({belt}));
  test::run_until(sut, 1);
  EXPECT_NEAR(position(world_of(sut).y, 0).x(), 1, 1e-15);
  const Quat half(std::cos(0.25), 0, 0, std::sin(0.25));
  sut.set_state(0, {{5, 6, 7}, half}, {{0, 2, 0}, {0, 0, 0.5}});
  EXPECT_EQ(Vec3(position(world_of(sut).y, 0)), Vec3(5, 6, 7));
  test::run_until(sut, 3);
  EXPECT_LT((position(world_of(sut).y, 0) - Vec3(5, 10, 7)).norm(), 1e-14);
  const Quat turned(std::cos(0.75), 0, 0, std::sin(0.75));
  EXPECT_LT(orientation(world_of(sut).y, 0).angularDistance(turned), 1e-15);
}

TEST_P(Changes, ABoxIsCarriedByAKinematicBodyThatIsPutUnderIt) {
  const BodyDef belt = test::made_kinematic(brick("belt", {50, 0, 0.5}));
  CollisionLayer sut = layer(on_ground({belt, brick("box", {0, 0, 1.5})}));
  sut.set_state(column(sut, "belt"), {{0, 0, 0.5}, Quat::Identity()}, {{0.5, 0, 0}, Vec3::Zero()});
  test::run_until(sut, 1);
  EXPECT_NEAR(linear_velocity(world_of(sut), column(sut, "box")).x(), 0.5, 1e-3);
  EXPECT_NEAR(position(world_of(sut).y, column(sut, "box")).z(), 1.5, 1e-3);
}

TEST_P(Changes, AFrozenBodyMovesAgainOnceItsStateIsSet) {
  CollisionLayer sut = layer(on_ground({brick("box", {0, 0, 3})}));
  sut.world().y(7, 1) = std::nan("");
  sut.advance_to(1.0 / 60);
  ASSERT_EQ(world_of(sut).motion[1], Motion::frozen);
  sut.set_state(1, {{0, 0, 2}, Quat::Identity()}, {});
  EXPECT_EQ(world_of(sut).motion[1], Motion::dynamic);
  test::run_until(sut, 3);
  EXPECT_NEAR(position(world_of(sut).y, 1).z(), 0.5, 1e-6);
  EXPECT_LT(std::abs(sut.energy_error()), 1e-3);
}

// The courses of others ---------------------------------------------------------------------------

TEST_P(Changes, WhatAMoveAndAKickDoNotTouchGoesOnToTheBit) {
  CollisionLayer left_alone = layer(test::several()), sut = layer(test::several());
  for (int n = 1; n <= 240; ++n) {
    if (n == 20) sut.set_state(column(sut, "changed"), {{-25, 0, 3}, Quat::Identity()}, {});
    if (n == 30) sut.kick(column(sut, "changed"), {{10, 0, 0}, {0, 0, 3}});
    if (n == 90) sut.set_state(column(sut, "changed"), {{-20, 0, 0.5}, Quat::Identity()}, {});
    left_alone.advance_to(n / 60.0);
    sut.advance_to(n / 60.0);
    for (const std::string& name : world_of(sut).names) {
      if (name == "changed") continue;
      ASSERT_EQ(state_of(sut, name), state_of(left_alone, name)) << name << ", frame " << n;
    }
  }
}

TEST_P(Changes, OneThreadAndTwoAgreeInEveryBitThroughChanges) {
  Scene scene = test::with_profile(test::several(), GetParam());
  CollisionLayer one(scene);
  scene.collision.threads = 2;
  CollisionLayer two(scene);
  for (int n = 1; n <= 240; ++n) {
    for (CollisionLayer* sut : {&one, &two}) {
      if (n == 40) sut->set_state(column(*sut, "changed"), {{0.3, 0, 2.8}, Quat::Identity()}, {});
      if (n == 60) sut->kick(column(*sut, "falling2"), {{900, 0, 0}, {0, 0, 30}});
      sut->advance_to(n / 60.0);
    }
    ASSERT_EQ(fingerprint(one), fingerprint(two)) << "frame " << n;
  }
}

}  // namespace
}  // namespace poinsot
