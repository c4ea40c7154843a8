#include "poinsot/presentation/scene_wrenches.h"

#include <gtest/gtest.h>

#include "poinsot/presentation/presentation_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene two_boxes() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::floor(), test::box("a", Vec3(0, 0, 1)), test::box("b", Vec3(3, 0, 1))};
  return scene;
}

WrenchDef wrench(const std::string& body) {
  WrenchDef def;
  def.body = body;
  def.force = Vec3(1, 2, 3);
  return def;
}

WrenchCommand command_of(const WrenchDef& def) {
  Scene scene = two_boxes();
  scene.wrenches = {def};
  return scene_wrenches(scene, World(scene)).at(0);
}

TEST(SceneWrenches, BecomeCommandsOfTheSceneInItsOrder) {
  Scene scene = two_boxes();
  scene.wrenches = {wrench("b"), wrench("a")};
  const World world(scene);
  const auto commands = scene_wrenches(scene, world);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].client, kSceneClient);
  EXPECT_EQ(commands[0].seq, 1u);
  EXPECT_EQ(commands[0].body, world.ids[2]);
  EXPECT_EQ(commands[1].client, kSceneClient);
  EXPECT_EQ(commands[1].seq, 2u);
  EXPECT_EQ(commands[1].body, world.ids[1]);
}

TEST(SceneWrenches, KeepForceTorqueAxesAndPoint) {
  WrenchDef def = wrench("a");
  def.torque = Vec3(4, 5, 6);
  def.axes = Axes::body;
  def.point = Vec3(7, 8, 9);
  def.point_frame = PointFrame::body;
  const WrenchCommand command = command_of(def);
  EXPECT_EQ(command.force, def.force);
  EXPECT_EQ(command.torque, def.torque);
  EXPECT_EQ(command.axes, Axes::body);
  EXPECT_EQ(command.point, def.point);
  EXPECT_EQ(command.point_frame, PointFrame::body);
}

TEST(SceneWrenches, ActFromFrameOneForEverUnlessTheSceneSaysOtherwise) {
  const WrenchCommand command = command_of(wrench("a"));
  EXPECT_EQ(command.start_frame, 1u);
  EXPECT_EQ(command.hold, Hold::until_cleared);
}

// Frame n lasts from (n − 1)/60 s to n/60 s.
TEST(SceneWrenches, StartWithTheFirstFrameThatBeginsAtTheirStartOrLater) {
  const auto first_frame = [](double start) {
    WrenchDef def = wrench("a");
    def.start = start;
    return command_of(def).start_frame;
  };
  EXPECT_EQ(first_frame(0), 1u);
  EXPECT_EQ(first_frame(1.0 / 60), 2u);
  EXPECT_EQ(first_frame(0.1), 7u);  // 0.1 · 60 may be a bit more than 6
  EXPECT_EQ(first_frame(0.5), 31u);
  EXPECT_EQ(first_frame(0.501), 32u);
  EXPECT_EQ(first_frame(1e-9), 2u);
  EXPECT_EQ(first_frame(1e9), 60'000'000'001u);
}

TEST(SceneWrenches, LastForTheirDurationAndAtLeastAFrame) {
  const auto nanoseconds = [](double duration) {
    WrenchDef def = wrench("a");
    def.duration = duration;
    const WrenchCommand command = command_of(def);
    EXPECT_EQ(command.hold, Hold::duration);
    return command.duration_ns;
  };
  EXPECT_EQ(nanoseconds(0.5), 500'000'000);
  EXPECT_EQ(nanoseconds(1e-12), 1);
  EXPECT_EQ(nanoseconds(1e9), kMaxDurationNs);
}

TEST(SceneWrenches, AreNotReleasedAsThoughTheSceneWereAClientThatLeft) {
  Scene scene = two_boxes();
  scene.wrenches = {wrench("a")};
  PresentationLayer layer(scene);
  RunControl release;
  release.client = kSceneClient;
  release.seq = 1;
  release.action = ControlAction::release;
  layer.obey({.control = release});
  EXPECT_EQ(layer.held_by(kSceneClient), 1u);
}

}  // namespace
}  // namespace poinsot
