// The simulation layer: integrates the Newton–Euler equations from now to a given time under
// gravity, held wrenches and the contact wrenches of this sub-step. It does not know that shapes
// exist.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/simulation/integrator.h"
#include "poinsot/simulation/work_meter.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

class SimulationLayer {
 public:
  explicit SimulationLayer(const Scene& scene);

  // Afterwards world().time == t_end exactly. Contact wrenches act until t_end and are zero
  // afterwards. A body whose state became non-finite is put back to where the last advance left it
  // and frozen there.
  void advance_to(double t_end);

  // Puts bodies whose state is not finite, or absurd, back to where the last advance left them, and
  // freezes them there. advance_to ends with it; callers that changed the state call it before they
  // ask anything about it.
  void freeze_unsound();

  World& world() { return world_; }
  const World& world() const { return world_; }

  // Wrench about c, in W, that contacts exert on each body until the next advance_to ends.
  std::span<Wrench> contact_wrenches() { return contact_wrenches_; }

  std::uint32_t quarantined() const { return quarantined_; }  // bodies frozen so far
  const WorkMeter& work() const { return work_; }

 private:
  World world_;
  Integrator integrator_;
  double longest_step_;  // [s]
  std::vector<Wrench> contact_wrenches_;
  StateArray last_good_;  // 13×n, at the end of the last advance
  WorkMeter work_;
  std::uint32_t quarantined_ = 0;
};

}  // namespace poinsot
