// The fingerprint of a run: equal hashes mean equal states and equal continuations, bit for bit.

#pragma once

#include <cstdint>

#include "poinsot/collision/collision_layer.h"
#include "poinsot/presentation/held_wrenches.h"

namespace poinsot {

// Of the end of frame `frame`: the frame, every body's state and motion, the wrenches that are held
// on, and what contacts carry over.
std::uint64_t state_hash(std::uint64_t frame, const CollisionLayer& collision,
                         const HeldWrenches& held);

}  // namespace poinsot
