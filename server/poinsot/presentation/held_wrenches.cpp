#include "poinsot/presentation/held_wrenches.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/presentation/command_check.h"
#include "poinsot/presentation/scene_wrenches.h"

namespace poinsot {
namespace {

// So many clients keep their memory while they hold nothing: who pushes now and then, or frame by
// frame, then does so without an allocation.
constexpr std::size_t kKeptClients = 1024;

constexpr auto by_key = [](const auto& a, const auto& b) {
  return std::tuple(a.client, a.seq) < std::tuple(b.client, b.seq);
};

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

std::string why_it_does_not_move(const World& world, std::size_t i) {
  const std::string body = "body '" + world.names[i] + "' is ";
  if (world.motion[i] == Motion::fixed) return body + "static: nothing moves it";
  if (world.motion[i] == Motion::kinematic) return body + "kinematic: no force moves it";
  return body + "frozen: its state had become non-finite";
}

}  // namespace

std::uint64_t frames_of(double duration, double frame_rate) {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(duration * frame_rate - 1e-6)));
}

HeldWrenches::HeldWrenches(double frame_rate, std::uint64_t revision)
    : frame_rate_(frame_rate), revision_(revision) {}

void HeldWrenches::accept(std::span<const WrenchCommand> commands, const World& world,
                          std::uint64_t next, std::uint32_t epoch, Suggestions& suggestions,
                          std::vector<Reply>& replies) {
  POINSOT_ASSERT(std::is_sorted(commands.begin(), commands.end(), by_key));
  sweep(next);
  Moment moment{world, next, epoch, suggestions};
  for (const WrenchCommand& command : commands) {
    Reply& reply = replies.emplace_back();
    reply.client = command.client;
    reply.seq = command.seq;
    reply.epoch = epoch;
    if (auto refusal = take(command, moment, reply)) {
      reply.code = refusal->code;
      reply.message = std::move(refusal->reason);
      reply.first_frame = reply.last_frame = 0;
    }
  }
  sweep(next);  // what was replaced before it began
}

std::optional<Refusal> HeldWrenches::take(const WrenchCommand& command, Moment& moment,
                                          Reply& reply) {
  if (auto refusal = check_values(command)) return refusal;
  if (auto refusal = check_epoch(command.epoch, moment.epoch)) return refusal;
  if (command.start_frame != 0 && command.start_frame < moment.next)
    return Refusal{ResultCode::too_late, "start_frame " + std::to_string(command.start_frame) +
                                             " has passed; the next frame is " +
                                             std::to_string(moment.next)};
  reply.first_frame = std::max(command.start_frame, moment.next);

  const bool every_body = command.hold == Hold::clear && !command.body && command.body_name.empty();
  const auto column =
      every_body ? std::nullopt : find_body(command.body, command.body_name, moment.world);
  if (!column && !every_body)
    return unknown_body(command.body, command.body_name, moment.world, moment.suggestions);
  if (column) reply.body = moment.world.ids[static_cast<std::size_t>(*column)];
  if (command.hold != Hold::clear) return hold(command, moment, *column, reply);
  end(command.client, {command.slot, column}, reply.first_frame, moment.next);
  reply.last_frame = reply.first_frame;
  return std::nullopt;
}

std::optional<Refusal> HeldWrenches::hold(const WrenchCommand& command, const Moment& moment,
                                          Eigen::Index column, Reply& reply) {
  const auto i = static_cast<std::size_t>(column);
  if (moment.world.motion[i] != Motion::dynamic)
    return Refusal{ResultCode::incorrect_state, why_it_does_not_move(moment.world, i)};
  if (auto refusal = check_room(command, reply.first_frame, moment.next)) return refusal;

  if (command.slot != 0)
    end(command.client, {.slot = command.slot}, reply.first_frame, moment.next);
  reply.last_frame = last_frame_of(command, reply.first_frame, frame_rate_);
  clients_[command.client].add({.seq = command.seq,
                                .first_frame = reply.first_frame,
                                .last_frame = reply.last_frame,
                                .column = column,
                                .slot = command.slot,
                                .kind = command.kind,
                                .axes = command.axes,
                                .outlives_client = command.outlives_client,
                                .force = command.force,
                                .torque = command.torque,
                                .p_B = point_B(command, moment.world, column),
                                .target = command.target,
                                .stiffness = command.stiffness,
                                .damping = command.damping});
  ++size_;
  note_change(set_of(command.kind), reply.first_frame);
  if (reply.last_frame != kForever) next_end_ = std::min(next_end_, reply.last_frame + 1);
  return std::nullopt;
}

// Counts without what the command itself would end.
std::optional<Refusal> HeldWrenches::check_room(const WrenchCommand& command, std::uint64_t first,
                                                std::uint64_t next) const {
  const auto found = clients_.find(command.client);
  const std::size_t own = found == clients_.end() ? 0 : found->second.size();
  const bool may_be_full =
      size_ >= kCapacity || (command.client != kSceneClient && own >= kMaxHeldPerClient);
  if (!may_be_full) return std::nullopt;
  const std::size_t freed = command.slot == 0 || own == 0
                                ? 0
                                : found->second.count_over({.slot = command.slot}, first, next);
  if (command.client != kSceneClient && own - freed >= kMaxHeldPerClient)
    return Refusal{ResultCode::quota_exceeded, "the client holds " + std::to_string(own) +
                                                   " wrenches, as many as one may: clear some"};
  if (size_ - freed >= kCapacity)
    return Refusal{ResultCode::operation_failed,
                   std::to_string(kCapacity) + " wrenches are held, no more can be: clear some"};
  return std::nullopt;
}

void HeldWrenches::end(std::uint64_t client, const Selection& selection, std::uint64_t frame,
                       std::uint64_t next) {
  const auto found = clients_.find(client);
  if (found == clients_.end()) return;
  HeldOfClient& held = found->second;
  const std::size_t before = held.size();
  note_change(held.end(selection, frame, next), frame);
  size_ -= before - held.size();
  next_end_ = std::min(next_end_, held.next_end());
}

void HeldWrenches::note_change(KindSet kinds, std::uint64_t frame) {
  if (kinds == 0) return;
  ++revision_;
  for (const auto& [name, kind] : kWrenchKindNames)
    if ((kinds & set_of(kind)) != 0) due(kind) = std::min(due(kind), frame);
}

void HeldWrenches::sweep(std::uint64_t next) {
  if (next < next_end_) return;
  next_end_ = kForever;
  for (auto client = clients_.begin(); client != clients_.end();) {
    HeldOfClient& held = client->second;
    if (held.sweep(next)) ++revision_;
    next_end_ = std::min(next_end_, held.next_end());
    const bool forget = held.items().empty() && clients_.size() > kKeptClients;
    client = forget ? clients_.erase(client) : std::next(client);
  }
  size_ = 0;
  for (const auto& [client, held] : clients_) size_ += held.size();
}

void HeldWrenches::release(std::uint64_t client, std::uint64_t next) {
  const auto found = clients_.find(client);
  if (client == kSceneClient || found == clients_.end()) return;
  note_change(found->second.release(), next);
  next_end_ = 0;
  sweep(next);
}

void HeldWrenches::release_all_clients() {
  std::erase_if(clients_, [](const auto& client) { return client.first != kSceneClient; });
  size_ = held_by(kSceneClient);
  due_ = {};
  ++revision_;
}

void HeldWrenches::remove_body(Eigen::Index column, CollisionLayer& collision) {
  KindSet kinds = 0;
  constexpr std::uint64_t kAtOnce = 1;  // nothing has acted before frame 1
  for (auto& [client, held] : clients_) kinds |= held.end({.column = column}, kAtOnce, kAtOnce);
  note_change(kinds, 0);
  next_end_ = 0;
  sweep(kAtOnce);
  if (std::erase_if(tethers_, [column](const Tether& t) { return t.column == column; }) > 0)
    collision.set_tethers(tethers_);
}

std::size_t HeldWrenches::held_by(std::uint64_t client) const {
  const auto found = clients_.find(client);
  return found == clients_.end() ? 0 : found->second.size();
}

void HeldWrenches::list(HeldList& list, const World& world) const {
  list.items.clear();
  for (const auto& [client, of_client] : clients_)
    for (const Held& held : of_client.items()) {
      if (list.items.size() == kMaxListed) break;
      const auto i = static_cast<std::size_t>(held.column);
      list.items.push_back({.client = client,
                            .seq = held.seq,
                            .slot = held.slot,
                            .body = world.ids[i],
                            .kind = held.kind,
                            .axes = held.axes,
                            .force = held.force,
                            .torque = held.torque,
                            .point_B = world.center_of_mass[i] + held.p_B,
                            .target = held.target,
                            .stiffness = held.stiffness,
                            .damping = held.damping,
                            .first_frame = held.first_frame,
                            .last_frame = held.last_frame,
                            .outlives_client = held.outlives_client});
    }
  list.left_out = static_cast<std::uint32_t>(size_ - list.items.size());
}

void HeldWrenches::hash_into(Hash64& hash) const {
  for (const auto& [client, held] : clients_) {
    if (held.items().empty()) continue;
    hash.add(client);
    hash.add(held.digest());
  }
}

void HeldWrenches::save(ByteWriter& out) const {
  out(static_cast<std::uint64_t>(clients_.size()));
  for (const auto& [client, held] : clients_) out(client, held.items());
  out(static_cast<std::uint64_t>(tethers_.size()));
  for (const Tether& t : tethers_) out(t.column, t.p_B, t.target, t.stiffness, t.damping);
}

void HeldWrenches::restore(ByteReader& in, Eigen::Index columns) {
  const auto check = [columns](Eigen::Index column) {
    if (column < 0 || column >= columns) ByteReader::fail();
  };
  std::uint64_t clients = 0, tethers = 0;
  for (in(clients); clients > 0; --clients) {
    std::uint64_t client = 0;
    std::vector<Held> items;
    in(client, items);
    HeldOfClient& held = clients_[client];
    for (const Held& item : items) {
      check(item.column);
      held.add(item);
      next_end_ = std::min(next_end_, held.next_end());
    }
    size_ += items.size();
  }
  for (in(tethers); tethers > 0; --tethers) {
    Tether& t = tethers_.emplace_back();
    in(t.column, t.p_B, t.target, t.stiffness, t.damping);
    check(t.column);
  }
}

}  // namespace poinsot
