// The fingerprint of all that the frames to come depend on: the state, what is held, contacts,
// flights. Equal runs have equal hashes.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/collision/collision_layer.h"
#include "poinsot/presentation/held_wrenches.h"

namespace poinsot {

// Of the state of each body, in column order; those of sleeping bodies are formed once.
struct BodyDigests {
  std::vector<std::uint64_t> value;  // 0: to be formed
  std::vector<std::uint32_t> stamp;  // of the course that they are of
};

// `scene_digest`: what LivingScene knows of bodies that came and went.
std::uint64_t state_hash(std::uint64_t frame, const CollisionLayer& collision,
                         const HeldWrenches& held, std::uint64_t scene_digest,
                         BodyDigests& digests);

}  // namespace poinsot
