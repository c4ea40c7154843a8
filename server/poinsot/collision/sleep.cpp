#include "poinsot/collision/sleep.h"

#include <cstring>

namespace poinsot {
namespace {

constexpr int kFrames = 2;

bool same(const HeldWrench& a, const HeldWrench& b) {
  return a.in_W.force == b.in_W.force && a.in_W.torque == b.in_W.torque &&
         a.in_B.force == b.in_B.force && a.in_B.torque == b.in_B.torque && a.moment == b.moment;
}

}  // namespace

Sleep::Sleep(std::size_t bodies)
    : still_frames_(bodies, 0), group_of_(bodies, -1), next_(bodies, -1) {}

void Sleep::settle(CollisionState& state, const Island& island) {
  const World& world = state.world();
  bool ready = island.result.at_rest && island.result.impacts == 0;
  for (const Eigen::Index i : island.bodies) {
    const auto k = static_cast<std::size_t>(i);
    const bool alone = world.systems.empty() || world.system_of[k] == World::kLone;
    ready = ready && alone && world.moves(i);
  }
  for (const Eigen::Index i : island.bodies) {
    int& frames = still_frames_[static_cast<std::size_t>(i)];
    frames = ready ? frames + 1 : 0;
    ready = ready && frames >= kFrames;
  }
  if (!ready) return;
  // What it rests on must not move either.
  for (const int r : island.records) {
    const PairRecord& record = state.pairs[r];
    if (record.standing && (world.is_kinematic(record.a) || world.is_kinematic(record.b))) return;
  }
  if (before_.empty()) before_.resize(still_frames_.size());
  const auto first = static_cast<int>(island.bodies.front());
  int last = -1;
  for (const Eigen::Index i : island.bodies) {
    lay_down(state, i, first);
    if (last >= 0) next_[static_cast<std::size_t>(last)] = static_cast<int>(i);
    last = static_cast<int>(i);
  }
}

void Sleep::lay_down(CollisionState& state, Eigen::Index i, int group) {
  const auto k = static_cast<std::size_t>(i);
  World& world = state.simulation.world();
  momentum(world.y, i).setZero();
  angular_momentum(world.y, i).setZero();
  state.asleep[k] = 1;
  state.simulation.rest(i);
  state.change_course(i);
  group_of_[k] = group;
  next_[k] = -1;
  before_[k] = {world.y.col(i), world.held[k]};
  ++asleep_;
}

void Sleep::wake(CollisionState& state, Eigen::Index i) {
  for (int k = group_of_[static_cast<std::size_t>(i)]; k >= 0;) {
    const auto body = static_cast<std::size_t>(k);
    state.asleep[body] = 0;
    state.change_course(k);
    group_of_[body] = -1;
    still_frames_[body] = 0;
    --asleep_;
    k = next_[body];
  }
}

void Sleep::wake_changed(CollisionState& state) {
  const World& world = state.world();
  for (std::size_t k = 0; asleep_ > 0 && k < group_of_.size(); ++k) {
    if (group_of_[k] < 0) continue;
    const auto i = static_cast<Eigen::Index>(k);
    const bool unchanged =
        std::memcmp(before_[k].y.data(), world.y.col(i).data(), 13 * sizeof(double)) == 0 &&
        same(before_[k].held, world.held[k]);
    if (!unchanged) wake(state, i);
  }
}

void Sleep::hash_into(Hash64& hash) const {
  for (std::size_t k = 0; k < group_of_.size(); ++k)
    if (group_of_[k] >= 0 || still_frames_[k] > 0)
      hash.add(static_cast<std::uint64_t>(k) << 32 | static_cast<std::uint32_t>(still_frames_[k]));
}

}  // namespace poinsot
