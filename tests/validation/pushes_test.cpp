// Pushes, as a client sends them: every kind of wrench, in both axes, at every kind of point, for
// one frame, some or until cleared, at once or later, of one client or several. What they do to the
// momenta of a free body is held against closed forms where there are some, and always against the
// reference in 113 bits; the replies against the frames in which they act.

#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "poinsot/presentation/presentation_layer.h"
#include "support/extended_reference.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kFrameRate = 60;          // [Hz]
constexpr std::uint64_t kFrames = 12;      // of a run
constexpr double kTolerance = 1e-12;       // [-] of the impulses
const Vec3 kArm_B(0.31, -0.17, 0.23);      // [m] from the centre of mass
const Vec3 kForce(70, -110, 40);           // [N], [N·s/100]
const Vec3 kTorque(9, 4, -6);              // [N·m]
constexpr double kImpulseTime = 0.01;      // [s] an impulse is the force for that long
constexpr double kStiffness = 900;         // [N/m]
constexpr double kDamping = 25;            // [N·s/m]
const Vec3 kTargetOffset(0.4, 0.9, -0.7);  // [m] of a tether's target from where the body begins

// The bodies: a box with three different moments, and a compound whose centre of mass and principal
// axes are not those of its frame. Both turned, moving and turning.
BodyDef moving(BodyDef body) {
  body.pose.c = {1, -2, 0.5};
  body.pose.q = Quat(0.8, 0.3, -0.4, 0.33).normalized();
  body.linear_velocity = {0.4, -0.1, 0.2};
  body.angular_velocity = {0.7, -0.4, 1.1};
  return body;
}

BodyDef slab() {
  return moving(test::body("body", Box{{1, 0.6, 0.2}}, {0, 0, 0}, 100));
}

BodyDef compound() {
  BodyDef body;
  body.name = "body";
  body.shapes = {{Box{{0.8, 0.2, 0.2}}, {}},
                 {Sphere{0.2}, {{0.5, 0.3, 0.1}, Quat::Identity()}},
                 {Cylinder{0.1, 0.6}, {{-0.3, 0.1, 0.4}, Quat(0.9, 0.3, 0.2, 0.1).normalized()}}};
  std::vector<MassProperties> parts;
  for (const ShapeDef& def : body.shapes)
    parts.push_back(transformed(mass_properties(def.shape, 100), def.pose));
  body.mass_properties = combined(parts);
  return moving(body);
}

// One command, when it is sent, and what it is to do.
struct Sent {
  WrenchCommand command;
  Vec3 arm_B = Vec3::Zero();            // [m] of a point, from the centre of mass
  std::uint64_t after = 0;              // is sent after this frame
  std::uint64_t first = 1;              // reply
  std::uint64_t last = 1;               // reply
  std::uint64_t acts_until = kForever;  // ended earlier than the reply said; 0: before it began

  bool acts_in(std::uint64_t frame) const {
    return command.hold != Hold::clear && first <= frame && frame <= std::min(last, acts_until);
  }

  Sent& in_axes(Axes axes) { return command.axes = axes, *this; }
  Sent& at(PointFrame frame) {
    command.point_frame = frame;
    arm_B = frame == PointFrame::center_of_mass ? Vec3(Vec3::Zero()) : kArm_B;
    return *this;
  }
  Sent& by(std::uint64_t client, std::uint64_t seq) {
    command.client = client;
    command.seq = seq;
    return *this;
  }
  Sent& in_slot(std::uint32_t slot) { return command.slot = slot, *this; }
  Sent& times(double factor) {
    command.force *= factor;
    command.torque *= factor;
    return *this;
  }
  Sent& sent_after(std::uint64_t frame) {
    after = frame;
    if (last != kForever) last += frame + 1 - first;
    first = frame + 1;
    return *this;
  }
  Sent& starting(std::uint64_t frame) {
    command.start_frame = frame;
    if (last != kForever) last += frame - first;
    first = frame;
    return *this;
  }
  Sent& for_frames(std::uint64_t n) {
    command.hold = Hold::duration;
    command.duration_ns = std::llround(1e9 * static_cast<double>(n) / kFrameRate);
    last = first + n - 1;
    return *this;
  }
  Sent& until_cleared() {
    command.hold = Hold::until_cleared;
    last = kForever;
    return *this;
  }
  Sent& ended_with(std::uint64_t frame) { return acts_until = frame, *this; }
};

Sent force() {
  Sent sent;
  sent.command.client = 7;
  sent.command.seq = 1;
  sent.command.body_name = "body";
  sent.command.force = kForce;
  sent.command.torque = kTorque;
  return sent;
}

Sent impulse() {
  Sent sent = force();
  sent.command.kind = WrenchKind::impulse;
  sent.command.force *= kImpulseTime;
  sent.command.torque *= kImpulseTime;
  return sent;
}

// Damped only where the reference can follow: at the centre of mass, where it is a linear drag.
Sent tether() {
  Sent sent = force();
  sent.command.kind = WrenchKind::tether;
  sent.command.target = slab().pose.c + kTargetOffset;
  sent.command.stiffness = kStiffness;
  return sent;
}

Sent clear() {
  Sent sent = force();
  sent.command.hold = Hold::clear;
  return sent;
}

// The oracle: the motion frame by frame, of a body on which these commands act.
class Motion {
 public:
  explicit Motion(const World& world)
      : mass_(world.mass[0]),
        J_B_(world.J_B[0]),
        c_(position(world.y, 0)),
        q_(orientation(world.y, 0)),
        P_(momentum(world.y, 0)),
        L_(angular_momentum(world.y, 0)) {}

  void advance(const std::vector<Sent>& all, std::uint64_t frame) {
    test::ReferenceBody body{.mass = mass_, .J_B = J_B_};
    const Mat3 R = q_.toRotationMatrix();
    for (const Sent& sent : all)
      if (sent.acts_in(frame)) act(sent, R, body);
    test::ExtendedReference exact(body, c_, q_, P_, L_, test::kQuick);
    exact.advance_to(1 / kFrameRate);
    c_ = exact.position();
    q_ = exact.orientation();
    P_ = exact.momentum();
    L_ = exact.angular_momentum();
  }

  const Vec3& P() const { return P_; }
  const Vec3& L() const { return L_; }
  Mat3 R() const { return q_.toRotationMatrix(); }

 private:
  void act(const Sent& sent, const Mat3& R, test::ReferenceBody& body) {
    const WrenchCommand& c = sent.command;
    const bool in_W = c.axes == Axes::world;
    if (c.kind == WrenchKind::impulse) {
      const Vec3 J = in_W ? c.force : Vec3(R * c.force);
      P_ += J;
      L_ += (R * sent.arm_B).cross(J) + (in_W ? c.torque : Vec3(R * c.torque));
    } else if (c.kind == WrenchKind::tether) {
      body.springs.push_back({sent.arm_B, c.target, c.stiffness, 0, 0});
      body.drag_linear += c.damping;
    } else if (in_W) {
      body.held.add_force_at(sent.arm_B, c.force);
      body.held.in_W.torque += c.torque;
    } else {
      body.held.in_B.force += c.force;
      body.held.in_B.torque += c.torque + sent.arm_B.cross(c.force);
    }
  }

  double mass_;
  Mat3 J_B_;
  Vec3 c_;
  Quat q_;
  Vec3 P_, L_;
};

// What the commands are to change the momenta by, where that is a closed form.
struct ClosedForm {
  Vec3 dP = Vec3::Zero(), dL = Vec3::Zero();
  bool knows_dP = true, knows_dL = true;
  double scale_P = 0, scale_L = 0;

  // `R` is the orientation with which the frame begins.
  void add(const std::vector<Sent>& all, std::uint64_t frame, const Mat3& R) {
    for (const Sent& sent : all) {
      if (!sent.acts_in(frame)) continue;
      const WrenchCommand& c = sent.command;
      const bool at_once = c.kind == WrenchKind::impulse, in_W = c.axes == Axes::world;
      const double time = at_once ? 1 : 1 / kFrameRate;
      const Mat3 to_W = in_W ? Mat3(Mat3::Identity()) : R;
      dP += time * (to_W * c.force);
      dL += time * ((R * sent.arm_B).cross(Vec3(to_W * c.force)) + to_W * c.torque);
      const bool tether = c.kind == WrenchKind::tether;
      if (tether || !(at_once || in_W)) knows_dP = false;
      if (tether || !(at_once || (in_W && sent.arm_B.isZero(0)))) knows_dL = false;
      const double most = tether ? c.stiffness * 3 : c.force.norm();
      scale_P += time * most;
      scale_L += time * (most + c.torque.norm());
    }
  }
};

Reply send(PresentationLayer& layer, const Sent& sent) {
  WrenchCommand command = sent.command;
  const World& world = layer.world();
  if (command.point_frame == PointFrame::world)
    command.point = position(world.y, 0) + rotation(world, 0) * sent.arm_B;
  else if (command.point_frame == PointFrame::body)
    command.point = world.center_of_mass[0] + sent.arm_B;
  std::vector<Reply> replies;
  layer.accept({&command, 1}, replies);
  return replies.at(0);
}

// Sends the commands when they are due and advances; after every frame both momenta are held
// against the oracle, and in the end their changes against the closed forms.
void run(const BodyDef& body, const std::vector<Sent>& all) {
  Scene scene = test::empty_scene();
  scene.bodies = {body};
  PresentationLayer layer(scene);
  Motion exact(layer.world());
  ClosedForm closed;
  const Vec3 P0 = exact.P(), L0 = exact.L();
  for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
    for (const Sent& sent : all) {
      if (sent.after != frame - 1) continue;
      const Reply reply = send(layer, sent);
      ASSERT_EQ(reply.code, ResultCode::ok) << reply.message;
      EXPECT_EQ(reply.message, "");
      EXPECT_EQ(reply.client, sent.command.client);
      EXPECT_EQ(reply.seq, sent.command.seq);
      EXPECT_EQ(reply.first_frame, sent.first) << "seq " << sent.command.seq;
      EXPECT_EQ(reply.last_frame, sent.last) << "seq " << sent.command.seq;
      EXPECT_EQ(reply.body, layer.world().ids[0]);
    }
    closed.add(all, frame, exact.R());
    exact.advance(all, frame);
    layer.advance_frame();
    const Vec3 P = momentum(layer.world().y, 0), L = angular_momentum(layer.world().y, 0);
    EXPECT_LE((P - exact.P()).norm(), kTolerance * (closed.scale_P + P0.norm())) << frame;
    EXPECT_LE((L - exact.L()).norm(), kTolerance * (closed.scale_L + L0.norm())) << frame;
  }
  const Vec3 dP = momentum(layer.world().y, 0) - P0, dL = angular_momentum(layer.world().y, 0) - L0;
  EXPECT_GT(closed.scale_P, 0);
  if (closed.knows_dP) {
    EXPECT_LE((dP - closed.dP).norm(), kTolerance * closed.scale_P);
  }
  if (closed.knows_dL) {
    EXPECT_LE((dL - closed.dL).norm(), kTolerance * closed.scale_L);
  }
}

// Every kind × axes × point × start × body --------------------------------------------------------

enum class What { force_for_a_frame, force_for_frames, force_until_cleared, impulse, tether };

struct Case {
  What what;
  Axes axes;
  PointFrame point;
  bool later;
  bool off_centre;  // the compound
};

std::vector<Sent> commands_of(const Case& c) {
  const bool at_center = c.point == PointFrame::center_of_mass;
  Sent sent = c.what == What::impulse ? impulse() : c.what == What::tether ? tether() : force();
  sent.in_axes(c.axes).at(c.point);
  if (c.what == What::tether && at_center) sent.command.damping = kDamping;
  if (c.later) sent.starting(5);
  if (c.what == What::force_for_frames || c.what == What::tether) sent.for_frames(5);
  std::vector<Sent> all = {sent};
  if (c.what == What::force_until_cleared) {
    all[0].until_cleared().ended_with(8);
    all.push_back(clear().by(7, 2).sent_after(8));
  }
  return all;
}

std::string name_of_case(const testing::TestParamInfo<Case>& info) {
  constexpr const char* kWhat[] = {"ForceForAFrame", "ForceForFrames", "ForceUntilCleared",
                                   "Impulse", "Tether"};
  constexpr const char* kPoint[] = {"AtTheCentre", "AtAPointInW", "AtAPointInB"};
  const Case& c = info.param;
  return std::string(kWhat[static_cast<int>(c.what)]) + (c.axes == Axes::world ? "InW" : "InB") +
         kPoint[static_cast<int>(c.point)] + (c.later ? "Later" : "AtOnce") +
         (c.off_centre ? "OnACompound" : "OnASlab");
}

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (const What what : {What::force_for_a_frame, What::force_for_frames,
                          What::force_until_cleared, What::impulse, What::tether})
    for (const Axes axes : {Axes::world, Axes::body})
      for (const PointFrame point :
           {PointFrame::center_of_mass, PointFrame::world, PointFrame::body})
        for (const bool later : {false, true})
          for (const bool off_centre : {false, true}) {
            if (what == What::tether && axes == Axes::body) continue;  // a tether has no axes
            all.push_back({what, axes, point, later, off_centre});
          }
  return all;
}

class Pushes : public testing::TestWithParam<Case> {};

TEST_P(Pushes, ChangeTheMomentaByTheirImpulse) {
  run(GetParam().off_centre ? compound() : slab(), commands_of(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Every, Pushes, testing::ValuesIn(every_case()), name_of_case);

// How they overlap --------------------------------------------------------------------------------

struct Overlap {
  const char* name;
  std::vector<Sent> all;
};

std::vector<Overlap> overlaps() {
  const auto kept = [] { return force().until_cleared(); };
  const auto on_a_point = [](Sent sent) { return sent.at(PointFrame::body); };
  return {
      {"TwoWithoutASlotAddUp", {kept().by(7, 1), kept().times(0.5).by(7, 2)}},
      {"TwoSlotsAddUp", {kept().by(7, 1).in_slot(1), kept().times(-0.5).by(7, 2).in_slot(2)}},
      {"TheSameSlotOfTwoClientsAddsUp",
       {kept().by(7, 1).in_slot(1), kept().times(2).by(8, 1).in_slot(1)}},
      {"FiveClientsAddUp",
       {kept().by(1, 1), on_a_point(kept().by(2, 1)), force().in_axes(Axes::body).by(3, 1),
        impulse().by(4, 1), force().for_frames(4).by(5, 1)}},
      {"TheSameSlotReplaces",
       {kept().by(7, 1).in_slot(3).ended_with(4),
        on_a_point(kept().times(-1).by(7, 2).in_slot(3)).sent_after(4)}},
      {"ALaterReplacementLetsTheFirstActUntilThen",
       {kept().by(7, 1).in_slot(3).ended_with(6), kept().times(2).by(7, 2).in_slot(3).starting(7)}},
      {"WhatHasNotBegunIsReplaced",
       {force().by(7, 1).in_slot(3).starting(8).for_frames(2).ended_with(0),
        force().times(3).by(7, 2).in_slot(3).starting(6)}},
      {"APlanOfOneSlotIsFollowed",
       {kept().by(7, 1).in_slot(3).starting(2).ended_with(4),
        kept().times(-2).by(7, 2).in_slot(3).starting(5).ended_with(8),
        kept().times(3).by(7, 3).in_slot(3).starting(9)}},
      {"AnImpulseReplacesAForceInItsSlot",
       {kept().by(7, 1).in_slot(3).ended_with(4), impulse().by(7, 2).in_slot(3).sent_after(4)}},
      {"ATetherReplacesATetherToAMovingTarget",
       {tether().until_cleared().by(7, 1).in_slot(9).ended_with(3),
        on_a_point(tether().by(7, 2).in_slot(9)).until_cleared().sent_after(3).ended_with(7),
        tether().until_cleared().by(7, 3).in_slot(9).sent_after(7)}},
      {"ATetherAndAForceAddUp", {on_a_point(tether()).until_cleared().by(7, 1), kept().by(8, 1)}},
      {"TwoTethersOfTwoClientsAddUp",
       {on_a_point(tether()).until_cleared().by(7, 1), tether().until_cleared().by(8, 1)}},
      {"AClearInBetweenEndsAllOfTheClient",
       {kept().by(7, 1).ended_with(5), kept().times(2).by(7, 2).in_slot(4).ended_with(5),
        kept().by(8, 1), clear().by(7, 3).sent_after(5)}},
      {"AClearOfASlotLeavesTheOthers",
       {kept().by(7, 1), kept().times(2).by(7, 2).in_slot(4).ended_with(5),
        clear().by(7, 3).in_slot(4).sent_after(5)}},
      {"AClearAheadOfItsTime", {kept().by(7, 1).ended_with(6), clear().by(7, 2).starting(7)}},
      {"AForceGoesOnAfterAClear",
       {kept().by(7, 1).ended_with(3), clear().by(7, 2).sent_after(3),
        kept().by(7, 3).sent_after(6)}},
      {"ImpulsesOfOneFrameAddUp",
       {on_a_point(impulse()).by(7, 1), impulse().in_axes(Axes::body).by(7, 2),
        on_a_point(impulse().in_axes(Axes::body)).by(8, 1).starting(1)}},
      {"ImpulsesOnATumblingBody",
       {on_a_point(impulse()).by(7, 1),
        on_a_point(impulse().in_axes(Axes::body)).by(7, 2).sent_after(5),
        on_a_point(impulse()).by(7, 3).starting(9)}},
  };
}

class OverlappingPushes : public testing::TestWithParam<Overlap> {};

TEST_P(OverlappingPushes, ChangeTheMomentaByTheSumOfThoseThatAct) {
  run(compound(), GetParam().all);
}

INSTANTIATE_TEST_SUITE_P(Every, OverlappingPushes, testing::ValuesIn(overlaps()),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace poinsot
