// The wrenches of a scene as commands: held like those of clients, with the same rounding to
// frames, under a client's number that no client on the bus can have.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/protocol/wrench_command.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

inline constexpr std::uint64_t kSceneClient = 0;

// In the order of the scene, seq from 1; the scene must be valid. A start is rounded up to frames:
// the first frame of effect is the first that begins at it or later.
std::vector<WrenchCommand> scene_wrenches(const Scene& scene, const World& world);

}  // namespace poinsot
