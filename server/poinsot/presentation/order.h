// A control with what it needs to be obeyed, made ready by other threads than the loop's.

#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "poinsot/presentation/checkpoint.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

struct Order {
  RunControl control;
  // For spawn: the bodies of control.text, each valid in itself.
  std::shared_ptr<const std::vector<BodyDef>> fragment = {};
  // For restore: read from disk, because none of the name is in memory.
  std::shared_ptr<const Checkpoint> checkpoint = {};
  // For a release that the daemon gives itself: it acts after the commands of its client up to this
  // seq and before those beyond, which came later, perhaps of another process.
  std::uint64_t after = 0;
};

}  // namespace poinsot
