// Scenes that between them keep everything that a run can remember from frame to frame.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "poinsot/collision/collision_layer.h"

namespace poinsot::test {

struct CheckpointScene {
  std::string name;  // an identifier
  Scene scene;
  int last;  // [frames] the last at which it is looked at
  // What a client does before frame n; may be empty.
  std::function<void(CollisionLayer&, int n)> act;
};

std::vector<CheckpointScene> checkpoint_scenes();

}  // namespace poinsot::test
