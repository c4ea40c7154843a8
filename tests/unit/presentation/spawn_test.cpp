// Controls that the physics has to know of: bodies come and go.

#include <gtest/gtest.h>

#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

using test::floor_and_two;
using test::set_state;

// Spawn -------------------------------------------------------------------------------------------

TEST(Spawn, ABodyComesInWithItsStateAndIsInTheNextSnapshot) {
  PresentationLayer layer(floor_and_two());
  test::hashes(layer, 2);
  BodyDef body = test::box("new", Vec3(-3, 0, 3));
  body.linear_velocity = Vec3(1, 2, 3);
  const Reply reply = test::spawn(layer, {body});
  ASSERT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.body, (BodyId{3, 1}));
  EXPECT_EQ(layer.scene_bodies(), 4u);
  EXPECT_EQ(layer.scene_revision(), 2u);
  ASSERT_EQ(layer.snapshot().bodies.size(), 3u);
  EXPECT_EQ(layer.snapshot().total, 3u);
  EXPECT_EQ(layer.body_methods().size(), 3u);
  EXPECT_EQ(layer.snapshot().bodies[2].id, reply.body);
  EXPECT_EQ(layer.snapshot().bodies[2].position, Vec3(-3, 0, 3));
  layer.advance_frame();
  EXPECT_LT((layer.snapshot().bodies[2].position - Vec3(-3, 0, 3) - Vec3(1, 2, 3) / 60).norm(),
            1e-15);
  EXPECT_EQ(layer.report().bodies, 3u);
}

TEST(Spawn, AStaticBodyIsNotInTheSnapshotButInTheScene) {
  PresentationLayer layer(floor_and_two());
  BodyDef wall = test::floor("wall");
  wall.pose.c = Vec3(0, 0, 20);
  EXPECT_EQ(test::spawn(layer, {wall}).code, ResultCode::ok);
  EXPECT_EQ(layer.snapshot().bodies.size(), 2u);
  EXPECT_EQ(layer.scene().bodies.at(3).name, "wall");
}

TEST(Spawn, NamesMustBeNew) {
  PresentationLayer layer(floor_and_two());
  const Reply taken =
      test::spawn(layer, {test::box("x", Vec3(9, 0, 3)), test::box("a", Vec3(6, 0, 3))});
  EXPECT_EQ(taken.code, ResultCode::name_taken);
  EXPECT_NE(taken.message.find("'a'"), std::string::npos) << taken.message;
  const Reply twice =
      test::spawn(layer, {test::box("x", Vec3(9, 0, 3)), test::box("x", Vec3(6, 0, 3))});
  EXPECT_EQ(twice.code, ResultCode::name_taken);
  EXPECT_EQ(layer.scene_bodies(), 3u);
  EXPECT_EQ(layer.scene_revision(), 1u);
}

TEST(Spawn, ANameIsFreeAgainOnceItsBodyIsGone) {
  PresentationLayer layer(floor_and_two());
  test::remove(layer, "a");
  const Reply reply = test::spawn(layer, {test::box("a", Vec3(0, 0, 9))});
  EXPECT_EQ(reply.code, ResultCode::ok);
  EXPECT_EQ(reply.body, (BodyId{1, 2}));  // the place of the old one, in the next generation
}

TEST(Spawn, AnEmptyFragmentIsRefused) {
  PresentationLayer layer(floor_and_two());
  EXPECT_EQ(test::spawn(layer, {}).code, ResultCode::invalid_value);
  EXPECT_EQ(layer.obey(test::order(ControlAction::spawn)).code, ResultCode::invalid_value);
}

TEST(Spawn, BodiesThatWouldOverlapAreRefusedWithBothNamesAndTheDepth) {
  PresentationLayer layer(floor_and_two());
  const Reply reply =
      test::spawn(layer, {test::box("far", Vec3(9, 9, 9)), test::box("new", Vec3(0.75, 0, 3))});
  EXPECT_EQ(reply.code, ResultCode::operation_failed);
  EXPECT_NE(reply.message.find("'new' overlaps 'a' by 0.25 m"), std::string::npos) << reply.message;
  EXPECT_EQ(layer.scene_bodies(), 3u);
  const Reply each_other =
      test::spawn(layer, {test::box("p", Vec3(9, 9, 9)), test::box("q", Vec3(9.5, 9, 9))});
  EXPECT_EQ(each_other.code, ResultCode::operation_failed);
  EXPECT_EQ(test::spawn(layer, {test::box("new", Vec3(1, 0, 3))}).code, ResultCode::ok);  // touches
}

TEST(Spawn, OverlapsCountWhereBodiesAreNow) {
  PresentationLayer layer(floor_and_two());
  Order away = set_state("a");
  away.control.sets_position = true;
  away.control.position = Vec3(-7, 0, 3);
  ASSERT_EQ(layer.obey(away).code, ResultCode::ok);
  EXPECT_EQ(test::spawn(layer, {test::box("here", Vec3(0, 0, 3))}).code, ResultCode::ok);
  EXPECT_EQ(test::spawn(layer, {test::box("there", Vec3(-7, 0, 3))}).code,
            ResultCode::operation_failed);
}

TEST(Spawn, OverlapsOfOthersAreNotItsFault) {
  Scene scene = floor_and_two();
  scene.bodies[2].pose.c = Vec3(0.5, 0, 3);  // allowed in code: a and b overlap
  PresentationLayer layer(scene);
  EXPECT_EQ(test::spawn(layer, {test::box("new", Vec3(-1, 0, 3))}).code, ResultCode::ok);
}

TEST(Spawn, ASceneThatAllowsOverlapAllowsItHere) {
  Scene scene = floor_and_two();
  scene.allow_overlap = true;
  PresentationLayer layer(scene);
  EXPECT_EQ(test::spawn(layer, {test::box("new", Vec3(0, 0, 3))}).code, ResultCode::ok);
}

TEST(Spawn, ASpawnedBodyIsPushedByName) {
  PresentationLayer layer(floor_and_two());
  test::spawn(layer, {test::box("new", Vec3(-3, 0, 3))});
  EXPECT_EQ(test::accept(layer, test::push(1, 1, "new", {6, 0, 0})).body, (BodyId{3, 1}));
  layer.advance_frame();
  EXPECT_NEAR(layer.snapshot().bodies[2].linear_velocity.x(), 3.0 / 60, 1e-16);
}

// Remove ------------------------------------------------------------------------------------------

TEST(Remove, ABodyIsGoneFromSceneSnapshotAndLookUp) {
  PresentationLayer layer(floor_and_two());
  const Reply reply = test::remove(layer, "a");
  EXPECT_EQ(reply.code, ResultCode::ok);
  EXPECT_EQ(reply.body, (BodyId{1, 1}));
  EXPECT_EQ(layer.scene_bodies(), 2u);
  EXPECT_TRUE(layer.scene().bodies[1].absent);
  ASSERT_EQ(layer.snapshot().bodies.size(), 1u);
  EXPECT_EQ(layer.snapshot().bodies[0].id, (BodyId{2, 1}));
  EXPECT_EQ(test::accept(layer, test::push(1, 1, "a")).code, ResultCode::not_found);
  WrenchCommand by_id = test::push(1, 2, "");
  by_id.body = {1, 1};
  EXPECT_EQ(test::accept(layer, by_id).code, ResultCode::not_found);
  test::spawn(layer, {test::box("c", Vec3(0, 0, 9))});
  EXPECT_EQ(test::accept(layer, by_id).code, ResultCode::not_found);  // an old handle
  by_id.body = {1, 2};
  EXPECT_EQ(test::accept(layer, by_id).code, ResultCode::ok);
}

TEST(Remove, NamesTheNearestOfAnUnknownBody) {
  PresentationLayer layer(floor_and_two());
  const Reply reply = test::remove(layer, "flor");
  EXPECT_EQ(reply.code, ResultCode::not_found);
  EXPECT_EQ(reply.message, "no body 'flor', did you mean 'floor'?");
  EXPECT_EQ(layer.obey(test::order(ControlAction::remove)).code, ResultCode::not_found);
}

TEST(Remove, WhatIsHeldOnItGoes) {
  PresentationLayer layer(floor_and_two());
  test::accept(layer, test::held_push(1, 1, "a"));
  test::accept(layer, test::tether(1, 2, "a"));
  test::accept(layer, test::held_push(1, 3, "b", {6, 0, 0}));
  test::hashes(layer, 2);
  test::remove(layer, "a");
  EXPECT_EQ(layer.held_count(), 1u);
  EXPECT_EQ(layer.held_by(1), 1u);
  test::spawn(layer, {test::box("a", Vec3(0, 0, 3))});
  test::hashes(layer, 3);
  EXPECT_EQ(layer.snapshot().bodies[0].linear_velocity, Vec3(0, 0, 0));  // nothing is left on it
  EXPECT_NEAR(layer.snapshot().bodies[1].linear_velocity.x(), 3.0 * 5 / 60, 1e-15);
}

TEST(Remove, SpringsAndWrenchesOfTheSceneGoWithTheirBody) {
  Scene scene = floor_and_two();
  SpringDef spring;
  spring.a = "a";
  spring.b = "b";
  spring.stiffness = 10;
  scene.springs = {spring};
  WrenchDef wrench;
  wrench.body = "a";
  wrench.force = Vec3(1, 0, 0);
  scene.wrenches = {wrench};
  PresentationLayer layer(scene);
  test::hashes(layer, 10);
  EXPECT_EQ(test::remove(layer, "a").code, ResultCode::ok);
  EXPECT_TRUE(layer.scene().springs.empty());
  EXPECT_TRUE(layer.scene().wrenches.empty());
  EXPECT_EQ(layer.held_count(), 0u);
  const Vec3 v = layer.snapshot().bodies[0].linear_velocity;
  test::hashes(layer, 10);
  EXPECT_LT((layer.snapshot().bodies[0].linear_velocity - v).norm(), 1e-15);
}

}  // namespace
}  // namespace poinsot
