// Scenes that between them keep everything that a run can remember from frame to frame.

#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "poinsot/collision/collision_layer.h"

namespace poinsot::test {

struct CheckpointScene {
  std::string name;  // an identifier
  Scene scene;
  int last;  // [frames] the last at which it is saved
  int on;    // [frames] that it then goes on
  // What a client does before frame n; may be empty.
  std::function<void(CollisionLayer&, int n)> act;
};

inline void PrintTo(const CheckpointScene& of, std::ostream* out) {
  *out << of.name;
}

std::vector<CheckpointScene> checkpoint_scenes();

}  // namespace poinsot::test
