// A checkpoint: all that a run needs to go on from the end of a frame, bit for bit: the scene as it
// is then (bodies that were spawned or removed included), the state of the physics, what is held.
// Immutable once made: it may be shared and written to disk by another thread.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

struct Checkpoint {
  std::string name;
  std::uint32_t epoch = 0;
  std::uint64_t frame = 0;
  std::uint64_t state_hash = 0;
  std::shared_ptr<const Scene> scene;  // shared by the checkpoints between which it did not change
  std::vector<std::byte> state;        // PresentationLayer's, see checkpoint.cpp
};

// The same checkpoint for another number of threads, which no bit depends on; 0: for its own.
std::shared_ptr<const Checkpoint> with_threads(const std::shared_ptr<const Checkpoint>& checkpoint,
                                               int threads);

}  // namespace poinsot
