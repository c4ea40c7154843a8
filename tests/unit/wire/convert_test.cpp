#include "poinsot/wire/convert.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "poinsot/base/limits.h"
#include "support/protocol_equality.h"
#include "support/protocol_samples.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Type, class Message>
void expect_round_trip(const Message& message) {
  Type wire;
  Message back;
  EXPECT_EQ(to_message(message, wire), "");
  EXPECT_EQ(from_message(wire, back), "");
  expect_same(message, back);
}

TEST(Convert, PosesKeepEveryField) {
  expect_round_trip<msg::v2::PoseFrame>(sample::poses(13, 7));
}
TEST(Convert, ABodyKeepsEveryField) {
  expect_round_trip<msg::v3::BodyDescription>(sample::body_info(4, 9));
}
TEST(Convert, AReportKeepsEveryField) {
  expect_round_trip<msg::v5::RunStatus>(sample::report());
}
TEST(Convert, AWrenchKeepsEveryField) {
  expect_round_trip<msg::v2::BodyWrench>(sample::wrench());
}
TEST(Convert, AControlKeepsEveryField) {
  expect_round_trip<msg::v2::RunRequest>(sample::control());
}
TEST(Convert, AReplyKeepsEveryField) {
  expect_round_trip<msg::v2::CommandReply>(sample::reply());
}

TEST(Convert, AnImpactKeepsEveryField) {
  expect_round_trip<msg::v2::ImpactEvent>(sample::impact());
}
TEST(Convert, ContactsKeepEveryField) {
  expect_round_trip<msg::v1::ContactFrame>(sample::contacts());
}
TEST(Convert, WhatIsHeldKeepsEveryField) {
  expect_round_trip<msg::v1::HeldWrenches>(sample::held());
}
TEST(Convert, AnImpactThatCannotBeIsRefused) {
  const auto refused = [](const std::function<void(ImpactNotice&)>& spoil) {
    ImpactNotice impact = sample::impact(), back;
    spoil(impact);
    msg::v2::ImpactEvent wire;
    EXPECT_EQ(to_message(impact, wire), "");
    return from_message(wire, back);
  };
  EXPECT_EQ(refused([](ImpactNotice& i) { i.time = kNaN; }), "time is not finite");
  EXPECT_EQ(refused([](ImpactNotice& i) { i.b.id = {}; }), "body has no generation");
  EXPECT_EQ(refused([](ImpactNotice& i) { i.normal *= 2; }), "normal is not of length 1");
  EXPECT_EQ(refused([](ImpactNotice& i) { i.a.linear_after.y() = kInfinity; }),
            "linear_after.y is not finite");
}

TEST(Convert, AFrameIntoAUsedSampleLeavesNothingOfTheOldOne) {
  msg::v2::PoseFrame wire;
  PoseSnapshot back;
  ASSERT_EQ(to_message(sample::poses(1, 20), wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  ASSERT_EQ(to_message(sample::poses(2, 3), wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  expect_same(back, sample::poses(2, 3));
}

TEST(Convert, AReportIntoAUsedSampleLeavesNothingOfTheOldOne) {
  RunReport longer = sample::report();
  longer.body_methods.resize(100, Method::rk4);
  msg::v5::RunStatus wire;
  RunReport back;
  for (const RunReport& report : {longer, sample::report()}) {
    ASSERT_EQ(to_message(report, wire), "");
    ASSERT_EQ(from_message(wire, back), "");
    expect_same(report, back);
  }
}

TEST(Convert, EveryMethodKeepsItsNumber) {
  RunReport report = sample::report();
  report.body_methods.clear();
  for (const auto& row : kMethodNames) report.body_methods.push_back(row.value);
  expect_round_trip<msg::v5::RunStatus>(report);
  EXPECT_EQ(msg::v5::METHOD_FLIGHT, static_cast<std::uint8_t>(Method::flight));
  EXPECT_EQ(msg::v5::METHOD_ROSENBROCK, static_cast<std::uint8_t>(Method::rosenbrock));
  EXPECT_EQ(msg::v5::METHOD_EXPLICIT_EULER, static_cast<std::uint8_t>(Method::explicit_euler));
}

TEST(Convert, EveryKindOfShapeKeepsItsParameters) {
  BodyInfo info = sample::body_info(0, 1);
  info.shapes = {{Sphere{1.5}, {}},
                 {Box{{1, 2, 3}}, {}},
                 {Capsule{0.25, 2}, {}},
                 {Cylinder{0.5, 3}, {}},
                 {Cone{0.75, 4}, {}},
                 {Ellipsoid{{3, 2, 1}}, {}},
                 {HalfSpace{{0, 0.6, 0.8}, -2}, {}}};
  msg::v3::BodyDescription wire;
  BodyInfo back;
  ASSERT_EQ(to_message(info, wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  expect_same(info, back);
  EXPECT_EQ(std::get<Sphere>(back.shapes[0].shape).radius, 1.5);
  EXPECT_EQ(std::get<Box>(back.shapes[1].shape).size, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Capsule>(back.shapes[2].shape).radius, 0.25);
  EXPECT_EQ(std::get<Capsule>(back.shapes[2].shape).length, 2);
  EXPECT_EQ(std::get<Cylinder>(back.shapes[3].shape).radius, 0.5);
  EXPECT_EQ(std::get<Cylinder>(back.shapes[3].shape).length, 3);
  EXPECT_EQ(std::get<Cone>(back.shapes[4].shape).radius, 0.75);
  EXPECT_EQ(std::get<Cone>(back.shapes[4].shape).length, 4);
  EXPECT_EQ(std::get<Ellipsoid>(back.shapes[5].shape).semi_axes, Vec3(3, 2, 1));
  EXPECT_EQ(std::get<HalfSpace>(back.shapes[6].shape).normal, Vec3(0, 0.6, 0.8));
  EXPECT_EQ(std::get<HalfSpace>(back.shapes[6].shape).offset, -2);
}

// A tetrahedron with three faces in the coordinate planes.
Convex corner() {
  return {.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}},
          .faces = {{{0, 0, -1}, 0, {0, 2, 1}},
                    {{0, -1, 0}, 0, {0, 1, 3}},
                    {{-1, 0, 0}, 0, {0, 3, 2}},
                    {Vec3::Ones() / std::sqrt(3), 2 / std::sqrt(3), {1, 2, 3}}}};
}

TEST(Convert, AConvexShapeKeepsVerticesAndFaces) {
  BodyInfo info = sample::body_info(0, 1);
  info.shapes = {{corner(), {}}};
  msg::v3::BodyDescription wire;
  BodyInfo back;
  ASSERT_EQ(to_message(info, wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  const auto& convex = std::get<Convex>(back.shapes.at(0).shape);
  EXPECT_EQ(convex.vertices, corner().vertices);
  ASSERT_EQ(convex.faces.size(), 4u);
  constexpr double kRounding = 1e-15;  // normals are computed anew: a few operations on numbers ≤ 4
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(convex.faces[i].loop, corner().faces[i].loop);
    EXPECT_LT((convex.faces[i].normal - corner().faces[i].normal).norm(), kRounding);
    EXPECT_NEAR(convex.faces[i].offset, corner().faces[i].offset, kRounding);
  }
}

// Two triangles that share an edge.
Mesh sheet() {
  return {.vertices = {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, 0.25}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

TEST(Convert, AMeshKeepsVerticesAndTriangles) {
  BodyInfo info = sample::body_info(0, 1);
  info.shapes = {{sheet(), {}}, {corner(), {}}};
  msg::v3::BodyDescription wire;
  BodyInfo back;
  ASSERT_EQ(to_message(info, wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  const auto& mesh = std::get<Mesh>(back.shapes.at(0).shape);
  EXPECT_EQ(mesh.vertices, sheet().vertices);
  EXPECT_EQ(mesh.triangles, sheet().triangles);
  // The same message, used again for what has no triangles.
  info.shapes = {{corner(), {}}};
  ASSERT_EQ(to_message(info, wire), "");
  EXPECT_TRUE(wire.shapes()[0].triangles().empty());
}

TEST(Convert, AKinematicBodyStaysOne) {
  BodyInfo info = sample::body_info(0, 1);
  info.is_static = false;
  info.is_kinematic = true;
  expect_round_trip<msg::v3::BodyDescription>(info);
}

TEST(Convert, ALongReplyIsCutBetweenCharacters) {
  Reply reply = sample::reply();
  reply.message = std::string(kMaxMessageLength - 1, 'a') + "éb";  // é needs two bytes, one fits
  msg::v2::CommandReply wire;
  Reply back;
  ASSERT_EQ(to_message(reply, wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  EXPECT_EQ(back.message, std::string(kMaxMessageLength - 1, 'a'));
}

TEST(Convert, AReplyArrivesWhateverItQuotes) {
  Reply reply = sample::reply();
  reply.message = "2:1: first\n3:1: key '\x1B[2J\x07', \xC3 and é";
  msg::v2::CommandReply wire;
  Reply back;
  ASSERT_EQ(to_message(reply, wire), "");
  ASSERT_EQ(from_message(wire, back), "");
  EXPECT_EQ(back.message, "2:1: first\n3:1: key '?[2J?', ? and é");
}

TEST(Convert, WhatDoesNotFitIsNotSent) {
  msg::v2::PoseFrame frame;
  EXPECT_NE(to_message(sample::poses(0, kMaxBodies + 1), frame), "");
  BodyInfo info = sample::body_info(0, 1);
  msg::v3::BodyDescription body;
  info.name = std::string(kMaxNameLength + 1, 'a');
  EXPECT_NE(to_message(info, body), "");
  info = sample::body_info(0, 1);
  info.shapes.resize(kMaxShapes + 1);
  EXPECT_NE(to_message(info, body), "");
  info.shapes = {{Convex{.vertices = std::vector<Vec3>(kMaxVertices + 1), .faces = {}}, {}}};
  EXPECT_NE(to_message(info, body), "");
  RunReport report = sample::report();
  report.body_methods.resize(kMaxBodies + 1);
  msg::v5::RunStatus status;
  EXPECT_NE(to_message(report, status), "");
  WrenchCommand wrench = sample::wrench();
  wrench.body_name = "\xFF";
  msg::v2::BodyWrench command;
  EXPECT_NE(to_message(wrench, command), "");
}

// Refusals: one fault each, in an otherwise good message; the reason names it.

template <class Type>
struct Fault {
  std::string reason;  // contains
  std::function<void(Type&)> make;
};

template <class Message, class Type>
void expect_refusals(const Message& good, const std::vector<Fault<Type>>& faults) {
  for (const Fault<Type>& fault : faults) {
    Type wire;
    ASSERT_EQ(to_message(good, wire), "");
    fault.make(wire);
    Message out;
    const std::string reason = from_message(wire, out);
    EXPECT_NE(reason.find(fault.reason), std::string::npos)
        << "expected '" << fault.reason << "', got '" << reason << "'";
  }
}

TEST(Convert, MalformedWrenchesAreRefusedWithTheReason) {
  using Wire = msg::v2::BodyWrench;
  expect_refusals<WrenchCommand, Wire>(
      sample::wrench(),
      {{"client is 0", [](Wire& w) { w.client(0); }},
       {"seq is 0", [](Wire& w) { w.seq(0); }},
       {"no body is named",
        [](Wire& w) {
          w.body().generation(0);
          w.body_name("");
        }},
       {"body_name is longer", [](Wire& w) { w.body_name(std::string(kMaxNameLength + 1, 'a')); }},
       {"body_name is not printable", [](Wire& w) { w.body_name("a\xC3"); }},
       {"body_name is not printable", [](Wire& w) { w.body_name("\x1B[2J"); }},
       {"force.y is not finite", [](Wire& w) { w.force().y(kNaN); }},
       {"force.x 1.1e+12 is beyond 1e+12", [](Wire& w) { w.force().x(1.1e12); }},
       {"torque.z is not finite", [](Wire& w) { w.torque().z(-kInfinity); }},
       {"torque.z -2e+12 is beyond", [](Wire& w) { w.torque().z(-2e12); }},
       {"point_of_action.x is not finite", [](Wire& w) { w.point_of_action().x(kNaN); }},
       {"point_of_action.x 2e+09 is beyond", [](Wire& w) { w.point_of_action().x(2e9); }},
       {"axes 2 is unknown", [](Wire& w) { w.axes(static_cast<msg::v1::AxesKind>(2)); }},
       {"point_kind 3 is unknown",
        [](Wire& w) { w.point_kind(static_cast<msg::v1::PointKind>(3)); }},
       {"hold 4 is unknown", [](Wire& w) { w.hold(static_cast<msg::v1::HoldKind>(4)); }},
       {"duration_ns is not positive", [](Wire& w) { w.duration_ns(0); }},
       {"duration_ns is not positive", [](Wire& w) { w.duration_ns(-5); }},
       {"duration_ns is beyond", [](Wire& w) { w.duration_ns(kMaxDurationNs + 1); }}});
}

TEST(Convert, AWrenchAtTheCentreOfMassIgnoresItsPoint) {
  msg::v2::BodyWrench wire;
  ASSERT_EQ(to_message(sample::wrench(), wire), "");
  wire.point_kind(msg::v1::POINT_CENTER_OF_MASS);
  wire.point_of_action().x(kNaN);
  WrenchCommand out;
  EXPECT_EQ(from_message(wire, out), "");
  EXPECT_EQ(out.point, Vec3(0, 0, 0));
}

TEST(Convert, MalformedControlsAreRefusedWithTheReason) {
  using Wire = msg::v2::RunRequest;
  expect_refusals<RunControl, Wire>(
      sample::control(),
      {{"client is 0", [](Wire& w) { w.client(0); }},
       {"seq is 0", [](Wire& w) { w.seq(0); }},
       {"action 16 is unknown", [](Wire& w) { w.action(static_cast<msg::v2::ControlKind>(16)); }},
       {"name is not printable", [](Wire& w) { w.name("\x07"); }},
       {"body_name is not printable", [](Wire& w) { w.body_name("\x07"); }},
       {"position.y is not finite", [](Wire& w) { w.pose().position().y(kNaN); }},
       {"orientation is not a unit", [](Wire& w) { w.pose().orientation({}); }},
       {"linear_velocity.x is not finite", [](Wire& w) { w.linear_velocity().x(kInfinity); }},
       {"angular_velocity.z", [](Wire& w) { w.angular_velocity().z(2 * kMaxSpeed); }}});

  const auto with = [](msg::v2::ControlKind action, auto&& spoil) {
    return [action, spoil](Wire& w) {
      w.action(action);
      spoil(w);
    };
  };
  expect_refusals<RunControl, Wire>(
      sample::control(),
      {{"frames is not between", with(msg::v2::CONTROL_STEP, [](Wire& w) { w.frames(0); })},
       {"frames is not between",
        with(msg::v2::CONTROL_STEP, [](Wire& w) { w.frames(kMaxStepFrames + 1); })},
       {"scope 8 is unknown", with(msg::v2::CONTROL_RESET, [](Wire& w) { w.scope(8); })},
       {"value is not finite", with(msg::v2::CONTROL_RUN_UNTIL, [](Wire& w) { w.value(kNaN); })},
       {"value is negative", with(msg::v2::CONTROL_RUN_UNTIL, [](Wire& w) { w.value(-1); })},
       {"value", with(msg::v2::CONTROL_SCALE, [](Wire& w) { w.value(2 * kMaxTimeScale); })},
       {"timeout_ns is not", with(msg::v2::CONTROL_LOCK_STEP, [](Wire& w) { w.timeout_ns(-1); })},
       {"no body is named", with(msg::v2::CONTROL_REMOVE, [](Wire& w) {
          w.body({});
          w.body_name("");
        })}});
}

TEST(Convert, WhatAControlDoesNotSetIsNotLookedAt) {
  msg::v2::RunRequest wire;
  ASSERT_EQ(to_message(sample::control(), wire), "");
  wire.sets_position(false);
  wire.pose().position().x(kNaN);
  wire.sets_orientation(false);
  wire.pose().orientation({});
  wire.value(kNaN);
  RunControl out;
  EXPECT_EQ(from_message(wire, out), "");
  EXPECT_EQ(out.position, Vec3(0, 0, 0));
  EXPECT_EQ(out.value, 0);
}

TEST(Convert, MalformedRepliesAreRefusedWithTheReason) {
  using Wire = msg::v2::CommandReply;
  expect_refusals<Reply, Wire>(
      sample::reply(),
      {{"client is 0", [](Wire& w) { w.client(0); }},
       {"code 5 is unknown", [](Wire& w) { w.code(5); }},
       {"text is longer", [](Wire& w) { w.text(std::string(kMaxMessageLength + 1, 'a')); }},
       {"text is not printable", [](Wire& w) { w.text("\x07"); }}});
}

TEST(Convert, MalformedPosesAreRefusedWithTheReason) {
  using Wire = msg::v2::PoseFrame;
  expect_refusals<PoseSnapshot, Wire>(
      sample::poses(3, 5),
      {{"bodies[2]: position.x is not finite", [](Wire& w) { w.bodies()[2].position().x(kNaN); }},
       {"bodies[4]: orientation is not a unit quaternion (norm 0)",
        [](Wire& w) { w.bodies()[4].orientation({}); }},
       {"bodies[0]: orientation is not a unit",
        [](Wire& w) { w.bodies()[0].orientation().w(0.6); }},
       {"bodies[0]: orientation is not a unit",
        [](Wire& w) { w.bodies()[0].orientation().x(kNaN); }},
       {"bodies[1]: linear_velocity.z is not finite",
        [](Wire& w) { w.bodies()[1].linear_velocity().z(kInfinity); }},
       {"bodies[1]: angular_velocity.y is not finite",
        [](Wire& w) { w.bodies()[1].angular_velocity().y(kNaN); }},
       {"bodies[3]: body has no generation", [](Wire& w) { w.bodies()[3].body().generation(0); }},
       {"bodies: more than", [](Wire& w) { w.bodies().resize(kMaxBodies + 1); }}});
}

TEST(Convert, MalformedReportsAreRefusedWithTheReason) {
  using Wire = msg::v5::RunStatus;
  expect_refusals<RunReport, Wire>(
      sample::report(),
      {{"state 4 is unknown", [](Wire& w) { w.state(static_cast<msg::v5::RunStateKind>(4)); }},
       {"flags are unknown", [](Wire& w) { w.flags(256); }},
       {"position_error is not finite", [](Wire& w) { w.position_error(kNaN); }},
       {"orientation_error is not finite", [](Wire& w) { w.orientation_error(kInfinity); }},
       {"momentum_error is not finite", [](Wire& w) { w.momentum_error(-kInfinity); }},
       {"body_methods 9 is unknown", [](Wire& w) { w.body_methods()[2] = 9; }},
       {"body_methods: more than 131072", [](Wire& w) { w.body_methods().resize(kMaxBodies + 1); }},
       {"energy is not finite", [](Wire& w) { w.energy(kNaN); }},
       {"contact_residual is not finite", [](Wire& w) { w.contact_residual(kNaN); }},
       {"contact_time is not finite", [](Wire& w) { w.contact_time().cpu_s(kInfinity); }}});
}

TEST(Convert, MalformedBodiesAreRefusedWithTheReason) {
  using Wire = msg::v3::BodyDescription;
  BodyInfo good = sample::body_info(0, 2);
  good.shapes.push_back({corner(), {}});
  good.shapes.push_back({HalfSpace{}, {}});
  good.shapes.push_back({sheet(), {}});
  expect_refusals<BodyInfo, Wire>(
      good,
      {{"body has no generation", [](Wire& w) { w.generation(0); }},
       {"name is not printable", [](Wire& w) { w.name("\xFF"); }},
       {"kind 3 is unknown", [](Wire& w) { w.kind(static_cast<msg::v3::BodyKind>(3)); }},
       {"mass is negative", [](Wire& w) { w.mass(-1); }},
       {"inertia is not finite", [](Wire& w) { w.inertia()[4] = kNaN; }},
       {"pose.orientation is not a unit", [](Wire& w) { w.pose().orientation().z(2); }},
       {"friction is negative", [](Wire& w) { w.friction(-0.1); }},
       {"restitution is not 0 to 1", [](Wire& w) { w.restitution(1.1); }},
       {"too many shapes", [](Wire& w) { w.shapes().resize(kMaxShapes + 1); }},
       {"shapes[0]: size is not positive", [](Wire& w) { w.shapes()[0].parameters()[1] = 0; }},
       {"shapes[0]: kind 9 is unknown",
        [](Wire& w) { w.shapes()[0].kind(static_cast<msg::v3::ShapeKind>(9)); }},
       {"shapes[0]: pose.position.x is not finite",
        [](Wire& w) { w.shapes()[0].pose().position().x(kNaN); }},
       {"shapes[1]: number of vertices", [](Wire& w) { w.shapes()[1].vertices().resize(3); }},
       {"shapes[1]: vertices.y is not finite",
        [](Wire& w) { w.shapes()[1].vertices()[0].y(kNaN); }},
       {"shapes[1]: a face loop of wrong length",
        [](Wire& w) { w.shapes()[1].face_loops()[0] = 2; }},
       {"shapes[1]: a face loop of wrong length",
        [](Wire& w) { w.shapes()[1].face_loops()[12] = 4; }},
       {"shapes[1]: a face index without vertex",
        [](Wire& w) { w.shapes()[1].face_loops()[2] = 4; }},
       {"shapes[1]: a face without area", [](Wire& w) { w.shapes()[1].face_loops()[2] = 0; }},
       {"shapes[1]: fewer than 4 faces", [](Wire& w) { w.shapes()[1].face_loops().resize(12); }},
       {"shapes[2]: normal is not a unit", [](Wire& w) { w.shapes()[2].parameters()[2] = 0.5; }},
       {"shapes[2]: offset is not finite", [](Wire& w) { w.shapes()[2].parameters()[3] = kNaN; }},
       {"shapes[3]: vertices.z is not finite",
        [](Wire& w) { w.shapes()[3].vertices()[1].z(kInfinity); }},
       {"shapes[3]: too many vertices",
        [](Wire& w) { w.shapes()[3].vertices().resize(kMaxMeshVertices + 1); }},
       {"shapes[3]: number of triangle corners",
        [](Wire& w) { w.shapes()[3].triangles().clear(); }},
       {"shapes[3]: number of triangle corners",
        [](Wire& w) { w.shapes()[3].triangles().resize(5); }},
       {"shapes[3]: number of triangle corners",
        [](Wire& w) { w.shapes()[3].triangles().resize(3 * kMaxTriangles + 3); }},
       {"shapes[3]: a triangle index without vertex",
        [](Wire& w) { w.shapes()[3].triangles()[4] = 4; }}});
}

}  // namespace
}  // namespace poinsot
