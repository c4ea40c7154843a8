#include "poinsot/base/limits.h"
#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {

std::string to_message(const PoseSnapshot& in, msg::v2::PoseFrame& out) {
  if (in.bodies.size() > kMaxBodies)
    return "bodies: more than " + std::to_string(kMaxBodies) + " in one frame";
  out.session(in.session);
  out.epoch(in.epoch);
  out.frame_index(in.frame);
  out.sample_number(in.sequence);
  out.total(in.total);
  out.complete(in.complete);
  out.sim_time_ns(in.sim_time_ns);
  out.publish_time_ns(in.publish_time_ns);
  out.state_hash(in.state_hash);
  out.bodies().resize(in.bodies.size());
  for (std::size_t i = 0; i < in.bodies.size(); ++i) {
    const BodyState& from = in.bodies[i];
    msg::v2::BodyMotion& to = out.bodies()[i];
    assign(to.body(), from.id);
    assign(to.position(), from.position);
    assign(to.orientation(), from.orientation);
    assign(to.linear_velocity(), from.linear_velocity);
    assign(to.angular_velocity(), from.angular_velocity);
  }
  return {};
}

std::string from_message(const msg::v2::PoseFrame& in, PoseSnapshot& out) {
  if (in.bodies().size() > kMaxBodies)
    return "bodies: more than " + std::to_string(kMaxBodies) + " in one frame";
  out.session = in.session();
  out.epoch = in.epoch();
  out.frame = in.frame_index();
  out.sequence = in.sample_number();
  out.total = in.total();
  out.complete = in.complete();
  out.sim_time_ns = in.sim_time_ns();
  out.publish_time_ns = in.publish_time_ns();
  out.state_hash = in.state_hash();
  out.bodies.resize(in.bodies().size());
  Checks checks;
  for (std::size_t i = 0; i < out.bodies.size() && checks.ok(); ++i) {
    const msg::v2::BodyMotion& from_body = in.bodies()[i];
    BodyState& body = out.bodies[i];
    body.id = from(from_body.body());
    body.position = from(from_body.position());
    body.orientation = from(from_body.orientation());
    body.linear_velocity = from(from_body.linear_velocity());
    body.angular_velocity = from(from_body.angular_velocity());
    checks.require(static_cast<bool>(body.id), "body has no generation");
    checks.vector(body.position, "position");
    checks.unit(body.orientation, "orientation");
    checks.vector(body.linear_velocity, "linear_velocity");
    checks.vector(body.angular_velocity, "angular_velocity");
    if (!checks.ok()) return "bodies[" + std::to_string(i) + "]: " + checks.take();
  }
  return {};
}

}  // namespace poinsot
