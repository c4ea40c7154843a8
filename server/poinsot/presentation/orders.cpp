// PresentationLayer: the controls that the physics has to know of.

#include <string>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/base/error.h"
#include "poinsot/base/names.h"
#include "poinsot/presentation/command_check.h"
#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/presentation/spawn_check.h"

namespace poinsot {

Reply PresentationLayer::obey(const Order& order) {
  Reply reply;
  reply.client = order.control.client;
  reply.seq = order.control.seq;
  auto refusal = check_epoch(order.control.epoch, epoch_);
  if (!refusal) refusal = carry_out(order, reply);
  if (refusal) {
    reply.code = refusal->code;
    reply.message = std::move(refusal->reason);
  }
  reply.epoch = epoch_;
  reply.first_frame = reply.last_frame = frame_;
  if (reply.state_hash == 0) reply.state_hash = snapshot_.state_hash;
  return reply;
}

std::optional<Refusal> PresentationLayer::carry_out(const Order& order, Reply& reply) {
  const RunControl& control = order.control;
  switch (control.action) {
    case ControlAction::reset:
      if (auto refusal = check_scope(control)) return refusal;
      reset(control.scope);
      return std::nullopt;
    case ControlAction::spawn:
      return spawn(order, reply);
    case ControlAction::remove:
      return remove(control, reply);
    case ControlAction::set_state:
      return set_state(control, reply);
    case ControlAction::save:
      return save(control, reply);
    case ControlAction::restore:
      return restore(order);
    case ControlAction::release:
      held_.release(control.client, frame_ + 1);
      refresh();
      return std::nullopt;
    default:
      return Refusal{ResultCode::feature_unsupported,
                     std::string(name_of<ControlAction>(kControlActionNames, control.action))
                         .append(" changes nothing in the scene")};
  }
}

std::optional<Refusal> PresentationLayer::spawn(const Order& order, Reply& reply) {
  if (!order.fragment || order.fragment->empty()) return invalid("the fragment has no bodies");
  const std::vector<BodyDef>& bodies = *order.fragment;
  if (auto refusal = check_names(bodies, scene_.bodies(), world())) return refusal;
  if (auto refusal = check_overlaps(bodies, scene(), world())) return refusal;
  for (BodyDef body : bodies) {
    const std::size_t place = scene_.add(body);
    const Eigen::Index column = collision_.spawn(body);
    POINSOT_CHECK(column == static_cast<Eigen::Index>(place));
    if (!reply.body) reply.body = world().ids[place];
  }
  follow_scene();
  refresh();
  return std::nullopt;
}

std::optional<Refusal> PresentationLayer::find(const RunControl& control, Eigen::Index& column,
                                               Reply& reply) {
  const auto found = find_body(control.body, control.body_name, world());
  if (!found) return unknown_body(control.body, control.body_name, world(), suggestions_);
  column = *found;
  reply.body = world().ids[static_cast<std::size_t>(column)];
  return std::nullopt;
}

std::optional<Refusal> PresentationLayer::remove(const RunControl& control, Reply& reply) {
  Eigen::Index i = 0;
  if (auto refusal = find(control, i, reply)) return refusal;
  remove_body(i);
  follow_scene();
  refresh();
  return std::nullopt;
}

void PresentationLayer::remove_body(Eigen::Index i) {
  held_.remove_body(i, collision_);
  collision_.remove(i);
  scene_.remove(static_cast<std::size_t>(i));
}

// What is not set stays, but for the rounding of its way out and in.
std::optional<Refusal> PresentationLayer::set_state(const RunControl& control, Reply& reply) {
  if (auto refusal = check_state(control)) return refusal;
  Eigen::Index i = 0;
  if (auto refusal = find(control, i, reply)) return refusal;
  const bool frozen = world().motion[static_cast<std::size_t>(i)] == Motion::frozen;
  const bool fixed = world().motion[static_cast<std::size_t>(i)] == Motion::fixed;
  if (fixed && (control.sets_linear || control.sets_angular))
    return invalid("body '" + world().names[static_cast<std::size_t>(i)] +
                   "' is static: it has no velocity");
  Pose pose = body_pose(world(), i);
  if (control.sets_position) pose.c = control.position;
  if (control.sets_orientation) pose.q = control.orientation.normalized();
  Velocity velocity{linear_velocity(world(), i), angular_velocity(world(), i)};
  if (control.sets_linear) velocity.linear = control.linear_velocity;
  if (control.sets_angular) velocity.angular = control.angular_velocity;
  collision_.set_state(i, pose, velocity);
  if (frozen) held_.hand_on_again(collision_);
  if (fixed) scene_.move_static(static_cast<std::size_t>(i), pose);
  refresh();
  return std::nullopt;
}

std::optional<Refusal> PresentationLayer::save(const RunControl& control, Reply& reply) {
  if (!control.name.empty())
    if (auto refusal = check_store_name(control.name)) return refusal;
  const std::string name = control.name.empty() ? "frame-" + std::to_string(frame_) : control.name;
  const auto checkpoint = make_checkpoint(name);
  ring_.add(checkpoint);
  reply.message = name;
  reply.state_hash = checkpoint->state_hash;
  return std::nullopt;
}

std::optional<Refusal> PresentationLayer::restore(const Order& order) {
  const std::string& name = order.control.name;
  const auto checkpoint = order.checkpoint ? order.checkpoint : ring_.find(name);
  if (!checkpoint) {
    const auto names = ring_.names();
    if (names.empty()) return Refusal{ResultCode::not_found, "no checkpoint is in memory"};
    std::string reason = "no checkpoint '" + name + "' is in memory; there are";
    for (std::size_t k = 0; k < names.size(); ++k)
      reason.append(k == 0 ? " " : ", ").append(names[k]);
    return Refusal{ResultCode::not_found, std::move(reason)};
  }
  try {
    restore(*checkpoint);
  } catch (const Error& error) {
    return Refusal{ResultCode::operation_failed, error.what()};
  }
  return std::nullopt;
}

}  // namespace poinsot
