// What a run says when it ends.

#pragma once

#include <cstdint>
#include <string>

#include "poinsot/presentation/presentation_layer.h"

namespace poinsot {

struct RunSummary {
  std::uint64_t frames = 0;  // advanced, over all epochs
  double sim_time = 0;       // [s] that these frames took in the scene
  double wall_s = 0;         // [s] from the first frame to the last
  LayerTimes times;
  FrameReport last;              // of the last frame; its balances are those of the last epoch
  std::uint64_t state_hash = 0;  // of the last frame
};

// `frames`, `wall_s` and the publisher's time are the caller's.
RunSummary summarize(const PresentationLayer& layer, std::uint64_t frames, double wall_s,
                     const Elapsed& publishing);

// A few aligned lines for people.
std::string to_text(const RunSummary& summary);

// One line, one object: frames, sim_time [s], wall_s, cpu_s {presentation, collision, contact,
// simulation, publishing}, bodies, energy_error, momentum_error, position_error [m],
// orientation_error [rad], impacts (of the last epoch), islands, restarts, impact_searches, asleep,
// crowded, soft_bodies, direct_bodies, solver_iterations, unconverged, contact_residual [m/s],
// max_penetration [m] (of the last frame), methods {name: bodies}, state_hash (16 hexadecimal
// digits).
std::string to_json(const RunSummary& summary);

}  // namespace poinsot
