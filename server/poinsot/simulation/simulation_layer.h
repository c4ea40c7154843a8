// The simulation layer: moves the bodies from now to a given time under gravity, held wrenches,
// drag, springs and the contact wrenches of this sub-step. It does not know that shapes exist.
//
// Each body is moved by what it needs. With integrator `exact`: not at all if it does not move, by
// its closed form while it flies (flight.h), by Taylor series while something acts on it
// (taylor.h), by DOP853 where the series does not exist, implicitly where springs are stiff
// (rosenbrock.h). The other integrators move every body.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/simulation/fixed_step.h"
#include "poinsot/simulation/flight.h"
#include "poinsot/simulation/rosenbrock.h"
#include "poinsot/simulation/taylor.h"

namespace poinsot {

class SimulationLayer {
 public:
  explicit SimulationLayer(const Scene& scene);

  // Afterwards world().time == t_end exactly. Contact wrenches act until t_end and are zero
  // afterwards. A body whose state became non-finite is put back to where the last advance left it
  // and frozen there. Throws Error if t_end is not finite, lies in the past or more than 1e9 fixed
  // steps ahead, or if a held wrench is not finite: before anything has moved.
  void advance_to(double t_end);

  // Puts bodies whose state is not finite, or absurd, back to where the last advance left them, and
  // freezes them there. advance_to ends with it; callers that changed the state call it before they
  // ask anything about it.
  void freeze_unsound();

  World& world() { return world_; }
  const World& world() const { return world_; }

  // Wrench about c, in W, that contacts exert on each body until the next advance_to ends.
  std::span<Wrench> contact_wrenches() {
    in_contact_ = true;
    return contact_wrenches_;
  }

  std::uint32_t quarantined() const { return quarantined_; }  // bodies frozen so far
  double work() const { return work_; }  // [J] of held and contact wrenches, drag and damping

  // What moved each body in the last advance, in column order.
  std::span<const Method> methods() const { return methods_; }
  bool is_stiff() const { return stiff_; }  // a system is integrated implicitly

  // Errors since the last start_frame(), the largest of all bodies.
  void start_frame() { forced_error_ = {}; }
  LocalError local_error() const;
  // Sum over the advances of the largest |ΔL − ∫τ| of a body, over the largest |L| seen [-].
  double momentum_error() const;

  // Adds what a continuation depends on besides the world: where flights began, and step sizes.
  void hash_into(Hash64& hash) const;

 private:
  // What integrating one set of bodies takes; those without springs share one.
  struct Workspace {
    explicit Workspace(std::size_t bodies);

    SystemState state;  // 17×n
    std::vector<SystemBody> bodies;
    std::vector<BodyRates> rates;
    EmbeddedRungeKutta embedded;
    FixedStep fixed;
    Rosenbrock rosenbrock;  // prepared when it is first needed
  };
  // Bodies to be integrated together, and what they keep between advances.
  struct Group {
    std::span<const Eigen::Index> columns;
    std::span<const SpringLink> springs;
    Workspace& work;
    StepMemory& memory;
  };

  void check(double t_end);
  bool estimates_steps() const;
  bool is_driven(Eigen::Index i) const;
  void fly(Eigen::Index i, double t_end);
  void integrate(const Group& group, double duration);
  Method integrate_state(const Group& group, const System& system, double duration);
  Method by_tolerance(const EmbeddedPair& pair, Method method, double tolerance, const Group& group,
                      const System& system, double duration);
  Method by_fixed_steps(const Group& group, const System& system, double duration);
  void load(const Group& group) const;

  World world_;
  IntegratorKind kind_;
  double longest_step_;  // [s]
  double tolerance_;     // of the series, or of the pair
  std::vector<Wrench> contact_wrenches_;
  bool in_contact_ = false;  // they were asked for since the last advance
  StateArray last_good_;     // 13×n, at the end of the last advance
  std::uint32_t quarantined_ = 0;

  std::vector<Method> methods_;
  std::vector<std::uint8_t> driven_;  // in this advance: something but gravity acts
  std::vector<Flight> flights_;       // of bodies whose method is flight
  std::vector<StepMemory> memories_;  // per body, for the embedded pairs
  std::vector<StepMemory> system_memories_;
  TaylorSeries taylor_;
  Workspace lone_;
  std::vector<Workspace> systems_;

  double work_ = 0;
  LocalError forced_error_, advance_error_;
  LocalError step_error_;  // of one fixed step, when it was last estimated
  double momentum_mismatch_ = 0, advance_mismatch_ = 0, largest_momentum_ = 0;  // [kg·m²/s]
  std::uint32_t advances_ = 0;
  bool stiff_ = false;
};

}  // namespace poinsot
