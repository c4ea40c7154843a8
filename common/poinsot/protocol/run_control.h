// What a client asks of the run as a whole, or of what is in it. Answered by a Reply with the same
// (client, seq).

#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "poinsot/base/body_id.h"
#include "poinsot/base/names.h"
#include "poinsot/math/types.h"

namespace poinsot {

enum class ControlAction : std::uint8_t {
  pause = 0,
  resume = 1,
  step = 2,        // `frames` frames, then stay paused; answered when they are done
  reset = 3,       // to what `scope` says, in the next epoch; paused stays paused
  run_until = 4,   // paced, until the first frame at or after `time`, then pause; answered then
  scale = 5,       // simulated per wall time from now on: `value`; 0: as fast as it can
  lock_step = 6,   // this client's input is waited for before every frame, `timeout_ns` at most; 0:
                   // no longer
  advance = 7,     // of a client in lock step: its input for the next frame is complete
  spawn = 8,       // the bodies of the scene fragment `text`
  remove = 9,      // a body
  set_state = 10,  // pose and velocity of a body, at once
  save = 11,       // a checkpoint `name`
  restore = 12,    // the checkpoint `name`, in the next epoch; paused stays paused
  record = 13,     // writes a log of the run from here on, `name`; empty: ends it
  shutdown = 14,   // the daemon ends
  release = 15,    // ends what this client holds and what does not outlive it, lock step included
};

inline constexpr std::array<Named<ControlAction>, 16> kControlActionNames = {{
    {"pause", ControlAction::pause},
    {"resume", ControlAction::resume},
    {"step", ControlAction::step},
    {"reset", ControlAction::reset},
    {"run_until", ControlAction::run_until},
    {"scale", ControlAction::scale},
    {"lock_step", ControlAction::lock_step},
    {"advance", ControlAction::advance},
    {"spawn", ControlAction::spawn},
    {"remove", ControlAction::remove},
    {"set", ControlAction::set_state},
    {"save", ControlAction::save},
    {"restore", ControlAction::restore},
    {"record", ControlAction::record},
    {"shutdown", ControlAction::shutdown},
    {"release", ControlAction::release},
}};

// What a reset takes back: bits, with the numbers of ROS 2 simulation_interfaces.
enum class ResetScope : std::uint8_t {
  all = 0,      // everything: the state of a fresh start, with its hashes
  time = 1,     // the frame is 0 again; bodies stay as they are
  state = 2,    // the bodies of the scene file are where, and as fast, as it says
  spawned = 4,  // bodies that were spawned are gone
};
constexpr bool has_scope(std::uint8_t set, ResetScope scope) {
  return set == 0 || (set & static_cast<std::uint8_t>(scope)) != 0;
}
inline constexpr std::uint8_t kMaxResetScope = 7;

// A checkpoint or log may be called by a word of letters, digits, '_', '-' and '.', not beginning
// with '.'; at most this long.
inline constexpr std::size_t kMaxStoreName = 64;
inline constexpr std::size_t kMaxFragment = 65535;  // bytes of a scene fragment

struct RunControl {
  std::uint64_t client = 0;
  std::uint64_t seq = 0;
  std::uint32_t epoch = 0;  // 0: whichever runs
  ControlAction action = ControlAction::pause;
  std::uint64_t frames = 1;     // for step
  std::uint8_t scope = 0;       // for reset: ResetScope bits; 0: all
  double value = 0;             // of run_until [s], of scale [-]
  std::int64_t timeout_ns = 0;  // [ns] wall time, for lock_step
  std::string name = {};        // of a checkpoint or a log; empty: one is found
  bool on_disk = false;         // for save: answered when it is written to the daemon's disk
  std::string text = {};        // for spawn: YAML with `bodies:`, as in a scene file; no files

  // For remove and set_state.
  BodyId body = {};            // none: by name
  std::string body_name = {};  // used when `body` is none
  // For set_state: what is not set stays.
  bool sets_position = false, sets_orientation = false, sets_linear = false, sets_angular = false;
  Vec3 position = Vec3::Zero();          // [m] of B's origin, in W
  Quat orientation = Quat::Identity();   // B → W
  Vec3 linear_velocity = Vec3::Zero();   // [m/s] of the centre of mass, in W
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] in W
};

inline constexpr std::uint64_t kMaxStepFrames = 1'000'000'000;
inline constexpr double kMaxTimeScale = 1e6;                       // [-]
inline constexpr double kMaxRunTime = 1e9;                         // [s]
inline constexpr std::int64_t kMaxLockStepNs = 3'600'000'000'000;  // [ns]

// Numbers of ROS 2 simulation_interfaces (SimulationState.msg).
enum class RunState : std::uint8_t { stopped = 0, playing = 1, paused = 2, quitting = 3 };

inline constexpr std::array<Named<RunState>, 4> kRunStateNames = {{
    {"stopped", RunState::stopped},
    {"playing", RunState::playing},
    {"paused", RunState::paused},
    {"quitting", RunState::quitting},
}};

}  // namespace poinsot
