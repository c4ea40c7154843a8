#include "poinsot/simulation/simulation_layer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/base/error.h"
#include "poinsot/simulation/column_check.h"

namespace poinsot {
namespace {

bool is_finite(const HeldWrench& w) {
  return w.in_W.force.allFinite() && w.in_W.torque.allFinite() && w.in_B.force.allFinite() &&
         w.in_B.torque.allFinite() && w.moment.allFinite();
}

}  // namespace

void Tally::add(const Tally& later) {
  work += later.work;
  error += later.error;
  mismatch += later.mismatch;
  largest_momentum = std::max(largest_momentum, later.largest_momentum);
  quarantined += later.quarantined;
  stiff |= later.stiff;
}

void Tally::add_apart(const Tally& others) {
  work += others.work;
  error.raise_to(others.error);
  mismatch = std::max(mismatch, others.mismatch);
  largest_momentum = std::max(largest_momentum, others.largest_momentum);
  quarantined += others.quarantined;
  stiff |= others.stiff;
}

SimulationLayer::SimulationLayer(const Scene& scene)
    : world_(scene),
      integration_(scene),
      contact_wrenches_(static_cast<std::size_t>(world_.size())),
      last_good_(world_.y),
      methods_(contact_wrenches_.size(), Method::none),
      driven_(methods_.size(), 0),
      memories_(methods_.size()),
      system_memories_(world_.systems.size()) {
  if (flies_free()) {
    flights_.resize(methods_.size());
    turning_.resize(methods_.size());
    turning_known_.resize(methods_.size(), 0);
  }
  for (const BodySystem& system : world_.systems) systems_.emplace_back(system.columns.size());
  for (Eigen::Index i = 0; i < world_.size(); ++i) all_.push_back(i);
  own_.emplace_back(world_);
}

SimulationWorker::SimulationWorker(const World& world) : lone(1) {
  for (std::size_t s = 0; s < world.scene_systems; ++s)
    systems.emplace_back(world.systems[s].columns.size());
  prepare(world);
}

void SimulationWorker::prepare(const World& world) {
  std::size_t bodies = 1, springs = 0;
  for (const BodySystem& system : world.systems) {
    bodies = std::max(bodies, system.columns.size());
    springs = std::max(springs, system.springs.size());
  }
  taylor.prepare(bodies, springs);
}

void SimulationLayer::begin(double t_end) {
  if (!std::isfinite(t_end)) throw Error("advance_to: the time must be finite");
  if (t_end < world_.time)
    throw Error("advance_to: time runs backwards: it is " + std::to_string(world_.time) +
                " s, asked for " + std::to_string(t_end) + " s");
  constexpr double kMostFixedSteps = 1e9;  // more would not end, and not fit a count
  if (!is_adaptive(integration_.kind()) &&
      t_end - world_.time > kMostFixedSteps * integration_.longest_step())
    throw Error("advance_to: " + std::to_string(t_end - world_.time) +
                " s would take more than 1e9 steps of " +
                std::to_string(integration_.longest_step()) + " s");
  for (std::size_t k = 0; k < driven_.size(); ++k) {
    driven_[k] = is_pushed(static_cast<Eigen::Index>(k)) ? 1 : 0;
    if (driven_[k] != 0 && !is_finite(world_.held[k]))
      throw Error("body '" + world_.names[k] + "': the held wrench is not finite");
  }
}

void SimulationLayer::advance_to(double t_end) {
  begin(t_end);
  Tally tally;
  advance(all_, world_.time, t_end, true, own_.front(), tally);
  commit(t_end, tally);
}

void SimulationLayer::commit(double t_end, const Tally& tally) {
  frame_error_ = tally.error;
  total_.add(tally);
  world_.time = t_end;
}

// A tethered body that is no system of the scene works with the means of a lone body.
SimulationLayer::Group SimulationLayer::system_group(int s, std::vector<Workspace>& of_scene,
                                                     Workspace& lone, StepMemory& memory) {
  const auto k = static_cast<std::size_t>(s);
  const BodySystem& system = world_.systems[k];
  return {system.columns, system.springs, k < world_.scene_systems ? of_scene[k] : lone, memory};
}

StepMemory& SimulationLayer::system_memory(int s) {
  const auto k = static_cast<std::size_t>(s);
  if (k < world_.scene_systems) return system_memories_[k];
  return memories_[static_cast<std::size_t>(world_.systems[k].columns[0])];
}

void SimulationLayer::advance(std::span<const Eigen::Index> bodies, double from, double to,
                              bool in_contact, SimulationWorker& worker, Tally& tally) {
  Advance advance{worker, in_contact, {}, 0};
  for (const Eigen::Index i : bodies) {
    const auto k = static_cast<std::size_t>(i);
    if (in_system(i)) {
      const auto s = static_cast<std::size_t>(world_.system_of[k]);
      if (world_.systems[s].columns[0] == i)
        integrate(system_group(world_.system_of[k], systems_, worker.lone,
                               system_memory(world_.system_of[k])),
                  to - from, advance, tally);
    } else if (world_.is_kinematic(i)) {
      const Pose pose = kinematic_course(i, to).at(to);
      position(world_.y, i) = pose.c;
      orientation(world_.y, i) = pose.q;
      methods_[k] = Method::none;
    } else if (!world_.moves(i)) {
      methods_[k] = Method::none;
    } else if (flies_free() && driven_[k] == 0 && !(in_contact && !is_zero(contact_wrenches_[k]))) {
      fly(i, from, to, tally);
    } else {
      integrate({std::span(&i, 1), {}, worker.lone, memories_[k]}, to - from, advance, tally);
    }
  }
  tally.error += advance.error;
  tally.mismatch += advance.mismatch;
  freeze_unsound(bodies, tally);
  for (const Eigen::Index i : bodies) {
    if (in_contact) contact_wrenches_[static_cast<std::size_t>(i)] = Wrench{};
    last_good_.col(i) = world_.y.col(i);
  }
}

void SimulationLayer::accept(std::span<const Eigen::Index> bodies, Tally& tally) {
  freeze_unsound(bodies, tally);
  for (const Eigen::Index i : bodies) {
    methods_[static_cast<std::size_t>(i)] = Method::semi_implicit_euler;
    last_good_.col(i) = world_.y.col(i);
  }
}

bool SimulationLayer::is_in_flight(Eigen::Index i) const {
  return methods_[static_cast<std::size_t>(i)] == Method::flight &&
         same_column(world_.y, last_good_, i);
}

void SimulationLayer::begin_flight(Eigen::Index i, double from) {
  if (is_in_flight(i)) return;
  const auto k = static_cast<std::size_t>(i);
  flights_[k] = Flight(world_, i, from);
  turning_known_[k] = 0;
  methods_[k] = Method::flight;
  last_good_.col(i) = world_.y.col(i);
}

const RotationBound& SimulationLayer::turning(Eigen::Index i, double from) {
  const auto k = static_cast<std::size_t>(i);
  begin_flight(i, from);
  if (turning_known_[k] == 0)
    turning_[k] = rotation_bound(world_.principal_axes[k], rotation(world_, i),
                                 angular_momentum(world_.y, i));
  turning_known_[k] = 1;
  return turning_[k];
}

// The flight goes on as long as nobody else has touched the body's state.
void SimulationLayer::fly(Eigen::Index i, double from, double to, Tally& tally) {
  const auto k = static_cast<std::size_t>(i);
  if (!is_in_flight(i)) {
    begin_flight(i, from);
    tally.largest_momentum = std::max(tally.largest_momentum, angular_momentum(world_.y, i).norm());
  }
  flights_[k].evaluate(world_, i, to, world_.y);
}

void SimulationLayer::load(const Group& group, bool in_contact) const {
  for (std::size_t j = 0; j < group.columns.size(); ++j) {
    const Eigen::Index i = group.columns[j];
    gather(world_.y, i, group.work.state, static_cast<Eigen::Index>(j));
    group.work.bodies[j] = system_body(
        world_, i, in_contact ? contact_wrenches_[static_cast<std::size_t>(i)] : Wrench{});
  }
}

void SimulationLayer::integrate(const Group& group, double duration, Advance& advance,
                                Tally& tally) {
  load(group, advance.in_contact);
  const System system{group.work.bodies, group.springs, group.work.rates};
  LocalError error;
  const Method method = integration_.advance(system, group.work, advance.worker.taylor,
                                             group.memory, duration, error);
  advance.error.raise_to(error);
  tally.stiff |= group.memory.stiff;

  const SystemState& state = group.work.state;
  for (std::size_t k = 0; k < group.columns.size(); ++k) {
    const Eigen::Index i = group.columns[k], j = static_cast<Eigen::Index>(k);
    methods_[static_cast<std::size_t>(i)] = method;
    const Vec3 expected = Vec3(angular_momentum(world_.y, i)) + state.block<3, 1>(14, j);
    scatter(state, j, world_.y, i);
    if (!world_.moves(i)) {  // held in a system of others
      methods_[static_cast<std::size_t>(i)] = Method::none;
      momentum(world_.y, i).setZero();
      angular_momentum(world_.y, i).setZero();
      continue;
    }
    if (!is_sound(world_.y, i)) continue;  // it will be frozen
    const Vec3 L = angular_momentum(world_.y, i);
    advance.mismatch = std::max(advance.mismatch, (L - expected).norm());
    tally.largest_momentum = std::max(tally.largest_momentum, L.norm());
    tally.work += state(13, j);
    // However small the last terms of a series: the state itself is rounded.
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    advance.error.raise_to({kEpsilon * position(world_.y, i).norm(), 4 * kEpsilon});
  }
}

void SimulationLayer::freeze_unsound(std::span<const Eigen::Index> bodies, Tally& tally) {
  for (const Eigen::Index i : bodies) {
    if (is_sound(world_.y, i)) continue;
    world_.y.col(i) = last_good_.col(i);
    world_.freeze(i);
    contact_wrenches_[static_cast<std::size_t>(i)] = Wrench{};
    ++tally.quarantined;
  }
}

Course SimulationLayer::course(Eigen::Index i, double from, double to, bool in_contact,
                               SimulationWorker& worker) {
  const auto k = static_cast<std::size_t>(i);
  const Pose pose{position(world_.y, i), orientation(world_.y, i)};
  if (world_.is_kinematic(i)) return kinematic_course(i, to);
  if (!world_.moves(i)) return Course::still(pose, from, to);
  const bool pushed = in_contact && !is_zero(contact_wrenches_[k]);
  if (flies_free() && driven_[k] == 0 && !pushed) {
    const RotationBound& bound = turning(i, from);
    return Course::flight(world_, i, flights_[k], bound, from, to);
  }
  const DrivenBound bound = driven_bound(
      world_, i,
      in_contact ? std::span<const Wrench>(contact_wrenches_) : std::span<const Wrench>(),
      to - from);
  return Course::driven(world_, i, {this, &worker, from, in_contact}, bound.acceleration,
                        bound.slack, bound.rotation, from, to);
}

Course SimulationLayer::kinematic_course(Eigen::Index i, double to) const {
  const World::Kinematic& kinematic = world_.kinematic[static_cast<std::size_t>(i)];
  return Course::uniform(kinematic.start, kinematic.velocity, kinematic.since, to);
}

Course::Column SimulationLayer::preview(Eigen::Index i, const Course::Preview& course, double t) {
  if (t <= course.from) return world_.y.col(i);
  const auto k = static_cast<std::size_t>(i);
  SimulationWorker& worker = *course.worker;
  const bool coupled = in_system(i);
  StepMemory memory =  // left as it is
      coupled ? system_memory(world_.system_of[k]) : memories_[k];
  const Group group = coupled
                          ? system_group(world_.system_of[k], worker.systems, worker.lone, memory)
                          : Group{std::span(&i, 1), {}, worker.lone, memory};
  load(group, course.in_contact);
  const System system{group.work.bodies, group.springs, group.work.rates};
  LocalError error;
  integration_.advance(system, group.work, worker.taylor, memory, t - course.from, error);
  return world_column(group.work.state, coupled ? world_.place_of[k] : 0);
}

SimulationLayer::Backup SimulationLayer::backup(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  Backup b;
  b.y = world_.y.col(i);
  b.last_good = last_good_.col(i);
  b.method = methods_[k];
  b.motion = world_.motion[k];
  b.memory = memories_[k];
  if (in_scene_system(i))
    b.system_memory = system_memories_[static_cast<std::size_t>(world_.system_of[k])];
  if (!flies_free()) return b;
  b.flight = flights_[k];
  b.turning = turning_[k];
  b.turning_known = turning_known_[k] != 0;
  return b;
}

void SimulationLayer::restore(Eigen::Index i, const Backup& b) {
  const auto k = static_cast<std::size_t>(i);
  if (world_.motion[k] == Motion::frozen && b.motion == Motion::dynamic) world_.thaw(i);
  world_.y.col(i) = b.y;
  last_good_.col(i) = b.last_good;
  methods_[k] = b.method;
  memories_[k] = b.memory;
  contact_wrenches_[k] = Wrench{};
  if (in_scene_system(i))
    system_memories_[static_cast<std::size_t>(world_.system_of[k])] = b.system_memory;
  if (!flies_free()) return;
  flights_[k] = b.flight;
  turning_[k] = b.turning;
  turning_known_[k] = b.turning_known ? 1 : 0;
}

LocalError SimulationLayer::local_error() const {
  LocalError error = frame_error_;
  for (std::size_t k = 0; k < flights_.size(); ++k)
    if (methods_[k] == Method::flight) error.raise_to(flights_[k].error(world_, world_.time));
  return error;
}

double SimulationLayer::momentum_error() const {
  return total_.largest_momentum > 0 ? total_.mismatch / total_.largest_momentum : 0;
}

void SimulationLayer::hash_into(Hash64& hash) const {
  for (const BodyId id : world_.ids)
    if (id.generation != 1) hash.add(std::uint64_t{id.slot} << 32 | id.generation);
  for (const World::Kinematic& kinematic : world_.kinematic) {
    if (kinematic.since == 0) continue;  // it goes on from where the scene put it
    hash.add(kinematic.since);
    for (const Vec3* v :
         {&kinematic.start.c, &kinematic.velocity.linear, &kinematic.velocity.angular})
      hash.add(std::span(v->data(), 3));
    hash.add(std::span(kinematic.start.q.coeffs().data(), 4));
  }
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    hash.add(static_cast<std::uint64_t>(methods_[k]));
    if (methods_[k] != Method::flight) continue;
    Hash64 flight;  // digests of their own do not wait for one another
    flights_[k].hash_into(flight);
    hash.add(flight.value());
  }
  for (const auto* memories : {&memories_, &system_memories_})
    for (const StepMemory& memory : *memories) {
      if (memory.h == 0) continue;  // never used
      hash.add(memory.h);
      hash.add(memory.last_error);
      hash.add(static_cast<std::uint64_t>(memory.stiff_steps) * 2 + (memory.stiff ? 1 : 0));
    }
  poinsot::hash_into(hash, std::span<const Tether>(world_.tethers));
}

}  // namespace poinsot
