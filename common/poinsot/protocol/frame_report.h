// How a run goes: the report topic, several times a second and after each control.

#pragma once

#include <array>
#include <cstdint>
#include <string>
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
  input_late = 32,       // a frame began without the input of a client in lock step
  record_failed = 64,    // the log of the run could not be written; it ended
  rate_limited = 128,    // a client sent more than it may
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

// Of some values, the median, the 99th percentile and the largest.
struct Spread {
  double p50 = 0, p99 = 0, max = 0;
};

// What one client did.
struct ClientStatus {
  std::uint64_t client = 0;
  bool alive = true;                        // its writer is there
  bool lock_step = false;                   // its input is waited for
  std::uint32_t held = 0;                   // wrenches that it holds
  std::uint64_t accepted = 0, refused = 0;  // commands and controls
  std::uint64_t limited = 0;                // of the refused, for being too many
};

// The report topic: the frame's report and what the service knows of its pace.
struct RunReport {
  std::uint64_t session = 0;
  std::uint32_t epoch = 0;
  RunState state = RunState::stopped;
  FrameReport frame;
  double frame_rate = 60;  // [Hz]
  double time_scale = 1;   // asked for: simulated / wall time; 0: as fast as it can
  // Simulated / wall time; 0 while paused. Over the last 150 ms or a little more …
  double real_time_factor = 0;
  // … and since the run last began to play or was asked for another scale, at most 10 s.
  double real_time_factor_window = 0;
  // Of the last 1024 frames that were waited for: how late the loop woke after the frame was due
  // [s], and how long the work of a frame took [s].
  Spread lateness, frame_time;
  std::uint32_t scene_bodies = 0;  // of all kinds, and the revision that has so many
  std::uint32_t scene_revision = 1;
  std::vector<Method> body_methods;  // per dynamic body, in the order of the scene
  std::uint64_t state_hash = 0;
  std::uint64_t overruns = 0;  // frames that missed their deadline
  std::uint64_t commands_accepted = 0;
  std::uint64_t commands_refused = 0;      // by the loop or the receiver
  std::uint64_t commands_limited = 0;      // of the refused, for being too many
  std::uint32_t held_wrenches = 0;         // by the scene and all clients
  std::uint32_t checkpoints = 0;           // in memory
  std::uint64_t late_inputs = 0;           // frames that began without an input waited for
  std::uint32_t streams = 0;               // filtered streams of poses that somebody reads
  std::string recording = {};              // name of the log that is written; empty: none
  std::vector<ClientStatus> clients = {};  // those alive or holding something, by number
  std::uint64_t snapshots_dropped = 0;     // by the hand-over to the bus
  std::uint64_t events_dropped = 0;        // impacts, likewise
  LayerTimes times;
};

}  // namespace poinsot
