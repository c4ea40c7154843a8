// The part of validate() that speaks of springs and wrenches. Private to this module.

#pragma once

#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

std::vector<SceneFault> validate_forces(const Scene& scene);

}  // namespace poinsot
