// A control with what it needs to be obeyed, made ready by other threads than the loop's.

#pragma once

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
};

}  // namespace poinsot
