#include "poinsot/simulation/simulation_layer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

// A coordinate beyond this is no physics any more; its square is still finite.
constexpr double kLargest = 1e100;
// The series stop at rounding; a pair that stands in for them is kept close to it.
constexpr double kRounding = 1e-14, kStandIn = 1e-12, kDefaultTolerance = 1e-8;
// An implicit method of order 4 would need a thousand steps a frame for more.
constexpr double kImplicit = 1e-9;
constexpr int kMostSeries = 64, kMostSteps = 20000;  // per advance
// An estimate of the error of fixed steps costs three of them: it is taken now and then.
constexpr std::uint32_t kEstimateEvery = 16;

// False for NaN as well, and for a quaternion that overflowed while it was made unit.
bool is_sound(const StateArray& y, Eigen::Index i) {
  return (y.col(i).array().abs() < kLargest).all() && orientation(y, i).squaredNorm() > 0.5;
}

bool is_finite(const HeldWrench& w) {
  return w.in_W.force.allFinite() && w.in_W.torque.allFinite() && w.in_B.force.allFinite() &&
         w.in_B.torque.allFinite() && w.moment.allFinite();
}

bool is_zero(const Wrench& w) {
  return w.force.isZero(0) && w.torque.isZero(0);
}

bool same_column(const StateArray& a, const StateArray& b, Eigen::Index i) {
  return std::memcmp(a.col(i).data(), b.col(i).data(), 13 * sizeof(double)) == 0;
}

double tolerance_of(const SimulationDef& def) {
  if (def.tolerance > 0) return def.tolerance;
  const bool series =
      def.integrator == IntegratorKind::exact || def.integrator == IntegratorKind::taylor;
  return series ? kRounding : kDefaultTolerance;
}

}  // namespace

SimulationLayer::SimulationLayer(const Scene& scene)
    : world_(scene),
      kind_(scene.simulation.integrator),
      longest_step_(scene.simulation.step > 0 ? scene.simulation.step
                                              : scene.collision.contact_step),
      tolerance_(tolerance_of(scene.simulation)),
      contact_wrenches_(static_cast<std::size_t>(world_.size())),
      last_good_(world_.y),
      methods_(static_cast<std::size_t>(world_.size()), Method::none),
      driven_(methods_.size(), 0),
      memories_(methods_.size()),
      system_memories_(world_.systems.size()),
      lone_(1) {
  if (kind_ == IntegratorKind::exact) flights_.resize(methods_.size());
  std::size_t bodies = 1, springs = 0;
  for (const BodySystem& system : world_.systems) {
    systems_.emplace_back(system.columns.size());
    bodies = std::max(bodies, system.columns.size());
    springs = std::max(springs, system.springs.size());
  }
  taylor_.prepare(bodies, springs);
}

SimulationLayer::Workspace::Workspace(std::size_t n)
    : state(17, static_cast<Eigen::Index>(n)), bodies(n), rates(n) {
  embedded.prepare(state.cols());
  fixed.prepare(state.cols());
}

void SimulationLayer::advance_to(double t_end) {
  check(t_end);
  const double duration = t_end - world_.time;
  advance_error_ = {};
  advance_mismatch_ = 0;
  if (estimates_steps()) step_error_ = {};
  for (Eigen::Index i = 0; i < world_.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!world_.moves(i)) {
      methods_[k] = Method::none;
    } else if (world_.systems.empty() || world_.system_of[k] == World::kLone) {
      if (kind_ == IntegratorKind::exact && driven_[k] == 0)
        fly(i, t_end);
      else
        integrate({std::span(&i, 1), {}, lone_, memories_[k]}, duration);
    }
  }
  for (std::size_t s = 0; s < world_.systems.size(); ++s)
    integrate(
        {world_.systems[s].columns, world_.systems[s].springs, systems_[s], system_memories_[s]},
        duration);
  forced_error_ += advance_error_;
  momentum_mismatch_ += advance_mismatch_;
  ++advances_;
  freeze_unsound();
  if (in_contact_) std::fill(contact_wrenches_.begin(), contact_wrenches_.end(), Wrench{});
  in_contact_ = false;
  last_good_ = world_.y;
  world_.time = t_end;
}

bool SimulationLayer::estimates_steps() const {
  return !is_adaptive(kind_) && advances_ % kEstimateEvery == 0;
}

void SimulationLayer::check(double t_end) {
  if (!std::isfinite(t_end)) throw Error("advance_to: the time must be finite");
  if (t_end < world_.time)
    throw Error("advance_to: time runs backwards: it is " + std::to_string(world_.time) +
                " s, asked for " + std::to_string(t_end) + " s");
  constexpr double kMostFixedSteps = 1e9;  // more would not end, and not fit a count
  if (!is_adaptive(kind_) && t_end - world_.time > kMostFixedSteps * longest_step_)
    throw Error("advance_to: " + std::to_string(t_end - world_.time) +
                " s would take more than 1e9 steps of " + std::to_string(longest_step_) + " s");
  for (std::size_t k = 0; k < driven_.size(); ++k) {
    driven_[k] = is_driven(static_cast<Eigen::Index>(k)) ? 1 : 0;
    if (driven_[k] != 0 && !is_finite(world_.held[k]))
      throw Error("body '" + world_.names[k] + "': the held wrench is not finite");
  }
}

// Whether anything but gravity acts on a body without springs.
bool SimulationLayer::is_driven(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  if (!world_.held[k].is_zero()) return true;
  if (in_contact_ && !is_zero(contact_wrenches_[k])) return true;
  if (world_.drag.empty()) return false;
  const DragDef& drag = world_.drag[k];
  return drag.linear > 0 || drag.quadratic > 0 || drag.angular > 0;
}

// The flight goes on as long as nobody else has touched the body's state.
void SimulationLayer::fly(Eigen::Index i, double t_end) {
  const auto k = static_cast<std::size_t>(i);
  if (methods_[k] != Method::flight || !same_column(world_.y, last_good_, i)) {
    flights_[k] = Flight(world_, i);
    methods_[k] = Method::flight;
    largest_momentum_ = std::max(largest_momentum_, angular_momentum(world_.y, i).norm());
  }
  flights_[k].evaluate(world_, i, t_end, world_.y);
}

void SimulationLayer::load(const Group& group) const {
  for (std::size_t j = 0; j < group.columns.size(); ++j)
    gather(world_.y, group.columns[j], group.work.state, static_cast<Eigen::Index>(j));
}

void SimulationLayer::integrate(const Group& group, double duration) {
  const std::size_t n = group.columns.size();
  for (std::size_t j = 0; j < n; ++j) {
    const Eigen::Index i = group.columns[j];
    group.work.bodies[j] = system_body(
        world_, i, in_contact_ ? contact_wrenches_[static_cast<std::size_t>(i)] : Wrench{});
  }
  const System system{group.work.bodies, group.springs, group.work.rates};
  load(group);
  const LocalError others = advance_error_;
  advance_error_ = {};
  const Method method = integrate_state(group, system, duration);
  advance_error_.raise_to(others);

  const SystemState& state = group.work.state;
  for (std::size_t k = 0; k < n; ++k) {
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
    advance_mismatch_ = std::max(advance_mismatch_, (L - expected).norm());
    largest_momentum_ = std::max(largest_momentum_, L.norm());
    work_ += state(13, j);
    // However small the last terms of a series: the state itself is rounded.
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    advance_error_.raise_to({kEpsilon * position(world_.y, i).norm(), 4 * kEpsilon});
  }
}

Method SimulationLayer::integrate_state(const Group& group, const System& system, double duration) {
  SystemState& state = group.work.state;
  switch (kind_) {
    case IntegratorKind::exact:
    case IntegratorKind::taylor:
      if (!group.memory.stiff &&
          taylor_.advance(system, state, duration, tolerance_, kMostSeries, advance_error_))
        return Method::taylor;
      load(group);
      advance_error_ = {};
      return by_tolerance(kDop853, Method::dop853, std::max(tolerance_, kStandIn), group, system,
                          duration);
    case IntegratorKind::dop853:
      return by_tolerance(kDop853, Method::dop853, tolerance_, group, system, duration);
    case IntegratorKind::dopri5:
      return by_tolerance(kDopri5, Method::dopri5, tolerance_, group, system, duration);
    default:
      return by_fixed_steps(group, system, duration);
  }
}

Method SimulationLayer::by_tolerance(const EmbeddedPair& pair, Method method, double tolerance,
                                     const Group& group, const System& system, double duration) {
  SystemState& state = group.work.state;
  double done = 0;
  if (!group.memory.stiff &&
      group.work.embedded.advance(pair, system, state, duration, tolerance, kMostSteps,
                                  group.memory, advance_error_, done))
    return method;
  group.memory.stiff = stiff_ = true;
  group.work.rosenbrock.prepare(system.size());
  if (group.work.rosenbrock.advance(system, state, duration, std::max(tolerance, kImplicit),
                                    kMostSteps, group.memory, advance_error_, done))
    return Method::rosenbrock;
  advance_error_ = {};
  // Nothing can follow this motion: the body is frozen where it was.
  state.setConstant(std::numeric_limits<double>::quiet_NaN());
  return method;
}

Method SimulationLayer::by_fixed_steps(const Group& group, const System& system, double duration) {
  SystemState& state = group.work.state;
  const int steps = step_count(duration, longest_step_);
  const double h = duration / steps;
  if (estimates_steps()) step_error_.raise_to(group.work.fixed.compare(kind_, system, state, h));
  advance_error_ = {steps * step_error_.position, steps * step_error_.orientation};
  for (int s = 0; s < steps; ++s) group.work.fixed.step(kind_, system, state, h);
  switch (kind_) {
    case IntegratorKind::semi_implicit_euler:
      return Method::semi_implicit_euler;
    case IntegratorKind::explicit_euler:
      return Method::explicit_euler;
    default:
      return Method::rk4;
  }
}

void SimulationLayer::freeze_unsound() {
  for (Eigen::Index i = 0; i < world_.size(); ++i) {
    if (is_sound(world_.y, i)) continue;
    world_.y.col(i) = last_good_.col(i);
    world_.freeze(i);
    contact_wrenches_[static_cast<std::size_t>(i)] = Wrench{};
    ++quarantined_;
  }
}

LocalError SimulationLayer::local_error() const {
  LocalError error = forced_error_;
  for (std::size_t k = 0; k < flights_.size(); ++k)
    if (methods_[k] == Method::flight) error.raise_to(flights_[k].error(world_, world_.time));
  return error;
}

double SimulationLayer::momentum_error() const {
  return largest_momentum_ > 0 ? momentum_mismatch_ / largest_momentum_ : 0;
}

void SimulationLayer::hash_into(Hash64& hash) const {
  for (std::size_t k = 0; k < methods_.size(); ++k) {
    hash.add(static_cast<std::uint64_t>(methods_[k]));
    if (methods_[k] == Method::flight) flights_[k].hash_into(hash);
  }
  for (const auto* memories : {&memories_, &system_memories_})
    for (const StepMemory& memory : *memories) {
      if (memory.h == 0) continue;  // never used
      hash.add(memory.h);
      hash.add(memory.last_error);
      hash.add(static_cast<std::uint64_t>(memory.stiff_steps) * 2 + (memory.stiff ? 1 : 0));
    }
}

}  // namespace poinsot
