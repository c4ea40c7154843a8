// What a client asks of the run as a whole. Answered by a Reply with the same (client, seq).

#pragma once

#include <array>
#include <cstdint>

#include "poinsot/base/names.h"

namespace poinsot {

enum class ControlAction : std::uint8_t {
  pause = 0,
  resume = 1,
  step = 2,   // `frames` frames, then stay paused; answered when they are done
  reset = 3,  // state and time of the scene file, next epoch; paused stays paused
};

inline constexpr std::array<Named<ControlAction>, 4> kControlActionNames = {{
    {"pause", ControlAction::pause},
    {"resume", ControlAction::resume},
    {"step", ControlAction::step},
    {"reset", ControlAction::reset},
}};

struct RunControl {
  std::uint64_t client = 0;
  std::uint64_t seq = 0;
  std::uint32_t epoch = 0;  // 0: whichever runs
  ControlAction action = ControlAction::pause;
  std::uint64_t frames = 1;  // for step
};

inline constexpr std::uint64_t kMaxStepFrames = 1'000'000'000;

// Numbers of ROS 2 simulation_interfaces (SimulationState.msg).
enum class RunState : std::uint8_t { stopped = 0, playing = 1, paused = 2, quitting = 3 };

inline constexpr std::array<Named<RunState>, 4> kRunStateNames = {{
    {"stopped", RunState::stopped},
    {"playing", RunState::playing},
    {"paused", RunState::paused},
    {"quitting", RunState::quitting},
}};

}  // namespace poinsot
