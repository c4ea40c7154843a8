#include "poinsot/presentation/held_wrenches.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kFrameRate = 60;

Scene scene_of_three() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("box", Vec3(1, 2, 3)), test::box("crate", Vec3(-4, 0, 1)),
                  test::floor("table")};
  scene.bodies[0].mass_properties.center_of_mass = Vec3(0.1, 0.2, -0.3);
  scene.bodies[0].pose.q = Quat(0.5, 0.5, 0.5, 0.5);  // x → y → z → x
  return scene;
}

WrenchCommand push(std::uint64_t client, std::uint64_t seq, const std::string& body = "box") {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.body_name = body;
  command.force = Vec3(1, 0, 0);
  return command;
}

class HeldWrenchesTest : public testing::Test {
 protected:
  Reply accept(const WrenchCommand& command, std::uint64_t next = 1) {
    std::vector<Reply> replies;
    held_.accept({&command, 1}, world_, next, 5, suggestions_, replies);
    EXPECT_EQ(replies.size(), 1u);
    EXPECT_EQ(replies[0].client, command.client);
    EXPECT_EQ(replies[0].seq, command.seq);
    EXPECT_EQ(replies[0].epoch, 5u);
    return replies[0];
  }

  const HeldWrench& held_in(std::uint64_t frame, std::size_t body = 0) {
    held_.apply_to(layer_, frame);
    return world_.held[body];
  }

  CollisionLayer layer_{scene_of_three()};
  World& world_ = layer_.world();
  HeldWrenches held_{kFrameRate};
  Suggestions suggestions_;
};

TEST(FramesOf, RoundsUpAndIsNeverZero) {
  EXPECT_EQ(frames_of(0.5, 60), 30u);
  EXPECT_EQ(frames_of(0.1, 60), 6u);  // 0.1 · 60 may be a bit more than 6
  EXPECT_EQ(frames_of(1e-9, 60), 1u);
  EXPECT_EQ(frames_of(1.0 / 60, 60), 1u);
  EXPECT_EQ(frames_of(0.0167, 60), 2u);
  EXPECT_EQ(frames_of(1e9, 60), 60'000'000'000u);
  for (std::int64_t n = 1; n < 10'000; ++n) {  // whole milliseconds at 1 kHz are whole frames
    const double duration = 1e-9 * static_cast<double>(n * 1'000'000);
    ASSERT_EQ(frames_of(duration, 1000), static_cast<std::uint64_t>(n));
  }
}

TEST_F(HeldWrenchesTest, ForceAtTheCentreOfMassHasNoTorque) {
  const Reply reply = accept(push(1, 1));
  EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
  EXPECT_EQ(reply.message, "");
  const Wrench wrench = held_in(1).at(rotation(world_, 0));
  EXPECT_EQ(wrench.force, Vec3(1, 0, 0));
  EXPECT_EQ(wrench.torque, Vec3(0, 0, 0));
}

TEST_F(HeldWrenchesTest, ForceInWAtAPointInWHasTheTorqueOfItsArm) {
  WrenchCommand command = push(1, 1);
  command.torque = Vec3(0, 0, 7);
  command.point_frame = PointFrame::world;
  command.point = position(world_.y, 0) + Vec3(0, 2, 0);
  accept(command);
  const Wrench wrench = held_in(1).at(rotation(world_, 0));
  EXPECT_TRUE(wrench.force.isApprox(Vec3(1, 0, 0), 1e-15));
  EXPECT_TRUE(wrench.torque.isApprox(Vec3(0, 0, -2 + 7), 1e-14)) << wrench.torque;
}

TEST_F(HeldWrenchesTest, ThePointTurnsWithTheBodyAndTheForceInWDoesNot) {
  WrenchCommand command = push(1, 1);
  command.point_frame = PointFrame::world;
  command.point = position(world_.y, 0) + Vec3(0, 2, 0);
  accept(command);
  orientation(world_.y, 0) =
      Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX())) * Quat(orientation(world_.y, 0));
  const Wrench wrench = held_in(1).at(rotation(world_, 0));  // the arm now points along z
  EXPECT_TRUE(wrench.force.isApprox(Vec3(1, 0, 0), 1e-15));
  EXPECT_TRUE(wrench.torque.isApprox(Vec3(0, 2, 0), 1e-14)) << wrench.torque;
}

TEST_F(HeldWrenchesTest, APointInBCountsFromTheOriginOfTheBodyFrame) {
  WrenchCommand command = push(1, 1);
  command.point_frame = PointFrame::body;
  command.point = world_.center_of_mass[0] + Vec3(0, 0, 1);  // R turns z into x: parallel to F
  accept(command);
  EXPECT_TRUE(held_in(1).at(rotation(world_, 0)).torque.isZero(1e-15));
  command.seq = 2;
  command.point = world_.center_of_mass[0] + Vec3(1, 0, 0);  // R turns x into y
  accept(command);
  EXPECT_TRUE(held_in(1).at(rotation(world_, 0)).torque.isApprox(Vec3(0, 0, -1), 1e-14));
}

TEST_F(HeldWrenchesTest, AForceInBTurnsWithTheBody) {
  WrenchCommand command = push(1, 1);
  command.axes = Axes::body;
  command.torque = Vec3(0, 0, 5);
  command.point_frame = PointFrame::body;
  command.point = world_.center_of_mass[0] + Vec3(0, 3, 0);
  accept(command);
  const Mat3 R = rotation(world_, 0);
  const Wrench wrench = held_in(1).at(R);
  EXPECT_TRUE(wrench.force.isApprox(R * Vec3(1, 0, 0), 1e-15));
  EXPECT_TRUE(wrench.torque.isApprox(R * Vec3(0, 0, -3 + 5), 1e-14));
}

TEST_F(HeldWrenchesTest, ActsFromTheFirstToTheLastFrameOfTheReplyAndNotLonger) {
  WrenchCommand command = push(1, 1);
  command.hold = Hold::duration;
  command.duration_ns = 50'000'000;  // 3 frames
  command.start_frame = 12;
  const Reply reply = accept(command, 10);
  EXPECT_EQ(reply.first_frame, 12u);
  EXPECT_EQ(reply.last_frame, 14u);
  for (std::uint64_t frame = 10; frame < 20; ++frame)
    EXPECT_EQ(held_in(frame).is_zero(), frame < 12 || frame > 14) << frame;
  EXPECT_EQ(held_.size(), 0u);
}

TEST_F(HeldWrenchesTest, OneFrameIsTheNextOne) {
  const Reply reply = accept(push(1, 1), 8);
  EXPECT_EQ(reply.first_frame, 8u);
  EXPECT_EQ(reply.last_frame, 8u);
  EXPECT_FALSE(held_in(8).is_zero());
  EXPECT_TRUE(held_in(9).is_zero());
}

TEST_F(HeldWrenchesTest, UntilClearedEndsWithTheClearOfTheSameClientOnly) {
  WrenchCommand command = push(1, 1);
  command.hold = Hold::until_cleared;
  EXPECT_EQ(accept(command).last_frame, kForever);
  EXPECT_FALSE(held_in(1'000'000).is_zero());

  WrenchCommand clear = push(2, 1);
  clear.hold = Hold::clear;
  EXPECT_EQ(accept(clear, 1'000'001).code, ResultCode::ok);
  EXPECT_FALSE(held_in(1'000'001).is_zero());

  clear.client = 1;
  clear.seq = 2;
  EXPECT_EQ(accept(clear, 1'000'002).first_frame, 1'000'002u);
  EXPECT_TRUE(held_in(1'000'002).is_zero());
  EXPECT_EQ(held_.size(), 0u);
}

TEST_F(HeldWrenchesTest, ClearNamesOneBodyOrAll) {
  WrenchCommand command = push(1, 1);
  command.hold = Hold::until_cleared;
  accept(command);
  command.seq = 2;
  command.body_name = "crate";
  accept(command);
  WrenchCommand clear = push(1, 3, "crate");
  clear.hold = Hold::clear;
  accept(clear);
  EXPECT_FALSE(held_in(1, 0).is_zero());
  EXPECT_TRUE(held_in(1, 1).is_zero());
  clear.seq = 4;
  clear.body_name.clear();
  EXPECT_EQ(accept(clear, 2).code, ResultCode::ok);
  EXPECT_TRUE(held_in(2, 0).is_zero());
}

TEST_F(HeldWrenchesTest, AClearInTheFutureLetsTheWrenchActUntilThen) {
  WrenchCommand command = push(1, 1);
  command.hold = Hold::until_cleared;
  accept(command);
  WrenchCommand clear = push(1, 2);
  clear.hold = Hold::clear;
  clear.start_frame = 5;
  EXPECT_EQ(accept(clear).first_frame, 5u);
  EXPECT_FALSE(held_in(4).is_zero());
  EXPECT_TRUE(held_in(5).is_zero());
}

TEST_F(HeldWrenchesTest, SumsDoNotDependOnTheOrderOfArrival) {
  std::vector<WrenchCommand> commands;
  for (std::uint64_t client = 1; client <= 5; ++client)
    for (std::uint64_t seq = 1; seq <= 4; ++seq) {
      WrenchCommand command = push(client, seq);
      const double x = 0.1 * static_cast<double>(client) + 1e-9 * static_cast<double>(seq);
      command.force = Vec3(x, 1 / x, 1e7 * x);
      command.point_frame = PointFrame::body;
      command.point = Vec3(x, -x, 1 / (3 * x));
      command.hold = Hold::until_cleared;
      commands.push_back(command);
    }
  HeldWrenches backwards(kFrameRate);
  std::vector<Reply> replies;
  held_.accept(commands, world_, 1, 1, suggestions_, replies);
  for (auto command = commands.rbegin(); command != commands.rend(); ++command)
    backwards.accept({&*command, 1}, world_, 1, 1, suggestions_, replies);
  held_.apply_to(layer_, 1);
  const HeldWrench sum = world_.held[0];
  backwards.apply_to(layer_, 1);
  EXPECT_EQ(sum.in_W.force, world_.held[0].in_W.force);
  EXPECT_EQ(sum.moment, world_.held[0].moment);
  Hash64 a, b;
  held_.hash_into(a);
  backwards.hash_into(b);
  EXPECT_EQ(a.value(), b.value());
}

TEST_F(HeldWrenchesTest, HashForgetsWhatHasEnded) {
  Hash64 none, active, ended;
  held_.hash_into(none);
  WrenchCommand command = push(1, 1);
  command.hold = Hold::duration;
  command.duration_ns = 1'000'000'000 / 30;  // two frames
  accept(command);
  held_.apply_to(layer_, 1);
  held_.end_frame(1);
  held_.hash_into(active);
  held_.apply_to(layer_, 2);
  held_.end_frame(2);
  held_.hash_into(ended);
  EXPECT_NE(none.value(), active.value());
  EXPECT_EQ(none.value(), ended.value());
}

TEST_F(HeldWrenchesTest, RefusesBeyondItsCapacityAndSaysSo) {
  WrenchCommand command = push(1, 1);
  command.hold = Hold::until_cleared;
  for (std::uint64_t n = 0; n < HeldWrenches::kCapacity; ++n) {
    command.client = 1 + n / kMaxHeldPerClient;
    command.seq = 1 + n % kMaxHeldPerClient;
    ASSERT_EQ(accept(command).code, ResultCode::ok);
  }
  ++command.client;
  const Reply reply = accept(command);
  EXPECT_EQ(reply.code, ResultCode::operation_failed);
  EXPECT_NE(reply.message.find("65536 wrenches are held"), std::string::npos) << reply.message;
  EXPECT_EQ(held_.size(), HeldWrenches::kCapacity);
}

struct Case {
  const char* name;
  void (*spoil)(WrenchCommand&);
  ResultCode code;
  const char* reason;
};

class HeldWrenchesRefusal : public HeldWrenchesTest, public testing::WithParamInterface<Case> {};

TEST_P(HeldWrenchesRefusal, SaysWhyAndHoldsNothing) {
  world_.freeze(1);
  WrenchCommand command = push(1, 1);
  GetParam().spoil(command);
  const Reply reply = accept(command, 10);
  EXPECT_EQ(reply.code, GetParam().code);
  EXPECT_NE(reply.message.find(GetParam().reason), std::string::npos) << reply.message;
  EXPECT_EQ(held_.size(), 0u);
  held_.apply_to(layer_, 10);
  for (const HeldWrench& held : world_.held) EXPECT_TRUE(held.is_zero());
}

INSTANTIATE_TEST_SUITE_P(
    Table, HeldWrenchesRefusal,
    testing::Values(Case{"MisspeltName", [](WrenchCommand& c) { c.body_name = "bxo"; },
                         ResultCode::not_found, "no body 'bxo', did you mean 'box'?"},
                    Case{"StrangeName",
                         [](WrenchCommand& c) { c.body_name = std::string(200, 'z'); },
                         ResultCode::not_found, "no body 'zzz"},
                    Case{"NoName", [](WrenchCommand& c) { c.body_name.clear(); },
                         ResultCode::not_found, "no body named"},
                    Case{"UnknownId",
                         [](WrenchCommand& c) {
                           c.body = {17, 1};
                         },
                         ResultCode::not_found, "no body with id 17.1"},
                    Case{"OldGeneration",
                         [](WrenchCommand& c) {
                           c.body = {0, 2};
                         },
                         ResultCode::not_found, "no body with id 0.2"},
                    Case{"StaticBody", [](WrenchCommand& c) { c.body_name = "table"; },
                         ResultCode::incorrect_state, "body 'table' is static"},
                    Case{"FrozenBody", [](WrenchCommand& c) { c.body_name = "crate"; },
                         ResultCode::incorrect_state, "body 'crate' is frozen"},
                    Case{"WrongEpoch", [](WrenchCommand& c) { c.epoch = 4; },
                         ResultCode::wrong_epoch, "meant for epoch 4; epoch 5 runs"},
                    Case{"TooLate", [](WrenchCommand& c) { c.start_frame = 9; },
                         ResultCode::too_late, "start_frame 9 has passed; the next frame is 10"},
                    Case{"BadValue", [](WrenchCommand& c) { c.force.x() = 1e13; },
                         ResultCode::invalid_value, "force is (1e+13, 0, 0) N"},
                    Case{"ClearOfAnUnknownBody",
                         [](WrenchCommand& c) {
                           c.hold = Hold::clear;
                           c.body_name = "crat";
                         },
                         ResultCode::not_found, "did you mean 'crate'?"}),
    [](const auto& row) { return row.param.name; });

TEST_F(HeldWrenchesTest, TakesTheRightEpochAndTheIdOfABody) {
  WrenchCommand command = push(1, 1);
  command.epoch = 5;
  command.body = world_.ids[1];
  EXPECT_EQ(accept(command).code, ResultCode::ok);
  EXPECT_TRUE(held_in(1, 0).is_zero());
  EXPECT_FALSE(held_in(1, 1).is_zero());
}

}  // namespace
}  // namespace poinsot
