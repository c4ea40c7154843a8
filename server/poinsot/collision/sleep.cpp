#include "poinsot/collision/sleep.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace poinsot {
namespace {

constexpr double kSlow = 1e-4;       // [m/s]
constexpr double kSlower = 0.99;     // of the speed when it was last looked at
constexpr std::uint64_t kEvery = 8;  // frames; islands take turns
// A proof that failed is tried again after twice as many frames as the one before, at most so many.
constexpr std::uint32_t kLongestWait = 16;  // times kEvery

bool same(const HeldWrench& a, const HeldWrench& b) {
  return a.in_W.force == b.in_W.force && a.in_W.torque == b.in_W.torque &&
         a.in_B.force == b.in_B.force && a.in_B.torque == b.in_B.torque && a.moment == b.moment;
}

}  // namespace

Sleep::Sleep(std::size_t bodies)
    : speed_(bodies, -1),
      wait_(bodies, 0),
      ask_again_(bodies, 0),
      group_of_(bodies, -1),
      next_(bodies, -1) {}

void Sleep::fit(std::size_t bodies) {
  speed_.resize(bodies, -1);
  wait_.resize(bodies, 0);
  ask_again_.resize(bodies, 0);
  group_of_.resize(bodies, -1);
  next_.resize(bodies, -1);
  if (!before_.empty()) before_.resize(bodies);
}

void Sleep::forget(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  speed_[k] = -1;
  wait_[k] = 0;
  ask_again_[k] = 0;
}

bool Sleep::may_sleep(const CollisionState& state, const Island& island) {
  const World& world = state.world();
  const auto first = static_cast<std::size_t>(island.bodies.front());
  if ((frame_ + first) % kEvery != 0 || island.result.impacts > 0) return false;
  double speed = 0;
  for (const Eigen::Index i : island.bodies) {
    const auto k = static_cast<std::size_t>(i);
    const bool alone = world.systems.empty() || world.system_of[k] == World::kLone;
    if (!alone || !world.moves(i)) return false;
    speed = std::max({speed, linear_velocity(world, i).norm(),
                      state.arm[k] * angular_velocity(world, i).norm()});
  }
  // What it rests on must not move either.
  for (const int r : island.records) {
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
    if (record.standing && (world.is_kinematic(record.a) || world.is_kinematic(record.b)))
      return false;
  }
  const double before = std::exchange(speed_[first], speed);
  const double still = state.def.sleep_acceleration * state.def.contact_step;
  const bool tired = speed <= still || (speed <= kSlow && before >= 0 && speed <= kSlower * before);
  if (speed > kSlow) wait_[first] = 0;
  if (!tired || (wait_[first] > 0 && frame_ < ask_again_[first])) return false;
  wait_[first] = std::min(kLongestWait, std::max(1u, 2 * wait_[first]));
  ask_again_[first] = frame_ + kEvery * wait_[first];
  return true;
}

void Sleep::lay_down(CollisionState& state, const Island& island) {
  if (before_.empty()) before_.resize(speed_.size());
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
  state.courses[k] = Course::still({position(world.y, i), orientation(world.y, i)}, world.time,
                                   std::numeric_limits<double>::infinity());
  state.course_stamp[k] = state.stamp[k];
  group_of_[k] = group;
  wait_[k] = 0;
  next_[k] = -1;
  before_[k] = {world.y.col(i), world.held[k]};
  ++asleep_;
}

void Sleep::wake(CollisionState& state, Eigen::Index i) {
  for (int k = group_of_[static_cast<std::size_t>(i)]; k >= 0;) {
    const auto body = static_cast<std::size_t>(k);
    state.asleep[body] = 0;
    state.body_time[body] = state.world().time;
    state.change_course(k);
    group_of_[body] = -1;
    speed_[body] = -1;
    wait_[body] = 0;
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
  hash.add(frame_);
  for (std::size_t k = 0; k < group_of_.size(); ++k) {
    if (group_of_[k] >= 0)
      hash.add(static_cast<std::uint64_t>(k) << 32 | static_cast<std::uint32_t>(group_of_[k]));
    if (speed_[k] >= 0) hash.add(speed_[k]);
    if (wait_[k] > 0) hash.add(ask_again_[k] << 8 | wait_[k]);
  }
}

}  // namespace poinsot
