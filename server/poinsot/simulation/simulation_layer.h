// The simulation layer: integrates the Newton–Euler equations from now to a given time under
// gravity, held wrenches and the contact wrenches of this sub-step. It does not know that shapes
// exist.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/simulation/integrator.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

class SimulationLayer {
 public:
  explicit SimulationLayer(const Scene& scene);

  // Afterwards world().time == t_end exactly. Columns that become non-finite are restored and
  // frozen. Contact wrenches act until t_end and are zero afterwards.
  void advance_to(double t_end);

  World& world() { return world_; }
  const World& world() const { return world_; }

  // Wrench about c, in W, that contacts exert on each body until the next advance_to ends.
  std::span<Wrench> contact_wrenches() { return contact_wrenches_; }

  // Bodies frozen so far.
  std::uint32_t quarantined() const { return quarantined_; }
  // Work done by held wrenches since the start [J], and by contact wrenches.
  double held_work() const { return held_work_; }
  double contact_work() const { return contact_work_; }
  const Elapsed& elapsed() const { return elapsed_; }

 private:
  void restore_non_finite();

  World world_;
  Integrator integrator_;
  double longest_step_;  // [s]
  std::vector<Wrench> contact_wrenches_;
  StateArray before_;  // 13×n at the start of the advance
  double held_work_ = 0;
  double contact_work_ = 0;
  std::uint32_t quarantined_ = 0;
  Elapsed elapsed_;
};

}  // namespace poinsot
