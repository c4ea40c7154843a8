// Held wrenches, frame by frame: impulses and tethers on their way to the physics.

#include <gtest/gtest.h>

#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene floating_boxes() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("box", Vec3(0, 0, 0)), test::box("crate", Vec3(5, 0, 0))};
  scene.bodies[0].pose.q = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));  // x → y
  return scene;
}

Vec3 velocity(const PresentationLayer& layer, std::size_t body = 0) {
  return layer.snapshot().bodies.at(body).linear_velocity;
}

TEST(ApplyHeld, AnImpulseActsOnceAtTheStartOfItsFrame) {
  PresentationLayer layer(floating_boxes());
  WrenchCommand command = test::impulse(1, 1, "box", {3, 0, 0});
  command.start_frame = 3;
  const Reply reply = test::accept(layer, command);
  EXPECT_EQ(reply.first_frame, 3u);
  EXPECT_EQ(reply.last_frame, 3u);
  for (int frame = 1; frame <= 6; ++frame) {
    layer.advance_frame();
    EXPECT_EQ(velocity(layer).x(), frame < 3 ? 0 : 1.5) << frame;  // J / m
  }
  EXPECT_NEAR(layer.snapshot().bodies[0].position.x(), 1.5 * 4 / 60, 1e-15);
  EXPECT_EQ(layer.held_count(), 0u);
}

TEST(ApplyHeld, AnImpulseInBodyAxesIsTurnedAsTheBodyIsAtThatMoment) {
  Scene scene = floating_boxes();
  scene.bodies[0].angular_velocity = Vec3(0, 0, M_PI);  // half a turn per second
  PresentationLayer layer(scene);
  WrenchCommand command = test::impulse(1, 1, "box", {2, 0, 0});
  command.axes = Axes::body;
  command.start_frame = 31;  // after half a second: x of the body is −x of W
  test::accept(layer, command);
  test::hashes(layer, 31);
  EXPECT_LT((velocity(layer) - Vec3(-1, 0, 0)).norm(), 1e-12);
}

TEST(ApplyHeld, AnImpulseOffTheCentreTurnsTheBody) {
  PresentationLayer layer(floating_boxes());
  WrenchCommand command = test::impulse(1, 1, "box", {0, 0, 4});
  command.torque = Vec3(0, 0.25, 0);
  command.point_frame = PointFrame::body;
  command.point = Vec3(0.5, 0, 0);  // along y of W
  test::accept(layer, command);
  layer.advance_frame();
  const Vec3 L = angular_momentum(layer.world().y, 0);
  EXPECT_LT((L - Vec3(2, 0.25, 0)).norm(), 1e-15);
}

TEST(ApplyHeld, APausedRunAppliesAnImpulseWhenItGoesOn) {
  PresentationLayer layer(floating_boxes());
  test::hashes(layer, 5);
  const StateArray before = layer.world().y;
  test::accept(layer, test::impulse(1, 1));
  EXPECT_EQ(layer.world().y, before);
  layer.advance_frame();
  EXPECT_EQ(velocity(layer).x(), 0.5);
}

TEST(ApplyHeld, AnImpulseIsClearedAndReplacedLikeAForce) {
  PresentationLayer layer(floating_boxes());
  WrenchCommand command = test::impulse(1, 1, "box", {2, 0, 0});
  command.slot = 4;
  test::accept(layer, command);
  command = test::impulse(1, 2, "box", {6, 0, 0});
  command.slot = 4;
  test::accept(layer, command);
  layer.advance_frame();
  EXPECT_EQ(velocity(layer).x(), 3);
  test::accept(layer, test::impulse(1, 3));
  WrenchCommand clear;
  clear.client = 1;
  clear.seq = 4;
  clear.hold = Hold::clear;
  test::accept(layer, clear);
  layer.advance_frame();
  EXPECT_EQ(velocity(layer).x(), 3);
}

TEST(ApplyHeld, AnImpulseLeavesTheCoursesOfOthersAlone) {
  PresentationLayer with(floating_boxes()), without(floating_boxes());
  for (PresentationLayer* layer : {&with, &without})
    test::accept(*layer, test::held_push(1, 1, "crate", {0, 1, 0}));
  test::hashes(with, 3);
  test::hashes(without, 3);
  test::accept(with, test::impulse(2, 1, "box", {0, 0, 1}));
  test::hashes(with, 10);
  test::hashes(without, 10);
  EXPECT_EQ(with.world().y.col(1), without.world().y.col(1));
  EXPECT_NE(with.world().y.col(0), without.world().y.col(0));
}

TEST(ApplyHeld, ATetherDragsABodyToItsTargetAndHoldsItThere) {
  PresentationLayer layer(floating_boxes());
  WrenchCommand command = test::tether(1, 1, "box", {0.5, 0.25, 0});
  command.stiffness = 50;
  command.damping = 20;  // 2 √(k m): critical
  EXPECT_EQ(test::accept(layer, command).last_frame, kForever);
  test::hashes(layer, 600);
  // What is left of e^(−5 t) (1 + 5 t) after 10 s.
  EXPECT_LT((layer.snapshot().bodies[0].position - Vec3(0.5, 0.25, 0)).norm(), 1e-12);
}

TEST(ApplyHeld, ATetherThatIsClearedLetsTheBodyFly) {
  PresentationLayer layer(floating_boxes());
  test::accept(layer, test::tether(1, 1));
  test::hashes(layer, 10);
  const Vec3 v = velocity(layer);
  EXPECT_GT(v.x(), 0.1);
  WrenchCommand clear;
  clear.client = 1;
  clear.seq = 2;
  clear.hold = Hold::clear;
  test::accept(layer, clear);
  test::hashes(layer, 10);
  EXPECT_LT((velocity(layer) - v).norm(), 1e-15);
}

TEST(ApplyHeld, OrderOfArrivalDoesNotMatter) {
  std::vector<WrenchCommand> commands;
  for (std::uint64_t client = 1; client <= 4; ++client) {
    const double x = 0.1 * static_cast<double>(client) + 1e-9;
    commands.push_back(test::held_push(client, 1, "box", {x, 1 / x, 7 * x}));
    commands.push_back(test::impulse(client, 2, "box", {1 / x, x, 3 * x}));
    commands.push_back(test::tether(client, 3, "box", {x, x * x, 1 / x}));
  }
  PresentationLayer forward(floating_boxes()), backward(floating_boxes());
  std::vector<Reply> replies;
  forward.accept(commands, replies);
  for (std::uint64_t client = 4; client >= 1; --client)  // a client's own order stays
    backward.accept(std::span(commands).subspan(3 * (client - 1), 3), replies);
  EXPECT_EQ(test::hashes(forward, 20), test::hashes(backward, 20));
}

}  // namespace
}  // namespace poinsot
