#include "poinsot/presentation/command_check.h"

#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

WrenchCommand valid() {
  WrenchCommand command;
  command.client = 7;
  command.seq = 1;
  command.body_name = "box";
  command.force = Vec3(1, 2, 3);
  return command;
}

TEST(CommandCheck, AcceptsThePlainCommandAndTheLimits) {
  EXPECT_FALSE(check_values(valid()));
  WrenchCommand command = valid();
  command.force = Vec3(kMaxWrench, -kMaxWrench, 0);
  command.point_frame = PointFrame::body;
  command.point = Vec3(-kMaxPoint, 0, kMaxPoint);
  command.hold = Hold::duration;
  command.duration_ns = kMaxDurationNs;
  command.start_frame = kMaxFrame;
  EXPECT_FALSE(check_values(command));
}

struct Case {
  const char* name;
  void (*spoil)(WrenchCommand&);
  const char* reason;  // that the refusal must contain
};

class CommandCheckRefusal : public testing::TestWithParam<Case> {};

TEST_P(CommandCheckRefusal, SaysWhatWasReceived) {
  WrenchCommand command = valid();
  GetParam().spoil(command);
  const auto refusal = check_values(command);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, ResultCode::invalid_value);
  EXPECT_NE(refusal->reason.find(GetParam().reason), std::string::npos) << refusal->reason;
}

INSTANTIATE_TEST_SUITE_P(
    Table, CommandCheckRefusal,
    testing::Values(
        Case{"ZeroSeq", [](WrenchCommand& c) { c.seq = 0; }, "seq is 0"},
        Case{"UnknownHold", [](WrenchCommand& c) { c.hold = static_cast<Hold>(9); }, "hold is 9"},
        Case{"UnknownAxes", [](WrenchCommand& c) { c.axes = static_cast<Axes>(2); }, "axes is 2"},
        Case{"UnknownPointFrame",
             [](WrenchCommand& c) { c.point_frame = static_cast<PointFrame>(255); },
             "point_frame is 255"},
        Case{"NaNForce", [](WrenchCommand& c) { c.force.y() = kNaN; }, "force is (1, nan, 3) N"},
        Case{"InfiniteForce", [](WrenchCommand& c) { c.force.x() = -kInf; },
             "force is (-inf, 2, 3) N"},
        Case{"HugeForce", [](WrenchCommand& c) { c.force.z() = 1.1e12; },
             "no component may exceed 1e+12"},
        Case{"NaNTorque", [](WrenchCommand& c) { c.torque.z() = kNaN; }, "torque is (0, 0, nan)"},
        Case{"HugeTorque", [](WrenchCommand& c) { c.torque.x() = -2e12; }, "torque is (-2e+12"},
        Case{"NaNPoint",
             [](WrenchCommand& c) {
               c.point_frame = PointFrame::world;
               c.point.x() = kNaN;
             },
             "point is (nan, 0, 0) m"},
        Case{"FarPoint",
             [](WrenchCommand& c) {
               c.point_frame = PointFrame::body;
               c.point.x() = 2e9;
             },
             "no component may exceed 1e+09"},
        Case{"ZeroDuration", [](WrenchCommand& c) { c.hold = Hold::duration; },
             "duration is 0 ns: it must be positive"},
        Case{"NegativeDuration",
             [](WrenchCommand& c) {
               c.hold = Hold::duration;
               c.duration_ns = -5;
             },
             "duration is -5 ns"},
        Case{"EndlessDuration",
             [](WrenchCommand& c) {
               c.hold = Hold::duration;
               c.duration_ns = kMaxDurationNs + 1;
             },
             "at most 1000000000000000000"},
        Case{"UnknownKind", [](WrenchCommand& c) { c.kind = static_cast<WrenchKind>(3); },
             "kind is 3: the largest known value is 2"},
        Case{"NaNImpulse",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::impulse;
               c.force.x() = kNaN;
             },
             "force is (nan, 2, 3) N·s"},
        Case{"ImpulseThatLasts",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::impulse;
               c.hold = Hold::until_cleared;
             },
             "an impulse acts at the start of one frame"},
        Case{"TetherToNowhere",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::tether;
               c.target.y() = kInf;
             },
             "target is (0, inf, 0) m"},
        Case{"TetherThatPushes",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::tether;
               c.stiffness = -1;
             },
             "stiffness is -1 N/m: it must be 0 to 1e+12"},
        Case{"TetherOfNoStiffness",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::tether;
               c.stiffness = kNaN;
             },
             "stiffness is nan N/m"},
        Case{"TetherThatDrives",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::tether;
               c.damping = -1e-300;
             },
             "damping is -1e-300"},
        Case{"TetherTooStiff",
             [](WrenchCommand& c) {
               c.kind = WrenchKind::tether;
               c.damping = 2e12;
             },
             "damping is 2e+12"},
        Case{"FarStart", [](WrenchCommand& c) { c.start_frame = kForever; },
             "start_frame is 18446744073709551615"}),
    [](const auto& row) { return row.param.name; });

TEST(CommandCheck, IgnoresWhatTheCommandDoesNotUse) {
  WrenchCommand command = valid();
  command.point = Vec3(kNaN, 0, 0);  // acts at the centre of mass
  command.duration_ns = -1;          // one frame
  EXPECT_FALSE(check_values(command));
  command.kind = WrenchKind::tether;
  command.force.x() = kNaN;  // a tether's force follows from its target
  EXPECT_FALSE(check_values(command));
  command.hold = Hold::clear;
  command.stiffness = kNaN;
  EXPECT_FALSE(check_values(command));
  command.kind = WrenchKind::impulse;
  EXPECT_FALSE(check_values(command));
}

TEST(CommandCheck, AnOrientationMayBeRoundedToFloat) {
  RunControl control;
  control.sets_orientation = true;
  control.orientation = Quat(0.5f, 0.5f, 0.70710677f, 0.0f);
  EXPECT_FALSE(check_state(control));
  control.orientation.x() += 1e-5;
  EXPECT_TRUE(check_state(control));
}

}  // namespace
}  // namespace poinsot
