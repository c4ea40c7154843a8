// A pose: position of an origin and orientation of its axes, in a parent frame.
//
// Outside the physics a pose is that of the body frame in W. Inside it is that of the centre of
// mass, with the axes of the body frame.

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

struct Pose {
  Vec3 c = Vec3::Zero();      // [m] origin, in the parent frame
  Quat q = Quat::Identity();  // unit, child → parent

  Vec3 operator*(const Vec3& point) const { return c + q * point; }  // child → parent
  Pose operator*(const Pose& child) const { return {c + q * child.c, q * child.q}; }
  Pose inverse() const { return {-(q.conjugate() * c), q.conjugate()}; }

  template <class Archive>
  void archive(Archive& with) {
    with(c, q);
  }
};

}  // namespace poinsot
