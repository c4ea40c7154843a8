// The part of validate() that speaks of pairs of bodies. Private to this module.

#pragma once

#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

std::vector<SceneFault> validate_pairs(const Scene& scene);

}  // namespace poinsot
