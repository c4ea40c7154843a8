// What clients ask and what they are answered.

#include <algorithm>

#include "poinsot/base/limits.h"
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

std::string to_message(const WrenchCommand& in, msg::v1::BodyWrench& out) {
  Checks checks;
  checks.text(in.body_name, "body_name", kMaxNameLength);
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.body().slot(in.body.slot);
  out.body().generation(in.body.generation);
  out.body_name(in.body_name);
  assign(out.force(), in.force);
  assign(out.torque(), in.torque);
  out.axes(static_cast<msg::v1::AxesKind>(in.axes));
  assign(out.point_of_action(), in.point);
  out.point_kind(static_cast<msg::v1::PointKind>(in.point_frame));
  out.hold(static_cast<msg::v1::HoldKind>(in.hold));
  out.duration_ns(in.duration_ns);
  out.start_frame(in.start_frame);
  return checks.take();
}

std::string from_message(const msg::v1::BodyWrench& in, WrenchCommand& out) {
  Checks checks;
  check_identity(checks, in.client(), in.seq());
  out.client = in.client();
  out.seq = in.seq();
  out.epoch = in.epoch();
  out.body = {in.body().slot(), in.body().generation()};
  out.body_name = in.body_name().c_str();
  checks.text(out.body_name, "body_name", kMaxNameLength);
  out.force = from(in.force());
  out.torque = from(in.torque());
  checks.vector(out.force, "force", kMaxWrench);
  checks.vector(out.torque, "torque", kMaxWrench);
  out.axes = known(checks, in.axes(), Axes::body, "axes");
  out.point_frame = known(checks, in.point_kind(), PointFrame::body, "point_kind");
  out.point = from(in.point_of_action());
  if (out.point_frame == PointFrame::center_of_mass) out.point = Vec3::Zero();
  checks.vector(out.point, "point_of_action", kMaxPoint);
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
  return checks.take();
}

std::string to_message(const RunControl& in, msg::v1::RunRequest& out) {
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.action(static_cast<msg::v1::ControlKind>(in.action));
  out.frames(in.frames);
  return {};
}

std::string from_message(const msg::v1::RunRequest& in, RunControl& out) {
  Checks checks;
  check_identity(checks, in.client(), in.seq());
  out.client = in.client();
  out.seq = in.seq();
  out.epoch = in.epoch();
  out.action = known(checks, in.action(), ControlAction::reset, "action");
  out.frames = in.frames();
  if (out.action == ControlAction::step)
    checks.require(out.frames >= 1 && out.frames <= kMaxStepFrames,
                   "frames is not between 1 and " + std::to_string(kMaxStepFrames));
  return checks.take();
}

std::string to_message(const Reply& in, msg::v1::CommandReply& out) {
  out.client(in.client);
  out.seq(in.seq);
  out.epoch(in.epoch);
  out.code(static_cast<std::uint8_t>(in.code));
  out.text(std::string(cut(in.message, kMaxMessageLength)));
  out.first_frame(in.first_frame);
  out.last_frame(in.last_frame);
  out.state_hash(in.state_hash);
  return {};
}

std::string from_message(const msg::v1::CommandReply& in, Reply& out) {
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
  checks.text(out.message, "text", kMaxMessageLength);
  out.first_frame = in.first_frame();
  out.last_frame = in.last_frame();
  out.state_hash = in.state_hash();
  return checks.take();
}

}  // namespace poinsot
