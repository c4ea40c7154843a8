// Runs a scene in frames, without the layers above the collision layer.

#pragma once

#include "poinsot/collision/collision_layer.h"

namespace poinsot::test {

inline constexpr double kFrameRate = 60;  // [Hz]

// Advances by whole frames until `t` [s]; `each` sees the layer after every frame.
template <class Each>
void run_until(CollisionLayer& layer, double t, Each&& each) {
  const auto first = std::llround(layer.time() * kFrameRate) + 1;
  for (auto n = first; n <= std::llround(t * kFrameRate); ++n) {
    layer.advance_to(static_cast<double>(n) / kFrameRate);
    each(layer);
  }
}

inline void run_until(CollisionLayer& layer, double t) {
  run_until(layer, t, [](const CollisionLayer&) {});
}

}  // namespace poinsot::test
