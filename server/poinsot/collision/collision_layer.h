// The collision layer: inside a frame, sub-steps; inside each, contacts are found and resolved and
// the simulation layer integrates.

#pragma once

#include <cstdint>
#include <memory>

#include "poinsot/base/hash.h"
#include "poinsot/base/stopwatch.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

// What the layer knows of the last sub-step, and sums since the start.
struct CollisionReport {
  std::uint32_t contacts = 0;    // points with a pushing impulse
  double max_penetration = 0;    // [m] at the start of the last sub-step
  double contact_loss = 0;       // [J] taken out by contacts so far
  double push_out_energy = 0;    // [J] added by the removal of penetration so far
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
  // Energy [J] and relative energy error since the start, as README.md section "Energy" defines it.
  double energy() const;
  double energy_error() const;

  // Adds what a continuation depends on besides the world: warm-start impulses.
  void hash_into(Hash64& hash) const;

  const Elapsed& collision_elapsed() const;
  const Elapsed& contact_elapsed() const;

 private:
  struct Impl;  // contacts, pairs, solver; keeps collision headers out of the layers above
  SimulationLayer simulation_;
  CollisionReport report_;
  std::unique_ptr<Impl> impl_;
};

// Pairs of bodies that overlap in the scene, as faults that name both and the depth.
std::vector<SceneFault> find_overlaps(const Scene& scene);

}  // namespace poinsot
