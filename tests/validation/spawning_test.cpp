// Bodies come and go between frames. A world that was changed is the same as one that was so from
// the start, and what a change does not concern goes on to the bit.

#include <cmath>
#include <malloc.h>
#include <utility>

#include <gtest/gtest.h>

#include "poinsot/scene/shape.h"
#include "support/changes.h"
#include "support/meshes.h"
#include "support/profiles.h"
#include "support/run.h"

namespace poinsot {
namespace {

using test::brick, test::column, test::fingerprint, test::on_ground, test::place_of, test::state_of,
    test::tower, test::world_of;

class Spawning : public testing::TestWithParam<Profile> {
 protected:
  static CollisionLayer layer(const Scene& scene) {
    return CollisionLayer(test::with_profile(scene, GetParam()));
  }
};
INSTANTIATE_TEST_SUITE_P(Profiles, Spawning, testing::ValuesIn(test::kProfiles),
                         test::profile_name);

void expect_same_run(CollisionLayer& one, CollisionLayer& two, int frames) {
  for (int n = 1; n <= frames; ++n) {
    const double t = one.time() + 1 / test::kFrameRate;
    one.advance_to(t);
    two.advance_to(t);
    ASSERT_EQ(fingerprint(one), fingerprint(two)) << "frame " << n;
  }
}

BodyDef next_of(const CollisionLayer& layer, Eigen::Index i, BodyDef body) {
  body.generation = world_of(layer).ids[static_cast<std::size_t>(i)].generation + 1;
  return body;
}

// One of each shape that may move, and a compound.
std::vector<BodyDef> all_shapes() {
  std::vector<BodyDef> bodies;
  const std::vector<Vec3> corners = {{0, 0, 0.3}, {0.3, 0, -0.2}, {-0.2, 0.3, -0.2}, {0, -0.3, 0}};
  for (const Shape& shape :
       std::vector<Shape>{Sphere{0.2}, Box{{0.5, 0.4, 0.3}}, Capsule{0.15, 0.3}, Cylinder{0.2, 0.4},
                          Cone{0.2, 0.4}, Ellipsoid{{0.2, 0.25, 0.3}}, convex_hull(corners)}) {
    const double x = 0.45 * static_cast<double>(bodies.size() % 3);
    const double z = 0.4 + 0.5 * static_cast<double>(bodies.size() / 3);
    bodies.push_back(test::body("body" + std::to_string(bodies.size()), shape, {x, 0, z}));
  }
  BodyDef dumbbell = test::body("dumbbell", Box{{1, 0.2, 0.2}}, {0.4, 0.1, 2.4});
  dumbbell.shapes.push_back({Sphere{0.2}, Pose{{0.5, 0, 0}, Quat::Identity()}});
  dumbbell.shapes.push_back({Sphere{0.2}, Pose{{-0.5, 0, 0}, Quat::Identity()}});
  bodies.push_back(std::move(dumbbell));
  return bodies;
}

// The same as from the start ----------------------------------------------------------------------

TEST_P(Spawning, AWorldThatIsSpawnedBodyByBodyIsTheOneMadeAtOnce) {
  CollisionLayer made = layer(on_ground(all_shapes())), sut = layer(test::scene({}));
  EXPECT_EQ(sut.spawn(test::ground()), 0);
  for (const BodyDef& body : all_shapes()) sut.spawn(body);
  expect_same_run(made, sut, 240);
}

TEST_P(Spawning, ManyBodiesSpawnedOneByOneAreTheOnesMadeAtOnce) {
  std::vector<BodyDef> bodies;
  for (int k = 0; k < 75; ++k)  // many enough for a crowd
    bodies.push_back(test::body("ball" + std::to_string(k), Sphere{0.2},
                                {0.39 * (k % 5), 0.39 * (k / 5 % 5), 0.3 + 0.5 * (k / 25)}));
  CollisionLayer made = layer(on_ground(bodies)), sut = layer(on_ground({}));
  for (const BodyDef& body : bodies) sut.spawn(body);
  expect_same_run(made, sut, 20);
}

// The body that comes has more shapes than the one that went: whatever is numbered by shapes moves.
TEST_P(Spawning, AColumnThatIsTakenAgainIsLikeNew) {
  std::vector<BodyDef> bodies = all_shapes();
  const BodyDef dumbbell = bodies.back();
  bodies.pop_back();
  CollisionLayer sut = layer(on_ground(bodies));
  const Eigen::Index i = column(sut, "body3");
  sut.remove(i);
  EXPECT_EQ(sut.spawn(next_of(sut, i, dumbbell)), i);
  bodies[3] = dumbbell;
  bodies[3].generation = 2;
  CollisionLayer made = layer(on_ground(bodies));
  expect_same_run(made, sut, 240);
}

TEST_P(Spawning, ASceneWithAnAbsentBodyIsAWorldFromWhichItWasRemoved) {
  std::vector<BodyDef> bodies = all_shapes();
  CollisionLayer sut = layer(on_ground(bodies));
  sut.remove(3);
  bodies[2] = {};
  bodies[2].absent = true;
  const Scene scene = on_ground(bodies);
  EXPECT_TRUE(validate(scene).empty());
  CollisionLayer made = layer(scene);
  expect_same_run(made, sut, 120);
}

// In a world that ran, with whoever had the column before asleep in a contact.
TEST_P(Spawning, ABodyThatComesLaterIsTheOneThatWasPutThere) {
  BodyDef body = test::box("body", {3, 0, 2}, {0.3, 0.4, 0.5});
  body.linear_velocity = {0.1, 0.2, 0.3};
  body.angular_velocity = {0.1, 3, 0.2};
  CollisionLayer moved = layer(on_ground({body})), sut = layer(on_ground(tower(1)));
  test::run_until(moved, 1);
  test::run_until(sut, 1);
  ASSERT_EQ(sut.report().asleep, 1u);
  moved.set_state(1, body.pose, {body.linear_velocity, body.angular_velocity});
  sut.remove(1);
  EXPECT_EQ(sut.report().asleep, 1u) << "the report is that of the last frame";
  EXPECT_FALSE(sut.is_asleep(1));
  sut.spawn(next_of(sut, 1, body));
  for (int n = 61; n <= 180; ++n) {
    moved.advance_to(n / 60.0);
    sut.advance_to(n / 60.0);
    ASSERT_EQ(state_of(moved, "body"), state_of(sut, "body")) << "frame " << n;
  }
}

// Identity ----------------------------------------------------------------------------------------

TEST_P(Spawning, TheIdOfABodyThatWentIsNobodys) {
  CollisionLayer sut = layer(on_ground(tower(3)));
  const BodyId old = world_of(sut).ids[2];
  sut.remove(2);
  EXPECT_TRUE(world_of(sut).is_absent(2));
  EXPECT_FALSE(world_of(sut).find(old).has_value());
  EXPECT_FALSE(world_of(sut).find("box1").has_value());
  EXPECT_FALSE(world_of(sut).find("").has_value());
  EXPECT_EQ(sut.spawn(next_of(sut, 2, brick("box1", {9, 9, 9}))), 2);
  EXPECT_FALSE(world_of(sut).find(old).has_value());
  EXPECT_EQ(world_of(sut).find(BodyId{2, 2}), 2);
  EXPECT_EQ(world_of(sut).find("box1"), 2);
  EXPECT_EQ(sut.spawn(brick("box9", {19, 9, 9})), 4);
  EXPECT_EQ(world_of(sut).find("box9"), 4);
  EXPECT_EQ(world_of(sut).find("box2"), 3);
}

TEST_P(Spawning, PairRulesHoldForWhoeverHasTheName) {
  Scene scene = on_ground(tower(1));
  scene.pairs.push_back({"ground", "box0", 0.0, std::nullopt, true, ""});
  CollisionLayer sut = layer(scene);
  BodyDef sliding = tower(1)[0];
  sliding.linear_velocity = {1, 0, 0};
  for (const char* name : {"other", "box0"}) {
    sut.remove(1);
    sliding.name = name;
    sut.spawn(next_of(sut, 1, sliding));
    const double t = sut.time();
    test::run_until(sut, t + 1);
    // Friction stops it after v²/(2 µ g); without any it goes on.
    const double expected = sliding.name == "box0" ? 1 : 1 / 9.81;
    EXPECT_NEAR(place_of(sut, name).x(), expected, 1e-3) << name;
  }
}

// What is left ------------------------------------------------------------------------------------

TEST_P(Spawning, ATowerFallsWhenItsBottomIsRemoved) {
  CollisionLayer sut = layer(on_ground(tower(4)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 4u);
  sut.remove(column(sut, "box0"));
  EXPECT_FALSE(sut.is_asleep(column(sut, "box3")));
  test::run_until(sut, 2 + 0.2);
  // Soft contacts of boxes that fall together still push a little.
  const double error = GetParam() == Profile::fast ? 1e-2 : 1e-9;
  EXPECT_NEAR(linear_velocity(world_of(sut), column(sut, "box3")).z(), -9.81 * 0.2, error);
  test::run_until(sut, 10);
  EXPECT_EQ(sut.report().asleep, 3u);
  EXPECT_NEAR(place_of(sut, "box3").z(), 2.5, 1e-3);
}

TEST_P(Spawning, TheOthersOfASleepingPileStayAsleepWhenOneThatTouchesNoneGoes) {
  CollisionLayer sut = layer(test::several());
  test::run_until(sut, 2);
  ASSERT_TRUE(sut.is_asleep(column(sut, "box0")) && sut.is_asleep(column(sut, "changed")));
  sut.remove(column(sut, "changed"));
  sut.spawn(brick("new", {0, -20, 5}));
  test::run_until(sut, 2.1);
  EXPECT_TRUE(sut.is_asleep(column(sut, "box0")));
}

TEST_P(Spawning, GroundsOfAllKindsComeAndGo) {
  BodyDef mesh;
  mesh.name = "mesh";
  mesh.is_static = true;
  mesh.shapes = {{test::plane_mesh(5, 4), {}}};
  for (BodyDef ground : {test::ground(), mesh, test::floor()}) {
    CollisionLayer sut = layer(test::scene({test::body("ball", Sphere{0.2}, {0.1, 0.2, 1})}));
    test::run_until(sut, 0.1);
    const Eigen::Index i = sut.spawn(ground);
    test::run_until(sut, 3);
    EXPECT_NEAR(place_of(sut, "ball").z(), 0.2, 1e-6) << ground.name;
    sut.remove(i);
    test::run_until(sut, 4);
    EXPECT_NEAR(place_of(sut, "ball").z(), 0.2 - 0.5 * 9.81, 1e-6) << ground.name;
    EXPECT_LT(std::abs(sut.energy_error()), 1e-6) << ground.name;
    sut.spawn(next_of(sut, i, ground));
    test::run_until(sut, 5);
    if (ground.name == "ground")  // the ball is in it: out, at no more than the speed allowed
      EXPECT_NEAR(place_of(sut, "ball").z(), 0.2 - 0.5 * 9.81 + 1, 0.02);
    else  // far above the ball
      EXPECT_LT(place_of(sut, "ball").z(), -10) << ground.name;
  }
}

TEST_P(Spawning, AStaticBodyThatComesIntoASleeperWakesItAndPushesItOut) {
  CollisionLayer sut = layer(on_ground(tower(1)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 1u);
  sut.spawn(test::made_static(brick("wall", {0.9, 0, 0.5})));
  test::run_until(sut, 8);
  EXPECT_LT(place_of(sut, "box0").x(), -0.0999);
  EXPECT_GT(place_of(sut, "box0").x(), -0.15);
}

TEST_P(Spawning, ABodyThatComesIntoASleepingPileWakesItAndIsPushedOut) {
  CollisionLayer sut = layer(on_ground(tower(3)));
  test::run_until(sut, 2);
  ASSERT_EQ(sut.report().asleep, 3u);
  sut.spawn(brick("new", {0.7, 0.1, 1}));
  test::run_until(sut, 30);
  EXPECT_EQ(sut.report().asleep, 4u);
  for (const char* name : {"box0", "box1", "box2", "new"})
    EXPECT_GT(place_of(sut, name).z(), 0.499) << name;
}

TEST_P(Spawning, TheEnergyOfWhatComesAndGoesIsNoError) {
  CollisionLayer sut = layer(test::several());
  test::run_until(sut, 1);
  const double error = sut.energy_error();
  BodyDef fast = brick("fast", {0, -50, 30});
  fast.linear_velocity = {100, 0, 0};
  const Eigen::Index i = sut.spawn(fast);
  EXPECT_LE(std::abs(sut.energy_error()), std::abs(error) + 1e-14);
  test::run_until(sut, 1.5);
  sut.remove(i);
  EXPECT_LE(std::abs(sut.energy_error()), std::abs(error) + 1e-12);
}

// Others ------------------------------------------------------------------------------------------

TEST_P(Spawning, WhatComesAndGoesElsewhereChangesNoBitOfTheOthers) {
  CollisionLayer left_alone = layer(test::several()), sut = layer(test::several());
  const std::vector<std::string> names = world_of(sut).names;
  const Eigen::Index changed = column(sut, "changed");
  for (int n = 1; n <= 240; ++n) {
    if (n == 20) sut.remove(changed);
    if (n == 25) sut.spawn(test::body("ball", Sphere{0.3}, {0, -30, 9}));
    if (n == 30) sut.spawn(test::body("cone", Cone{0.3, 1}, {-10, -30, 2}));
    if (n == 40) sut.spawn(test::made_static(brick("wall", {0, 50, 0})));
    if (n == 90) sut.remove(column(sut, "cone"));
    left_alone.advance_to(n / 60.0);
    sut.advance_to(n / 60.0);
    for (const std::string& name : names) {
      if (name == "changed") continue;
      ASSERT_EQ(state_of(sut, name), state_of(left_alone, name)) << name << ", frame " << n;
    }
  }
}

TEST_P(Spawning, OneThreadAndTwoAgreeInEveryBit) {
  Scene scene = test::with_profile(test::several(), GetParam());
  CollisionLayer one(scene);
  scene.collision.threads = 2;
  CollisionLayer two(scene);
  for (int n = 1; n <= 240; ++n) {
    for (CollisionLayer* sut : {&one, &two}) {
      if (n == 40) sut->remove(column(*sut, "box0"));
      if (n == 41) sut->spawn(next_of(*sut, 1, test::body("new", Capsule{0.2, 1}, {0.2, 0, 4})));
      if (n == 60) sut->remove(column(*sut, "falling1"));
      if (n == 61) sut->spawn(next_of(*sut, 5, brick("into", {20.3, 0, 1.2})));
      sut->advance_to(n / 60.0);
    }
    ASSERT_EQ(fingerprint(one), fingerprint(two)) << "frame " << n;
  }
}

TEST_P(Spawning, TenThousandBodiesThatComeAndGoLeaveNothingBehind) {
  CollisionLayer sut = layer(on_ground(tower(2)));
  const auto cycle = [&](int n) {
    BodyDef body = all_shapes()[static_cast<std::size_t>(n) % 8];
    body.pose.c = {0.2, 0, 2.4};  // on the tower
    if (world_of(sut).size() > 3) body = next_of(sut, 3, body);
    const Eigen::Index i = sut.spawn(body);
    EXPECT_EQ(i, 3);
    sut.advance_to(sut.time() + 0.01);
    sut.remove(i);
  };
  constexpr int kWarm = 500;
  for (int n = 0; n < kWarm; ++n) cycle(n);
  const std::size_t before = mallinfo2().uordblks;
  for (int n = kWarm; n < 10'000; ++n) cycle(n);
  const std::size_t after = mallinfo2().uordblks;
  EXPECT_LT(after, before + 65536);  // 7 bytes a cycle
  EXPECT_EQ(world_of(sut).size(), 4);
}

// With changes that no frame has seen yet.
TEST_P(Spawning, ACheckpointOfAWorldThatWasChangedGoesOnToTheBit) {
  Scene scene = test::with_profile(test::several(), GetParam());
  scene.bodies.push_back(test::made_kinematic(brick("belt", {-40, 0, 0.5})));
  CollisionLayer sut(scene);
  test::run_until(sut, 0.5);
  const Eigen::Index i = column(sut, "falling1");
  sut.remove(i);
  sut.remove(column(sut, "box0"));
  test::run_until(sut, 0.7);
  const BodyDef ball = next_of(sut, 1, test::body("ball", Sphere{0.4}, {0.3, 0, 3}));
  const BodyDef wall = test::made_static(brick("wall", {20.8, 0, 0.5}));
  sut.spawn(ball);
  BodyDef second = next_of(sut, i, wall);
  sut.spawn(second);
  sut.spawn(brick("last", {0, 0, 7}));
  sut.set_state(column(sut, "belt"), {{-41, 0, 0.5}, Quat::Identity()}, {{1, 0, 0}, {0, 0, 1}});

  ByteWriter out;
  sut.save(out);
  scene.bodies[1] = ball;
  scene.bodies[static_cast<std::size_t>(i)] = second;
  scene.bodies.push_back(brick("last", {0, 0, 7}));
  CollisionLayer restored(scene);
  ByteReader in(out.bytes());
  restored.restore(in);
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(restored.energy_error(), sut.energy_error());
  expect_same_run(restored, sut, 120);
}

// Springs -----------------------------------------------------------------------------------------

Scene chain(int balls) {
  std::vector<BodyDef> bodies;
  std::vector<SpringDef> springs;
  for (int k = 0; k < balls; ++k) {
    bodies.push_back(test::body("ball" + std::to_string(k), Sphere{0.1}, {1.0 + k, 0, 5}));
    SpringDef spring;
    spring.a = bodies.back().name;
    if (k > 0) spring.b = bodies[static_cast<std::size_t>(k - 1)].name;
    if (k == 0) spring.point_b = {0, 0, 5};
    spring.stiffness = 500;
    spring.damping = 1;
    springs.push_back(spring);
  }
  Scene scene = test::scene(std::move(bodies));
  scene.springs = std::move(springs);
  return scene;
}

TEST_P(Spawning, SpringsGoWithTheBodyAndWhatTheyHeldFallsApart) {
  CollisionLayer sut = layer(chain(4)), hanging = layer(chain(2)), falling = layer(chain(0));
  sut.remove(2);
  falling.spawn(chain(4).bodies[3]);
  for (int n = 1; n <= 120; ++n) {
    for (CollisionLayer* each : {&sut, &hanging, &falling}) each->advance_to(n / 60.0);
    ASSERT_EQ(state_of(sut, "ball1"), state_of(hanging, "ball1")) << n;
    ASSERT_EQ(state_of(sut, "ball3"), state_of(falling, "ball3")) << n;
  }
  EXPECT_LT(std::abs(sut.energy_error()), 1e-7);
}

TEST_P(Spawning, ASpringFollowsAStaticBodyThatIsMovedAndGoesWithIt) {
  Scene scene = chain(1);
  scene.bodies.push_back(test::made_static(brick("post", {0, 0, 5})));
  scene.springs[0].b = "post";
  scene.springs[0].point_b = {0.1, 0, 0};
  CollisionLayer sut = layer(scene);
  sut.set_state(1, {{0, 3, 5}, Quat::Identity()}, {});
  const double stretch = Vec3(0.9, -3, 0).norm() - 0.9;
  EXPECT_NEAR(spring_energy(world_of(sut)), 250 * stretch * stretch, 1e-9);
  test::run_until(sut, 1);
  sut.remove(1);
  EXPECT_EQ(spring_energy(world_of(sut)), 0);
  const double v = linear_velocity(world_of(sut), 0).z();
  test::run_until(sut, 2);
  EXPECT_NEAR(linear_velocity(world_of(sut), 0).z(), v - 9.81, 1e-9);
  EXPECT_LT(std::abs(sut.energy_error()), 1e-7);
}

}  // namespace
}  // namespace poinsot
