// Joints in the soft step: each solved exactly at its turn in a sweep, one after another.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/soft_bodies.h"

namespace poinsot {

class SoftJoints {
 public:
  void start(std::span<const SoftBody> bodies, std::span<const PointJoint> joints);
  void warm_start(std::span<const PointJoint> joints, SoftBodies& bodies);
  // The relative velocity becomes the target, or nothing once bodies have moved with it.
  void solve(std::span<PointJoint> joints, SoftBodies& bodies, bool to_target);

 private:
  struct Arms {
    Vec3 a, b;            // [m] in W at the start of the step
    Vec3 last_a, last_b;  // when the impulse was last applied
  };
  std::vector<Arms> arms_;
};

}  // namespace poinsot
