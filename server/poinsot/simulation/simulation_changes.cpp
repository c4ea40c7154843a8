// Changes of the world between frames: bodies come, go, are moved and kicked, tethers change. What
// a body did before leaves no trace.

#include "poinsot/simulation/column_check.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

Eigen::Index SimulationLayer::add(const BodyDef& body) {
  const Eigen::Index i = world_.add(body);
  const auto k = static_cast<std::size_t>(i);
  if (k == methods_.size()) {
    contact_wrenches_.emplace_back();
    last_good_.conservativeResize(Eigen::NoChange, i + 1);
    methods_.push_back(Method::none);
    driven_.push_back(0);
    memories_.emplace_back();
    all_.push_back(i);
    if (flies_free()) {
      flights_.emplace_back();
      turning_.emplace_back();
      turning_known_.push_back(0);
    }
  }
  begin_anew(i);
  return i;
}

bool SimulationLayer::remove(Eigen::Index i) {
  const bool sprung = !world_.systems.empty();
  if (sprung) drop_springs(i);
  world_.remove(i);
  begin_anew(i);
  return sprung;
}

void SimulationLayer::drop_springs(Eigen::Index i) {
  if (in_scene_system(i))
    for (const Eigen::Index j :
         world_.systems[static_cast<std::size_t>(world_.system_of[static_cast<std::size_t>(i)])]
             .columns)
      memories_[static_cast<std::size_t>(j)] = {};
  const std::vector<StepMemory> before = std::move(system_memories_);
  system_memories_.clear();
  systems_.clear();
  for (const int s : poinsot::drop_springs(world_, i)) {
    systems_.emplace_back(world_.systems[systems_.size()].columns.size());
    system_memories_.push_back(s == kAnother ? StepMemory{} : before[static_cast<std::size_t>(s)]);
  }
  own_.front() = SimulationWorker(world_);
}

void SimulationLayer::set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity) {
  world_.set_state(i, pose, velocity);
  begin_anew(i);
}

// Of what moved the body until now nothing is known any more.
void SimulationLayer::begin_anew(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  if (is_sound(world_.y, i)) last_good_.col(i) = world_.y.col(i);
  methods_[k] = Method::none;
  memories_[k] = {};
  if (in_system(i)) system_memory(world_.system_of[k]) = {};
  driven_[k] = is_pushed(i) ? 1 : 0;
  contact_wrenches_[k] = Wrench{};
}

void SimulationLayer::kick(Eigen::Index i, const Wrench& impulse) {
  const double before = kinetic_energy(world_, i);
  momentum(world_.y, i) += impulse.force;
  angular_momentum(world_.y, i) += impulse.torque;
  methods_[static_cast<std::size_t>(i)] = Method::none;
  total_.work += kinetic_energy(world_, i) - before;
}

// Whether anything but gravity and contacts acts on a body.
bool SimulationLayer::is_pushed(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  if (in_system(i) || !world_.held[k].is_zero()) return true;
  if (world_.drag.empty()) return false;
  const DragDef& drag = world_.drag[k];
  return drag.linear > 0 || drag.quadratic > 0 || drag.angular > 0;
}

bool SimulationLayer::in_system(Eigen::Index i) const {
  return !world_.systems.empty() && world_.system_of[static_cast<std::size_t>(i)] != World::kLone;
}

bool SimulationLayer::in_scene_system(Eigen::Index i) const {
  return in_system(i) && static_cast<std::size_t>(world_.system_of[static_cast<std::size_t>(i)]) <
                             world_.scene_systems;
}

TetherChange SimulationLayer::set_tethers(std::span<const Tether> tethers) {
  const double energy = tether_energy(world_);
  relaid_.clear();
  const TetherChange change = poinsot::set_tethers(world_, tethers, relaid_);
  if (change == TetherChange::none) return change;
  total_.work += tether_energy(world_) - energy;
  for (const Eigen::Index i : relaid_) {
    const auto k = static_cast<std::size_t>(i);
    (in_system(i) ? system_memory(world_.system_of[k]) : memories_[k]) = {};
  }
  if (change == TetherChange::joined) own_.front().prepare(world_);
  return change;
}

}  // namespace poinsot
