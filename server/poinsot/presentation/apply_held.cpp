// HeldWrenches, before a frame: what acts in it is handed to the collision layer.

#include <algorithm>

#include "poinsot/presentation/held_wrenches.h"

namespace poinsot {
namespace {

bool same(const Tether& a, const Tether& b) {
  return a.column == b.column && a.p_B == b.p_B && a.target == b.target &&
         a.stiffness == b.stiffness && a.damping == b.damping;
}

void add_to(HeldWrench& sum, const Held& held) {
  if (held.axes == Axes::world) {
    sum.add_force_at(held.p_B, held.force);
    sum.in_W.torque += held.torque;
  } else {
    sum.in_B.force += held.force;
    sum.in_B.torque += held.torque + held.p_B.cross(held.force);
  }
}

// About the centre of mass, in W, at the orientation R (B → W) of the moment.
Wrench impulse_of(const Held& held, const Mat3& R) {
  const Mat3 to_W = held.axes == Axes::world ? Mat3(Mat3::Identity()) : R;
  const Vec3 linear = to_W * held.force;
  return {linear, to_W * held.torque + (R * held.p_B).cross(linear)};
}

}  // namespace

bool HeldWrenches::changes(std::uint64_t frame) const {
  return frame >= *std::ranges::min_element(due_);
}

void HeldWrenches::apply_to(CollisionLayer& collision, std::uint64_t frame) {
  sweep(frame);
  if (frame >= due(WrenchKind::force)) sum_forces(collision.world(), frame);
  if (frame >= due(WrenchKind::tether)) set_tethers(collision, frame);
  if (frame >= due(WrenchKind::impulse)) kick(collision, frame);
}

// In the order (client, seq).
template <class Visit>
void HeldWrenches::each_of(WrenchKind kind, Visit&& visit) const {
  for (const auto& [client, of_client] : clients_) {
    if (of_client.count(kind) == 0) continue;
    for (const Held& held : of_client.items())
      if (held.kind == kind) visit(held);
  }
}

void HeldWrenches::sum_forces(World& world, std::uint64_t frame) {
  if (sums_known_)
    for (const Eigen::Index i : summed_) world.held[static_cast<std::size_t>(i)] = {};
  else
    std::fill(world.held.begin(), world.held.end(), HeldWrench{});
  sums_known_ = true;
  summed_.clear();
  std::uint64_t next = kForever;
  each_of(WrenchKind::force, [&](const Held& held) {
    next = std::min(next, held.changes_after(frame));
    if (!held.acts_in(frame)) return;
    add_to(world.held[static_cast<std::size_t>(held.column)], held);
    summed_.push_back(held.column);
  });
  due(WrenchKind::force) = next;
}

// Only another set is handed on: a set that is given again might wake bodies.
void HeldWrenches::set_tethers(CollisionLayer& collision, std::uint64_t frame) {
  next_tethers_.clear();
  std::uint64_t next = kForever;
  each_of(WrenchKind::tether, [&](const Held& held) {
    next = std::min(next, held.changes_after(frame));
    if (held.acts_in(frame))
      next_tethers_.push_back({held.column, held.p_B, held.target, held.stiffness, held.damping});
  });
  due(WrenchKind::tether) = next;
  if (std::ranges::equal(next_tethers_, tethers_, same)) return;
  tethers_.swap(next_tethers_);
  collision.set_tethers(tethers_);
}

void HeldWrenches::hand_on_again(CollisionLayer& collision) const {
  if (!tethers_.empty()) collision.set_tethers(tethers_);
}

void HeldWrenches::kick(CollisionLayer& collision, std::uint64_t frame) {
  std::uint64_t next = kForever;
  const World& world = std::as_const(collision).world();
  each_of(WrenchKind::impulse, [&](const Held& held) {
    if (held.first_frame > frame) next = std::min(next, held.first_frame);
    if (!held.acts_in(frame) || !world.moves(held.column)) return;  // it may have been frozen since
    collision.kick(held.column, impulse_of(held, rotation(world, held.column)));
  });
  due(WrenchKind::impulse) = next;
}

}  // namespace poinsot
