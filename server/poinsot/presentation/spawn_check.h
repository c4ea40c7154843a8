// May these bodies come into the scene as it is now?

#pragma once

#include <optional>
#include <vector>

#include "poinsot/presentation/value_check.h"
#include "poinsot/scene/scene.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

// Their names must be nobody else's, and there must be room for them. The bodies are each valid in
// themselves.
std::optional<Refusal> check_names(const std::vector<BodyDef>& bodies, std::size_t bodies_there,
                                   const World& world);

// As in a scene file, they must not overlap others, or each other, by more than the scene's
// tolerance, unless the scene allows it. Bodies with meshes are not looked at: to prepare a mesh
// for that takes longer than a frame.
std::optional<Refusal> check_overlaps(const std::vector<BodyDef>& bodies, const Scene& scene,
                                      const World& world);

}  // namespace poinsot
