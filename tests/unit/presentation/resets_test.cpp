#include <gtest/gtest.h>

#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr std::uint8_t kTime = 1, kState = 2, kSpawned = 4;

// A box that falls on a floor, one that drifts, and one that a scene wrench pushes from the start.
Scene three_boxes() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor(), test::box("a", Vec3(0, 0, 3)), test::box("b", Vec3(3, 0, 3)),
                  test::box("pushed", Vec3(6, 0, 3))};
  scene.bodies[2].linear_velocity = Vec3(0, 1, 0);
  scene.bodies[2].angular_velocity = Vec3(0.3, 0, 1);
  WrenchDef wrench;
  wrench.body = "pushed";
  wrench.force = Vec3(0, 12, 0);
  wrench.duration = 0.1;  // 6 frames
  scene.wrenches = {wrench};
  return scene;
}

// After 30 frames, with one spawned body and one push that goes on.
PresentationLayer used_layer() {
  PresentationLayer layer(three_boxes());
  test::accept(layer, test::held_push(1, 1, "a", {6, 0, 0}));
  test::hashes(layer, 10);
  BodyDef body = test::box("new", Vec3(-3, 0, 3));
  body.linear_velocity = Vec3(0, 0, 1);
  test::spawn(layer, {body});
  test::hashes(layer, 20);
  return layer;
}

TEST(Resets, EveryResetIsANewEpoch) {
  PresentationLayer layer = used_layer();
  for (std::uint8_t scope = 0; scope <= kMaxResetScope; ++scope) {
    const Reply reply = test::reset(layer, scope);
    EXPECT_EQ(reply.code, ResultCode::ok) << int{scope};
    EXPECT_EQ(reply.epoch, 2u + scope);
    EXPECT_EQ(layer.snapshot().epoch, 2u + scope);
    EXPECT_EQ(layer.report().impacts_so_far, 0u);
  }
  EXPECT_EQ(test::reset(layer, 8).code, ResultCode::invalid_value);
}

TEST(Resets, AllIsAFreshStart) {
  for (const std::uint8_t scope : {std::uint8_t{0}, kMaxResetScope}) {
    PresentationLayer layer = used_layer(), fresh(three_boxes());
    test::remove(layer, "b");
    test::reset(layer, scope);
    EXPECT_EQ(layer.frame(), 0u);
    EXPECT_EQ(layer.scene_bodies(), 4u);
    EXPECT_EQ(layer.held_by(1), 0u);
    EXPECT_EQ(test::hashes(layer, 60), test::hashes(fresh, 60));
  }
}

TEST(Resets, OfTimeKeepBodiesWhereAndAsFastAsTheyAre) {
  PresentationLayer layer = used_layer();
  const std::vector<BodyState> before = layer.snapshot().bodies;
  const Reply reply = test::reset(layer, kTime);
  EXPECT_EQ(reply.first_frame, 0u);
  EXPECT_EQ(layer.frame(), 0u);
  EXPECT_EQ(layer.time(), 0.0);
  EXPECT_EQ(layer.snapshot().sim_time_ns, 0);
  ASSERT_EQ(layer.snapshot().bodies.size(), 4u);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const BodyState &a = before[k], &b = layer.snapshot().bodies[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_LT((a.position - b.position).norm(), 1e-15);
    EXPECT_LT((a.linear_velocity - b.linear_velocity).norm(), 1e-15);
    EXPECT_LT((a.angular_velocity - b.angular_velocity).norm(), 1e-14);
  }
  layer.advance_frame();
  EXPECT_EQ(layer.time(), 1.0 / 60);
}

TEST(Resets, OfTimeEndWhatClientsHoldAndStartTheWrenchesOfTheSceneAfresh) {
  PresentationLayer layer = used_layer();
  EXPECT_EQ(layer.held_by(0), 0u);  // its wrench is over
  test::reset(layer, kTime);
  EXPECT_EQ(layer.held_by(0), 1u);
  EXPECT_EQ(layer.held_by(1), 0u);
  const double before = layer.snapshot().bodies[2].linear_velocity.y();
  test::hashes(layer, 10);
  EXPECT_NEAR(layer.snapshot().bodies[2].linear_velocity.y() - before, 0.6, 1e-14);  // F t / m
}

TEST(Resets, OfStatePutTheBodiesOfTheFileBackAndGoOn) {
  PresentationLayer layer = used_layer();
  const Vec3 spawned = layer.snapshot().bodies[3].position;
  const Reply reply = test::reset(layer, kState);
  EXPECT_EQ(reply.first_frame, 30u);
  EXPECT_EQ(layer.frame(), 30u);
  EXPECT_EQ(layer.snapshot().bodies[0].position, Vec3(0, 0, 3));
  EXPECT_EQ(layer.snapshot().bodies[0].linear_velocity, Vec3(0, 0, 0));
  EXPECT_EQ(layer.snapshot().bodies[1].position, Vec3(3, 0, 3));
  EXPECT_LT((layer.snapshot().bodies[1].angular_velocity - Vec3(0.3, 0, 1)).norm(), 1e-15);
  EXPECT_EQ(layer.snapshot().bodies[3].position, spawned);
  EXPECT_EQ(layer.held_by(1), 0u);
  test::hashes(layer, 30);
  EXPECT_EQ(layer.snapshot().bodies[0].position, Vec3(0, 0, 3));  // nobody pushes
}

TEST(Resets, OfStatePutAMovedStaticBodyBack) {
  PresentationLayer layer(three_boxes());
  Order order = test::order(ControlAction::set_state);
  order.control.body_name = "floor";
  order.control.sets_position = true;
  order.control.position = Vec3(0, 0, -4);
  layer.obey(order);
  for (const std::uint8_t scope : {kTime, kSpawned}) {
    test::reset(layer, scope);
    EXPECT_EQ(layer.scene().bodies[0].pose.c, Vec3(0, 0, -4));
    EXPECT_EQ(position(layer.world().y, 0), Vec3(0, 0, -4));
  }
  test::reset(layer, kState);
  EXPECT_EQ(layer.scene().bodies[0].pose.c, Vec3(0, 0, -0.5));
  EXPECT_EQ(position(layer.world().y, 0), Vec3(0, 0, -0.5));
}

TEST(Resets, OfSpawnedLeaveTheRestAlone) {
  PresentationLayer layer = used_layer(), other = used_layer();
  test::accept(layer, test::held_push(1, 2, "new"));
  test::reset(layer, kSpawned);
  EXPECT_EQ(layer.scene_bodies(), 4u);
  EXPECT_EQ(layer.snapshot().bodies.size(), 3u);
  EXPECT_EQ(layer.frame(), 30u);
  EXPECT_EQ(layer.held_by(1), 1u);  // that on "a"
  test::hashes(layer, 20);
  test::hashes(other, 20);
  EXPECT_EQ(layer.world().y.leftCols(4), other.world().y.leftCols(4));
}

TEST(Resets, ABodyInThePlaceOfOneOfTheFileIsASpawnedOne) {
  PresentationLayer layer(three_boxes());
  test::remove(layer, "a");
  test::spawn(layer, {test::box("a", Vec3(0, 0, 8))});
  test::reset(layer, kState);
  EXPECT_EQ(layer.snapshot().bodies[0].position, Vec3(0, 0, 8));
  test::reset(layer, kSpawned);
  EXPECT_EQ(layer.scene_bodies(), 3u);
}

TEST(Resets, OfTimeAndStateGiveTheMotionOfAFreshStartBesideTheSpawnedBodies) {
  PresentationLayer layer = used_layer(), fresh(three_boxes());
  test::reset(layer, kTime | kState);
  EXPECT_EQ(layer.frame(), 0u);
  EXPECT_EQ(layer.scene_bodies(), 5u);
  test::hashes(layer, 40);
  test::hashes(fresh, 40);
  EXPECT_EQ(layer.world().y.leftCols(4), fresh.world().y);
}

TEST(Resets, OfTimeKeepTheRestLengthsOfSprings) {
  Scene scene = three_boxes();
  scene.wrenches.clear();
  SpringDef spring;
  spring.a = "a";
  spring.b = "b";
  spring.stiffness = 40;  // its rest length is the distance at time 0: 3 m
  scene.springs = {spring};
  PresentationLayer layer(scene);
  test::hashes(layer, 45);
  const double energy = layer.report().energy;
  test::reset(layer, kTime);
  EXPECT_NEAR(layer.report().energy, energy, 1e-13 * energy);
}

TEST(Resets, OfTimeFreeAFrozenBody) {
  Scene scene = three_boxes();
  scene.bodies[1].linear_velocity = Vec3(1e200, 0, -1e200);
  PresentationLayer layer(scene);
  test::hashes(layer, 2);
  ASSERT_EQ(layer.report().quarantined, 1u);
  EXPECT_EQ(test::accept(layer, test::push(1, 1, "a")).code, ResultCode::incorrect_state);
  test::reset(layer, kTime);
  EXPECT_EQ(layer.report().quarantined, 0u);
  EXPECT_EQ(test::accept(layer, test::push(1, 2, "a")).code, ResultCode::ok);
  test::hashes(layer, 2);
  EXPECT_TRUE(layer.world().moves(1));
}

}  // namespace
}  // namespace poinsot
