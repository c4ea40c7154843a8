// How a run goes: the report topic, several times a second and after each control.

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/scene/strategies.h"

namespace poinsot {

// Trouble in a frame, as data: a set of flags.
enum class FrameFlag : std::uint32_t {
  none = 0,
  body_quarantined = 1,  // a body's state became non-finite; it is frozen at its last good pose
  inbox_full = 2,        // a command was refused since the last report
  overrun = 4,           // a deadline was missed since the last report
  stiff = 8,             // springs were too stiff for the integrator: rosenbrock took over
  crowded = 16,          // more impacts in an island than it pays to locate
};

constexpr FrameFlag operator|(FrameFlag a, FrameFlag b) {
  return static_cast<FrameFlag>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr bool has_flag(FrameFlag set, FrameFlag flag) {
  return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(flag)) != 0;
}

// What the physics knows of one frame.
struct FrameReport {
  std::uint64_t frame = 0;
  double sim_time = 0;            // [s]
  std::uint32_t bodies = 0;       // dynamic
  std::uint32_t contacts = 0;     // points with a pushing impulse in the last sub-step
  std::uint32_t quarantined = 0;  // bodies frozen so far
  std::uint32_t islands = 0;      // groups of bodies that might meet, gone through in this frame
  std::uint32_t restarts = 0;     // times that islands were gone through again, merged
  std::uint32_t impact_searches = 0;
  std::uint32_t impacts = 0;            // located in this frame
  std::uint64_t impacts_so_far = 0;     // since the epoch began
  std::uint32_t asleep = 0;             // bodies in proven equilibrium
  std::uint32_t soft_bodies = 0;        // in contacts stepped by soft_step
  std::uint32_t direct_bodies = 0;      // in contacts solved by convex_newton
  std::uint32_t solver_iterations = 0;  // of convex_newton
  std::uint32_t unconverged = 0;        // solves of it that did not reach its tolerance
  double contact_residual = 0;          // [m/s] the worst of both solvers
  double energy = 0;                    // [J] kinetic + potential
  double energy_error = 0;  // [-] (ΔE − work + contact loss) / energy scale, since the epoch began
  double push_out_energy = 0;  // [J] added by the removal of penetration
  double max_penetration = 0;  // [m]
  // Local error of this frame, the largest of all bodies: a bound for flights, an estimate else.
  double position_error = 0;     // [m]
  double orientation_error = 0;  // [rad]
  // Sum over the frames of the epoch of the largest |ΔL − ∫τ| of a body, over the largest |L| seen.
  double momentum_error = 0;                                    // [-]
  std::array<std::uint32_t, kMethodNames.size()> methods = {};  // bodies moved by each Method
  FrameFlag flags = FrameFlag::none;
};

// Cumulated time per layer, each without the layers beneath it.
struct LayerTimes {
  Elapsed presentation;
  Elapsed collision;
  Elapsed contact;
  Elapsed simulation;
  Elapsed publishing;  // the publisher's thread
};

// The report topic: the frame's report and what the service knows of its pace.
struct RunReport {
  std::uint64_t session = 0;
  std::uint32_t epoch = 0;
  RunState state = RunState::stopped;
  FrameReport frame;
  double frame_rate = 60;            // [Hz]
  double real_time_factor = 0;       // simulated / wall time over 150 ms or more; 0 while paused
  std::vector<Method> body_methods;  // per dynamic body, in the order of the scene
  std::uint64_t state_hash = 0;
  std::uint64_t overruns = 0;  // frames that missed their deadline
  std::uint64_t commands_accepted = 0;
  std::uint64_t commands_refused = 0;   // by the loop or the receiver
  std::uint64_t snapshots_dropped = 0;  // by the hand-over to the bus
  std::uint64_t events_dropped = 0;     // impacts, likewise
  LayerTimes times;
};

}  // namespace poinsot
