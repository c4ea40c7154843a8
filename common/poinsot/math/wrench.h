// A force and a torque about a stated point, in a stated frame.

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

struct Wrench {
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 torque = Vec3::Zero();  // [N·m]

  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    torque += other.torque;
    return *this;
  }

  template <class Archive>
  void archive(Archive& with) {
    with(force, torque);
  }
};

}  // namespace poinsot
