// The collision layer: a frame in which nothing can meet is left to the simulation layer as a
// whole; otherwise equal sub-steps, and inside each contacts are found and resolved and the
// simulation layer integrates.

#pragma once

#include <cstdint>
#include <memory>

#include "poinsot/base/hash.h"
#include "poinsot/base/stopwatch.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

// What the layer knows of the last sub-step, and sums since the start.
struct CollisionReport {
  std::uint32_t contacts = 0;  // points with a pushing impulse
  double max_penetration = 0;  // [m] in the last sub-step, after push-out
  double impact_loss = 0;      // [J] kinetic energy taken out by impacts so far
  double push_out_energy = 0;  // [J] added by the removal of penetration so far
};

struct EnergyBalance {
  double energy;  // [J] kinetic and potential
  double error;   // [-] relative, since the start
};

struct CollisionTimes {
  Elapsed collision;   // finding contacts
  Elapsed contact;     // resolving them
  Elapsed simulation;  // integrating
};

class CollisionLayer {
 public:
  explicit CollisionLayer(const Scene& scene);
  ~CollisionLayer();
  CollisionLayer(CollisionLayer&&) noexcept;
  CollisionLayer& operator=(CollisionLayer&&) noexcept;

  // Afterwards time() == t_end exactly.
  void advance_to(double t_end);

  double time() const { return simulation_.world().time; }
  World& world() { return simulation_.world(); }
  const World& world() const { return simulation_.world(); }
  const SimulationLayer& simulation() const { return simulation_; }
  const CollisionReport& report() const { return report_; }

  // Energy [J], and the relative energy error since the start [-]: what the energy changed by
  // beyond the work of held wrenches, the work and loss at contacts and the push-out, over the
  // energy scale.
  EnergyBalance energy_balance();
  double energy() const;
  double energy_error() { return energy_balance().error; }

  // Adds what a continuation depends on besides the world.
  void hash_into(Hash64& hash) const;

  // Time spent so far. CPU time is read once per frame and shared out as wall time is.
  const CollisionTimes& times() const { return times_; }

 private:
  bool may_meet(double h);
  void advance_apart(double t_end);
  void advance_substep(double t_end);
  void integrate(double t_end);
  void rebase_energy();
  double expected_energy() const;  // [J] from the start, the work and the losses

  struct Contacts;  // the set and its resolution; keeps geometry out of the layers above
  SimulationLayer simulation_;
  std::unique_ptr<Contacts> contacts_;
  double longest_step_;  // [s]
  CollisionReport report_;
  EnergyScale energy_scale_;
  double start_energy_;  // [J]
  std::uint32_t quarantined_ = 0;
  CollisionTimes times_;
};

// Pairs of bodies that overlap by more than the scene's tolerance, as faults that name both and the
// depth.
std::vector<SceneFault> find_overlaps(const Scene& scene);

}  // namespace poinsot
