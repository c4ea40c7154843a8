// The scene topic's content: one description per body, in the order of the scene file.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

std::vector<BodyInfo> body_infos(const Scene& scene, const World& world, std::uint64_t session);

}  // namespace poinsot
