#include "poinsot/runner/command_json.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kThird = 1.0 / 3;

// Every member differs from that of a fresh command.
WrenchCommand full_wrench() {
  return {.client = UINT64_MAX - 1,
          .seq = 2,
          .epoch = 3,
          .slot = 4,
          .body = {5, 6},
          .body_name = "crate \"a\"\n",
          .kind = WrenchKind::tether,
          .force = {0.1, kThird, -1e-300},
          .torque = {1e300, -0.0, 5e-324},
          .axes = Axes::body,
          .point = {0.7, 0.8, 0.9},
          .point_frame = PointFrame::body,
          .target = {1, 2, 3},
          .stiffness = 1e12,
          .damping = 0.3,
          .hold = Hold::until_cleared,
          .duration_ns = -7,
          .start_frame = kForever,
          .outlives_client = true};
}

RunControl full_control() {
  RunControl c;
  c.client = 1;
  c.seq = 2;
  c.epoch = 3;
  c.action = ControlAction::set_state;
  c.frames = 4;
  c.scope = 5;
  c.value = kThird;
  c.timeout_ns = 6;
  c.name = "a";
  c.on_disk = true;
  c.text = "bodies:\n  - {name: ü}\n";
  c.body = {7, 8};
  c.body_name = "b";
  c.sets_position = c.sets_orientation = c.sets_linear = c.sets_angular = true;
  c.position = {1, kThird, 3};
  c.orientation = Quat(0.1, 0.2, 0.3, kThird);
  c.linear_velocity = {4, 5, kThird};
  c.angular_velocity = {-0.0, 7, 8};
  return c;
}

TEST(CommandJson, KnowsEveryMember) {
  // Does not compile when there is one more.
  const auto& [a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11, a12, a13, a14, a15, a16, a17, a18,
               a19] = full_wrench();
  static_cast<void>(a1), static_cast<void>(a19);
  EXPECT_EQ(to_json(full_wrench()).size(), 19u);
  const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, b16, b17, b18, b19,
               b20, b21] = full_control();
  static_cast<void>(b1), static_cast<void>(b21);
  EXPECT_EQ(to_json(full_control()).size(), 21u);
}

TEST(CommandJson, AFreshCommandIsEmpty) {
  EXPECT_EQ(to_json(WrenchCommand{}).dump(), "{}");
  EXPECT_EQ(to_json(RunControl{}).dump(), "{}");
}

TEST(CommandJson, EveryMemberComesBackThroughText) {
  const Json wrench = to_json(full_wrench()), control = to_json(full_control());
  const WrenchCommand w = wrench_from(Json::parse(wrench.dump()));
  const RunControl c = control_from(Json::parse(control.dump()));
  EXPECT_EQ(to_json(w), wrench);
  EXPECT_EQ(to_json(c), control);
  EXPECT_EQ(w.client, full_wrench().client);
  EXPECT_EQ(w.body_name, full_wrench().body_name);
  EXPECT_EQ(w.force, full_wrench().force);
  EXPECT_EQ(w.torque, full_wrench().torque);
  EXPECT_TRUE(std::signbit(w.torque.y()));
  EXPECT_EQ(w.hold, Hold::until_cleared);
  EXPECT_EQ(c.action, ControlAction::set_state);
  EXPECT_EQ(c.orientation.coeffs(), full_control().orientation.coeffs());
  EXPECT_EQ(c.text, full_control().text);
}

TEST(CommandJson, NumbersThatAreNoneComeBack) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  WrenchCommand command;
  command.force = {std::nan(""), kInf, -kInf};
  const WrenchCommand read = wrench_from(Json::parse(to_json(command).dump()));
  EXPECT_TRUE(std::isnan(read.force.x()));
  EXPECT_EQ(read.force.y(), kInf);
  EXPECT_EQ(read.force.z(), -kInf);
}

TEST(CommandJson, ValuesWithoutAWordComeBack) {
  WrenchCommand command;
  command.kind = static_cast<WrenchKind>(77);
  EXPECT_EQ(wrench_from(Json::parse(to_json(command).dump())).kind, static_cast<WrenchKind>(77));
}

TEST(CommandJson, RefusesWhatIsNoCommand) {
  for (const char* text :
       {"[]", "7", R"({"client": -1})", R"({"client": 1.5})", R"({"client": "x"})",
        R"({"epoch": 4294967296})", R"({"force": [1, 2]})", R"({"force": 3})",
        R"({"kind": "forse"})", R"({"kind": 256})", R"({"outlives_client": 1})",
        R"({"body_name": 7})", R"({"body": [1]})", R"({"mass": 1})", R"({"duration_ns": 1e30})"})
    EXPECT_THROW(wrench_from(Json::parse(text)), Error) << text;
}

}  // namespace
}  // namespace poinsot
