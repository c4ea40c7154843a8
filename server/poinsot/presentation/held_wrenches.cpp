#include "poinsot/presentation/held_wrenches.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "poinsot/base/check.h"
#include "poinsot/base/names.h"

namespace poinsot {
namespace {

// Looking for the nearest name costs far more than the rest of a refusal, so a flood of misspelt
// names must not make a frame late.
constexpr int kSuggestionsPerBatch = 8;
constexpr std::size_t kLongestSuggestedName = 64;

constexpr auto by_key = [](const auto& a, const auto& b) {
  return std::tuple(a.client, a.seq) < std::tuple(b.client, b.seq);
};

std::string unknown_body(const WrenchCommand& command, const World& world, int& suggestions) {
  if (command.body)
    return "no body with id " + std::to_string(command.body.slot) + "." +
           std::to_string(command.body.generation);
  if (command.body_name.empty()) return "no body named: give its name or its id";
  std::string reason = "no body '" + command.body_name + "'";
  if (command.body_name.size() > kLongestSuggestedName || suggestions-- <= 0) return reason;
  const std::vector<std::string_view> names(world.names.begin(), world.names.end());
  return reason + did_you_mean(command.body_name, names);
}

std::optional<Eigen::Index> find_body(const WrenchCommand& command, const World& world) {
  return command.body ? world.find(command.body) : world.find(command.body_name);
}

// The point of action from the centre of mass, in B, at this moment.
Vec3 point_B(const WrenchCommand& command, const World& world, Eigen::Index i) {
  switch (command.point_frame) {
    case PointFrame::center_of_mass:
      return Vec3::Zero();
    case PointFrame::world:
      return rotation(world, i).transpose() * (command.point - position(world.y, i));
    case PointFrame::body:
      return command.point - world.center_of_mass[static_cast<std::size_t>(i)];
  }
  POINSOT_CHECK(!"point frame");
  return {};
}

std::uint64_t last_frame_of(const WrenchCommand& command, std::uint64_t first, double frame_rate) {
  switch (command.hold) {
    case Hold::frame:
      return first;
    case Hold::duration:
      return first + frames_of(1e-9 * static_cast<double>(command.duration_ns), frame_rate) - 1;
    case Hold::until_cleared:
      return kForever;
    case Hold::clear:
      break;
  }
  POINSOT_CHECK(!"hold");
  return 0;
}

}  // namespace

std::uint64_t frames_of(double duration, double frame_rate) {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(duration * frame_rate - 1e-6)));
}

HeldWrenches::HeldWrenches(double frame_rate) : frame_rate_(frame_rate) {
  held_.reserve(kCapacity);  // address space only; pages are touched when they are used
}

void HeldWrenches::accept(std::span<const WrenchCommand> commands, const World& world,
                          std::uint64_t next, std::uint32_t epoch, std::vector<Reply>& replies) {
  POINSOT_ASSERT(std::is_sorted(commands.begin(), commands.end(), by_key));
  Moment moment{world, next, epoch, kSuggestionsPerBatch};
  for (const WrenchCommand& command : commands) {
    Reply& reply = replies.emplace_back();
    reply.client = command.client;
    reply.seq = command.seq;
    reply.epoch = epoch;
    if (auto refusal = take(command, moment, reply)) {
      reply.code = refusal->code;
      reply.message = std::move(refusal->reason);
    }
  }
}

std::optional<Refusal> HeldWrenches::take(const WrenchCommand& command, Moment& moment,
                                          Reply& reply) {
  if (auto refusal = check_values(command)) return refusal;
  if (command.epoch != 0 && command.epoch != moment.epoch)
    return Refusal{ResultCode::wrong_epoch, "meant for epoch " + std::to_string(command.epoch) +
                                                "; epoch " + std::to_string(moment.epoch) +
                                                " runs"};
  if (command.start_frame != 0 && command.start_frame < moment.next)
    return Refusal{ResultCode::too_late, "start_frame " + std::to_string(command.start_frame) +
                                             " has passed; the next frame is " +
                                             std::to_string(moment.next)};
  reply.first_frame = std::max(command.start_frame, moment.next);

  const bool every_body = command.hold == Hold::clear && !command.body && command.body_name.empty();
  const auto column = every_body ? std::nullopt : find_body(command, moment.world);
  if (!column && !every_body)
    return Refusal{ResultCode::not_found, unknown_body(command, moment.world, moment.suggestions)};
  if (command.hold != Hold::clear) return hold(command, moment, *column, reply);
  clear(command, column, reply);
  return std::nullopt;
}

std::optional<Refusal> HeldWrenches::hold(const WrenchCommand& command, const Moment& moment,
                                          Eigen::Index column, Reply& reply) {
  const auto i = static_cast<std::size_t>(column);
  if (moment.world.motion[i] != Motion::dynamic)
    return Refusal{ResultCode::incorrect_state,
                   "body '" + moment.world.names[i] +
                       (moment.world.motion[i] == Motion::fixed
                            ? "' is static: nothing moves it"
                            : "' is frozen: its state had become non-finite")};
  if (held_.size() >= kCapacity)
    return Refusal{ResultCode::operation_failed,
                   std::to_string(kCapacity) + " wrenches are held, no more can be: clear some"};

  reply.last_frame = last_frame_of(command, reply.first_frame, frame_rate_);
  held_.push_back({.client = command.client,
                   .seq = command.seq,
                   .first_frame = reply.first_frame,
                   .last_frame = reply.last_frame,
                   .column = column,
                   .axes = command.axes,
                   .force = command.force,
                   .torque = command.torque,
                   .p_B = point_B(command, moment.world, column)});
  changed_ = true;
  return std::nullopt;
}

void HeldWrenches::clear(const WrenchCommand& command, std::optional<Eigen::Index> column,
                         Reply& reply) {
  reply.last_frame = reply.first_frame;
  std::erase_if(held_, [&](Held& held) {
    if (held.client != command.client || (column && held.column != *column)) return false;
    held.last_frame = std::min(held.last_frame, reply.first_frame - 1);
    return held.last_frame < held.first_frame;
  });
  changed_ = true;
}

void HeldWrenches::apply_to(World& world, std::uint64_t frame) {
  if (!changes(frame)) return;
  std::erase_if(held_, [&](const Held& held) { return held.last_frame < frame; });
  if (changed_) std::sort(held_.begin(), held_.end(), by_key);
  std::fill(world.held.begin(), world.held.end(), HeldWrench{});
  next_change_ = kForever;
  for (const Held& held : held_) {
    const bool active = held.first_frame <= frame;
    if (active) add_to(world.held[static_cast<std::size_t>(held.column)], held);
    const std::uint64_t after = held.last_frame == kForever ? kForever : held.last_frame + 1;
    next_change_ = std::min(next_change_, active ? after : held.first_frame);
  }
  changed_ = false;
}

void HeldWrenches::add_to(HeldWrench& sum, const Held& held) {
  if (held.axes == Axes::world) {
    sum.add_force_at(held.p_B, held.force);
    sum.in_W.torque += held.torque;
  } else {
    sum.in_B.force += held.force;
    sum.in_B.torque += held.torque + held.p_B.cross(held.force);
  }
}

void HeldWrenches::hash_into(Hash64& hash, std::uint64_t frame) const {
  for (const Held& held : held_) {
    if (held.last_frame <= frame) continue;
    hash.add(held.client);
    hash.add(held.seq);
    hash.add(held.first_frame);
    hash.add(held.last_frame);
    hash.add(static_cast<std::uint64_t>(held.column));
    hash.add(static_cast<std::uint64_t>(held.axes));
    hash.add(std::span(held.force.data(), 3));
    hash.add(std::span(held.torque.data(), 3));
    hash.add(std::span(held.p_B.data(), 3));
  }
}

}  // namespace poinsot
