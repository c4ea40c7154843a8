#include "poinsot/presentation/presentation_layer.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Two boxes that fall on a floor, the second with its centre of mass off its origin.
Scene falling_boxes() {
  Scene scene = test::empty_scene();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {test::floor(), test::box("a", Vec3(0, 0, 0.6)), test::box("b", Vec3(3, 0, 2))};
  scene.bodies[2].mass_properties.center_of_mass = Vec3(0.1, 0, 0);
  scene.bodies[2].angular_velocity = Vec3(0.3, 0.2, 0.1);
  return scene;
}

WrenchCommand push(std::uint64_t client, std::uint64_t seq, const std::string& body,
                   const Vec3& force) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.body_name = body;
  command.force = force;
  return command;
}

Reply accept(PresentationLayer& layer, const WrenchCommand& command) {
  std::vector<Reply> replies;
  layer.accept({&command, 1}, replies);
  return replies.at(0);
}

std::vector<std::uint64_t> hashes(PresentationLayer& layer, int frames) {
  std::vector<std::uint64_t> all = {layer.snapshot().state_hash};
  for (int n = 0; n < frames; ++n) {
    layer.advance_frame();
    all.push_back(layer.snapshot().state_hash);
  }
  return all;
}

TEST(PresentationLayer, FrameNEndsAtExactlyNOverTheFrameRate) {
  Scene scene = falling_boxes();
  scene.presentation.frame_rate = 60;
  PresentationLayer layer(scene);
  EXPECT_EQ(layer.frame(), 0u);
  EXPECT_EQ(layer.time(), 0.0);
  for (int n = 1; n <= 200; ++n) {
    layer.advance_frame();
    EXPECT_EQ(layer.frame(), static_cast<std::uint64_t>(n));
    EXPECT_EQ(layer.time(), n / 60.0);
    EXPECT_EQ(layer.snapshot().sim_time_ns, std::llround(n * 1e9 / 60.0));
  }
}

TEST(PresentationLayer, SnapshotHoldsBodyFramesAndVelocitiesOfTheCentreOfMass) {
  const Scene scene = falling_boxes();
  const PresentationLayer layer(scene);
  const PoseSnapshot& snapshot = layer.snapshot();
  EXPECT_EQ(snapshot.epoch, 1u);
  EXPECT_EQ(snapshot.frame, 0u);
  ASSERT_EQ(snapshot.bodies.size(), 2u);  // the floor is static
  EXPECT_EQ(snapshot.bodies[1].id, layer.world().ids[2]);
  EXPECT_TRUE(snapshot.bodies[1].position.isApprox(scene.bodies[2].pose.c, 1e-15));
  EXPECT_TRUE(snapshot.bodies[1].angular_velocity.isApprox(Vec3(0.3, 0.2, 0.1), 1e-14));
  EXPECT_TRUE(snapshot.bodies[1].linear_velocity.isZero());
}

TEST(PresentationLayer, APushChangesTheMomentumByForceTimesTheFramesOfTheReply) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("a", Vec3(0, 0, 0))};
  PresentationLayer layer(scene);
  WrenchCommand command = push(1, 1, "a", Vec3(3, -2, 5));
  command.hold = Hold::duration;
  command.duration_ns = 500'000'000;
  command.start_frame = 4;
  const Reply reply = accept(layer, command);
  EXPECT_EQ(reply.first_frame, 4u);
  EXPECT_EQ(reply.last_frame, 33u);
  for (int n = 1; n <= 60; ++n) {
    layer.advance_frame();
    const double frames = std::clamp(n - 3, 0, 30);
    const Vec3 expected = Vec3(3, -2, 5) * (frames / 60) / 2.0;  // F t / m
    // Rounding of 30 frames with a few sub-steps each.
    EXPECT_TRUE((layer.snapshot().bodies[0].linear_velocity - expected).norm() < 1e-14) << n;
  }
}

TEST(PresentationLayer, TwoRunsHaveTheSameHashesAndDifferentStatesHaveDifferentOnes) {
  PresentationLayer first(falling_boxes());
  PresentationLayer second(falling_boxes());
  Scene other = falling_boxes();
  other.bodies[1].pose.c.x() = 1e-16;
  PresentationLayer third(other);
  const auto a = hashes(first, 120);
  EXPECT_EQ(a, hashes(second, 120));
  const auto c = hashes(third, 120);
  for (std::size_t n = 0; n < a.size(); ++n) EXPECT_NE(a[n], c[n]) << n;
}

TEST(PresentationLayer, ResetGivesTheHashesOfAFreshStartInTheNextEpoch) {
  PresentationLayer layer(falling_boxes());
  WrenchCommand command = push(1, 1, "a", Vec3(50, 0, 0));
  command.hold = Hold::until_cleared;
  accept(layer, command);
  hashes(layer, 90);
  layer.reset();
  EXPECT_EQ(layer.epoch(), 2u);
  EXPECT_EQ(layer.frame(), 0u);
  EXPECT_EQ(layer.time(), 0.0);
  EXPECT_EQ(layer.snapshot().epoch, 2u);
  EXPECT_EQ(layer.snapshot().frame, 0u);
  PresentationLayer fresh(falling_boxes());
  EXPECT_EQ(hashes(layer, 120), hashes(fresh, 120));
}

TEST(PresentationLayer, ResetRefusesCommandsOfTheRunBefore) {
  PresentationLayer layer(falling_boxes());
  layer.reset();
  WrenchCommand command = push(1, 1, "a", Vec3(1, 0, 0));
  command.epoch = 1;
  EXPECT_EQ(accept(layer, command).code, ResultCode::wrong_epoch);
  command.epoch = 2;
  EXPECT_EQ(accept(layer, command).code, ResultCode::ok);
}

TEST(PresentationLayer, AcceptingWithoutAdvancingLeavesTheStateAlone) {
  PresentationLayer layer(falling_boxes());
  layer.advance_frame();
  const std::uint64_t before = layer.snapshot().state_hash;
  const StateArray y = layer.world().y;
  EXPECT_EQ(accept(layer, push(1, 1, "a", Vec3(1, 0, 0))).first_frame, 2u);
  EXPECT_EQ(layer.snapshot().state_hash, before);
  EXPECT_EQ(layer.world().y, y);
  layer.advance_frame();
  EXPECT_NE(layer.world().y, y);
}

TEST(PresentationLayer, CommandsHeldOnArePartOfTheHash) {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("a", Vec3(0, 0, 0))};
  PresentationLayer with(scene), without(scene);
  WrenchCommand command = push(1, 1, "a", Vec3(1, 0, 0));
  command.start_frame = 10;
  accept(with, command);
  with.advance_frame();
  without.advance_frame();
  EXPECT_EQ(with.world().y, without.world().y);
  EXPECT_NE(with.snapshot().state_hash, without.snapshot().state_hash);
}

TEST(PresentationLayer, ReportCountsDynamicBodies) {
  PresentationLayer layer(falling_boxes());
  std::uint32_t contacts = 0;  // the first box lands, and may be asleep in the end
  for (int frame = 0; frame < 60; ++frame) {
    hashes(layer, 1);
    contacts = std::max(contacts, layer.report().contacts);
  }
  const FrameReport report = layer.report();
  EXPECT_EQ(report.frame, 60u);
  EXPECT_EQ(report.sim_time, 1.0);
  EXPECT_EQ(report.bodies, 2u);
  EXPECT_GT(contacts, 0u);
  EXPECT_EQ(report.quarantined, 0u);
  EXPECT_EQ(report.flags, FrameFlag::none);
}

TEST(PresentationLayer, TimesGrowAndSurviveAReset) {
  PresentationLayer layer(falling_boxes());
  hashes(layer, 60);
  const LayerTimes before = layer.times();
  EXPECT_GT(before.presentation.wall_s, 0.0);
  EXPECT_GT(before.simulation.wall_s, 0.0);
  layer.reset();
  EXPECT_GE(layer.times().simulation.wall_s, before.simulation.wall_s);
  EXPECT_GE(layer.times().presentation.wall_s, before.presentation.wall_s);
}

TEST(PresentationLayer, AdvancesWithoutAllocatingOnceWarm) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "the sanitizer owns malloc";
  PresentationLayer layer(falling_boxes());
  // Less than friction holds: a box that travels far makes the broad phase rebuild its tree.
  WrenchCommand command = push(1, 1, "a", Vec3(2, 0, 0));
  command.hold = Hold::duration;
  command.duration_ns = 5'500'000'000;  // ends among the counted frames
  accept(layer, command);
  hashes(layer, 300);
  const std::size_t before = test::allocations();
  for (int n = 0; n < 120; ++n) layer.advance_frame();
  EXPECT_EQ(test::allocations() - before, 0u);
}

// A box of 2 kg that the scene pushes with 3 N from 0.1 s to 0.35 s: frames 7 to 21.
Scene pushed_box() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("a", Vec3(0, 0, 0))};
  WrenchDef def;
  def.body = std::string("a");
  def.force = Vec3(3, 0, 0);
  def.start = 0.1;
  def.duration = 0.25;
  scene.wrenches = {def};
  return scene;
}

TEST(PresentationLayer, HoldsTheWrenchesOfTheSceneInTheirFrames) {
  PresentationLayer layer(pushed_box());
  for (int n = 1; n <= 30; ++n) {
    layer.advance_frame();
    const double frames = std::clamp(n - 6, 0, 15);
    // F t / m, with the rounding of 15 frames of a few sub-steps each.
    EXPECT_NEAR(layer.snapshot().bodies[0].linear_velocity.x(), 3 * frames / 60 / 2, 1e-14) << n;
  }
}

TEST(PresentationLayer, HoldsTheWrenchesOfTheSceneAgainAfterAReset) {
  PresentationLayer layer(pushed_box()), fresh(pushed_box());
  hashes(layer, 10);
  layer.reset();
  const auto again = hashes(layer, 30);
  EXPECT_EQ(again, hashes(fresh, 30));
  EXPECT_NEAR(layer.snapshot().bodies[0].linear_velocity.x(), 0.375, 1e-14);
}

TEST(PresentationLayer, NoClientClearsTheWrenchesOfTheScene) {
  PresentationLayer layer(pushed_box());
  WrenchCommand clear;
  clear.hold = Hold::clear;
  for (const std::uint64_t client : {std::uint64_t{1}, UINT64_MAX}) {
    clear.client = client;
    clear.seq = 1;
    EXPECT_EQ(accept(layer, clear).code, ResultCode::ok);
  }
  hashes(layer, 30);
  EXPECT_NEAR(layer.snapshot().bodies[0].linear_velocity.x(), 0.375, 1e-14);
}

TEST(PresentationLayer, APointOfTheSceneInWIsFixedToTheBodyAtTime0) {
  // Both act at the body's point (0, 0.5, 0): a quarter turn about z has brought it to (−0.5, 0,
  // 0).
  Scene in_W = pushed_box();
  in_W.bodies[0].pose.c = Vec3(1, 2, 3);
  in_W.bodies[0].pose.q = Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  in_W.bodies[0].angular_velocity = Vec3(0, 0, 1);
  in_W.wrenches[0].start = 0;
  in_W.wrenches[0].force = Vec3(0, 3, 0);
  in_W.wrenches[0].point = Vec3(0.5, 2, 3);
  in_W.wrenches[0].point_frame = PointFrame::world;
  Scene in_B = in_W;
  in_B.wrenches[0].point = Vec3(0, 0.5, 0);
  in_B.wrenches[0].point_frame = PointFrame::body;
  PresentationLayer first(in_W), second(in_B);
  hashes(first, 30);
  hashes(second, 30);
  const BodyState &a = first.snapshot().bodies[0], &b = second.snapshot().bodies[0];
  EXPECT_LT(b.angular_velocity.z(), 0.9);  // the arm is there
  EXPECT_NEAR((a.angular_velocity - b.angular_velocity).norm(), 0, 1e-14);
}

TEST(PresentationLayer, NamesAMethodForEachDynamicBody) {
  PresentationLayer layer(falling_boxes());
  EXPECT_EQ(layer.body_methods().size(), 2u);
  layer.advance_frame();
  EXPECT_EQ(layer.body_methods().size(), 2u);
}

// A client's nonsense is answered and nothing else.
TEST(PresentationLayer, MalformedCommandsAreAnsweredAndLeaveTheRunUntouched) {
  const std::vector<std::function<void(WrenchCommand&)>> spoilers = {
      [](auto& c) { c.seq = 0; },
      [](auto& c) { c.body_name = "aa"; },
      [](auto& c) { c.body_name = ""; },
      [](auto& c) { c.body_name = std::string(100'000, 'x'); },
      [](auto& c) { c.body_name = std::string("a\0", 2); },
      [](auto& c) {
        c.body = {99, 1};
      },
      [](auto& c) {
        c.body = {1, 7};
      },
      [](auto& c) { c.body_name = "floor"; },
      [](auto& c) { c.epoch = 2; },
      [](auto& c) { c.epoch = UINT32_MAX; },
      [](auto& c) { c.start_frame = 1; },
      [](auto& c) { c.start_frame = kForever; },
      [](auto& c) { c.force.x() = kNaN; },
      [](auto& c) { c.force.z() = -HUGE_VAL; },
      [](auto& c) { c.force.y() = 1e300; },
      [](auto& c) { c.torque.x() = kNaN; },
      [](auto& c) { c.torque.y() = HUGE_VAL; },
      [](auto& c) { c.torque.z() = -1e13; },
      [](auto& c) {
        c.point_frame = PointFrame::world;
        c.point.x() = kNaN;
      },
      [](auto& c) {
        c.point_frame = PointFrame::body;
        c.point.y() = 1e10;
      },
      [](auto& c) { c.hold = Hold::duration; },
      [](auto& c) {
        c.hold = Hold::duration;
        c.duration_ns = INT64_MIN;
      },
      [](auto& c) {
        c.hold = Hold::duration;
        c.duration_ns = INT64_MAX;
      },
      [](auto& c) { c.hold = static_cast<Hold>(200); },
      [](auto& c) { c.axes = static_cast<Axes>(3); },
      [](auto& c) { c.point_frame = static_cast<PointFrame>(77); },
  };
  PresentationLayer disturbed(falling_boxes()), undisturbed(falling_boxes());
  // Both runs also hold one good push, so that the sums are made anew.
  WrenchCommand good = push(1, 1, "a", Vec3(20, 0, 0));
  good.hold = Hold::until_cleared;
  accept(disturbed, good);
  accept(undisturbed, good);
  disturbed.advance_frame();
  undisturbed.advance_frame();
  std::uint64_t seq = 1;
  for (const auto& spoil : spoilers) {
    WrenchCommand command = push(1, ++seq, "a", Vec3(1, 1, 1));
    spoil(command);
    const Reply reply = accept(disturbed, command);
    EXPECT_NE(reply.code, ResultCode::ok) << seq;
    EXPECT_NE(reply.message, "") << seq;
    EXPECT_EQ(reply.client, 1u);
    EXPECT_EQ(reply.seq, command.seq);
    disturbed.advance_frame();
    undisturbed.advance_frame();
    ASSERT_EQ(disturbed.snapshot().state_hash, undisturbed.snapshot().state_hash) << seq;
  }
}

}  // namespace
}  // namespace poinsot
