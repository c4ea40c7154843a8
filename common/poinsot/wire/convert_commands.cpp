// What clients ask and what they are answered.

#include <algorithm>

#include "poinsot/base/limits.h"
#include "poinsot/base/utf8.h"
#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {
namespace {

void check_identity(Checks& checks, std::uint64_t client, std::uint64_t seq) {
  checks.require(client != 0, "client is 0");
  checks.require(seq != 0, "seq is 0");
}

// The longest beginning of `text` of at most `limit` bytes that ends between characters.
std::string_view cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  while (limit > 0 && (static_cast<unsigned char>(text[limit]) & 0xC0) == 0x80) --limit;
  return text.substr(0, limit);
}

}  // namespace

std::string to_message(const WrenchCommand& in, msg::v2::BodyWrench& out) {
  Checks checks;
  checks.text(in.body_name, "body_name", kMaxNameLength);
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.slot(in.slot);
  assign(out.body(), in.body);
  out.body_name(in.body_name);
  out.kind(static_cast<msg::v1::WrenchKind>(in.kind));
  assign(out.force(), in.force);
  assign(out.torque(), in.torque);
  out.axes(static_cast<msg::v1::AxesKind>(in.axes));
  assign(out.point_of_action(), in.point);
  out.point_kind(static_cast<msg::v1::PointKind>(in.point_frame));
  assign(out.target(), in.target);
  out.stiffness(in.stiffness);
  out.damping(in.damping);
  out.hold(static_cast<msg::v1::HoldKind>(in.hold));
  out.duration_ns(in.duration_ns);
  out.start_frame(in.start_frame);
  out.outlives_client(in.outlives_client);
  return checks.take();
}

std::string from_message(const msg::v2::BodyWrench& in, WrenchCommand& out) {
  Checks checks;
  check_identity(checks, in.client(), in.seq());
  out.client = in.client();
  out.seq = in.seq();
  out.epoch = in.epoch();
  out.slot = in.slot();
  out.body = from(in.body());
  out.body_name = in.body_name().c_str();
  checks.text(out.body_name, "body_name", kMaxNameLength);
  out.kind = known(checks, in.kind(), WrenchKind::tether, "kind");
  out.force = from(in.force());
  out.torque = from(in.torque());
  checks.vector(out.force, "force", kMaxWrench);
  checks.vector(out.torque, "torque", kMaxWrench);
  out.axes = known(checks, in.axes(), Axes::body, "axes");
  out.point_frame = known(checks, in.point_kind(), PointFrame::body, "point_kind");
  out.point = from(in.point_of_action());
  if (out.point_frame == PointFrame::center_of_mass) out.point = Vec3::Zero();
  checks.vector(out.point, "point_of_action", kMaxPoint);
  out.target = from(in.target());
  out.stiffness = in.stiffness();
  out.damping = in.damping();
  if (out.kind == WrenchKind::tether) {
    checks.vector(out.target, "target", kMaxPoint);
    checks.number(out.stiffness, "stiffness", kMaxStiffness);
    checks.number(out.damping, "damping", kMaxStiffness);
    checks.require(out.stiffness >= 0 && out.damping >= 0, "stiffness or damping is negative");
  } else {
    out.target = Vec3::Zero();
    out.stiffness = out.damping = 0;
  }
  out.hold = known(checks, in.hold(), Hold::clear, "hold");
  // A clear without a body means all bodies.
  checks.require(out.body || !out.body_name.empty() || out.hold == Hold::clear, "no body is named");
  out.duration_ns = out.hold == Hold::duration ? in.duration_ns() : 0;
  if (out.hold == Hold::duration) {
    checks.require(out.duration_ns > 0, "duration_ns is not positive");
    checks.require(out.duration_ns <= kMaxDurationNs,
                   "duration_ns is beyond " + std::to_string(kMaxDurationNs));
  }
  out.start_frame = in.start_frame();
  out.outlives_client = in.outlives_client();
  return checks.take();
}

std::string to_message(const RunControl& in, msg::v2::RunRequest& out) {
  Checks checks;
  checks.text(in.body_name, "body_name", kMaxNameLength);
  checks.require(in.name.size() <= kMaxStoreName, "name is too long");
  checks.require(in.text.size() <= kMaxFragment, "text is too long");
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.action(static_cast<msg::v2::ControlKind>(in.action));
  out.frames(in.frames);
  out.scope(in.scope);
  out.value(in.value);
  out.timeout_ns(in.timeout_ns);
  out.name(in.name);
  out.on_disk(in.on_disk);
  out.text(in.text);
  assign(out.body(), in.body);
  out.body_name(in.body_name);
  out.sets_position(in.sets_position);
  out.sets_orientation(in.sets_orientation);
  out.sets_linear_velocity(in.sets_linear);
  out.sets_angular_velocity(in.sets_angular);
  assign(out.pose().position(), in.position);
  assign(out.pose().orientation(), in.orientation);
  assign(out.linear_velocity(), in.linear_velocity);
  assign(out.angular_velocity(), in.angular_velocity);
  return checks.take();
}

namespace {

// Of the fields that set a state only those that are set are looked at.
void read_state(Checks& checks, const msg::v2::RunRequest& in, RunControl& out) {
  out.sets_position = in.sets_position();
  out.sets_orientation = in.sets_orientation();
  out.sets_linear = in.sets_linear_velocity();
  out.sets_angular = in.sets_angular_velocity();
  out.position = out.sets_position ? from(in.pose().position()) : Vec3(Vec3::Zero());
  out.orientation = out.sets_orientation ? from(in.pose().orientation()) : Quat::Identity();
  out.linear_velocity = out.sets_linear ? from(in.linear_velocity()) : Vec3(Vec3::Zero());
  out.angular_velocity = out.sets_angular ? from(in.angular_velocity()) : Vec3(Vec3::Zero());
  checks.vector(out.position, "position", kMaxPoint);
  checks.unit(out.orientation, "orientation");
  checks.vector(out.linear_velocity, "linear_velocity", kMaxSpeed);
  checks.vector(out.angular_velocity, "angular_velocity", kMaxSpeed);
}

// Numbers of the action alone: those of others are not looked at.
void check_numbers(Checks& checks, const RunControl& control) {
  switch (control.action) {
    case ControlAction::step:
      return checks.require(control.frames >= 1 && control.frames <= kMaxStepFrames,
                            "frames is not between 1 and " + std::to_string(kMaxStepFrames));
    case ControlAction::reset:
      return checks.require(control.scope <= kMaxResetScope,
                            "scope " + std::to_string(control.scope) + " is unknown");
    case ControlAction::run_until:
      checks.number(control.value, "value", kMaxRunTime);
      return checks.require(control.value >= 0, "value is negative");
    case ControlAction::scale:
      checks.number(control.value, "value", kMaxTimeScale);
      return checks.require(control.value >= 0, "value is negative");
    case ControlAction::lock_step:
      return checks.require(control.timeout_ns >= 0 && control.timeout_ns <= kMaxLockStepNs,
                            "timeout_ns is not between 0 and " + std::to_string(kMaxLockStepNs));
    case ControlAction::remove:
    case ControlAction::set_state:
      return checks.require(control.body || !control.body_name.empty(), "no body is named");
    default:
      return;
  }
}

}  // namespace

std::string from_message(const msg::v2::RunRequest& in, RunControl& out) {
  Checks checks;
  check_identity(checks, in.client(), in.seq());
  out.client = in.client();
  out.seq = in.seq();
  out.epoch = in.epoch();
  out.action = known(checks, in.action(), ControlAction::release, "action");
  out.frames = in.frames();
  out.scope = in.scope();
  const bool has_value =
      out.action == ControlAction::run_until || out.action == ControlAction::scale;
  out.value = has_value ? in.value() : 0;
  out.timeout_ns = in.timeout_ns();
  out.name = in.name().c_str();
  checks.text(out.name, "name", kMaxStoreName);
  out.on_disk = in.on_disk();
  out.text = out.action == ControlAction::spawn ? in.text() : std::string();
  checks.require(out.text.size() <= kMaxFragment, "text is too long");
  out.body = from(in.body());
  out.body_name = in.body_name().c_str();
  checks.text(out.body_name, "body_name", kMaxNameLength);
  read_state(checks, in, out);
  check_numbers(checks, out);
  return checks.take();
}

std::string to_message(const Reply& in, msg::v2::CommandReply& out) {
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.code(static_cast<std::uint8_t>(in.code));
  // A message may quote what somebody sent, in escapes too: the reader is to show it all the same.
  out.text(std::string(cut(to_printable_lines(in.message), kMaxMessageLength)));
  out.first_frame(in.first_frame);
  out.last_frame(in.last_frame);
  out.state_hash(in.state_hash);
  assign(out.body(), in.body);
  return {};
}

std::string from_message(const msg::v2::CommandReply& in, Reply& out) {
  Checks checks;
  check_identity(checks, in.client(), in.seq());
  out.client = in.client();
  out.seq = in.seq();
  out.epoch = in.epoch();
  out.code = static_cast<ResultCode>(in.code());
  checks.require(std::any_of(kResultCodeNames.begin(), kResultCodeNames.end(),
                             [&](const auto& row) { return row.value == out.code; }),
                 "code " + std::to_string(in.code()) + " is unknown");
  out.message = in.text().c_str();
  checks.lines(out.message, "text", kMaxMessageLength);
  out.first_frame = in.first_frame();
  out.last_frame = in.last_frame();
  out.state_hash = in.state_hash();
  out.body = from(in.body());
  return checks.take();
}

}  // namespace poinsot
