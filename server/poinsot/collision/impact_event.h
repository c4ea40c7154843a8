// An impact as it happened: what the collision layer tells of it.

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

struct ImpactEvent {
  double time = 0;              // [s]
  Eigen::Index a = 0, b = 0;    // columns; a moves
  Vec3 point = Vec3::Zero();    // [m] in W; of several points, weighted by their impulses
  Vec3 normal = Vec3::UnitZ();  // unit, in W, from b to a
  Vec3 impulse = Vec3::Zero();  // [N·s] on a, in W
  Vec3 v_a_before = Vec3::Zero(), w_a_before = Vec3::Zero();  // [m/s] [rad/s] in W
  Vec3 v_a_after = Vec3::Zero(), w_a_after = Vec3::Zero();
  Vec3 v_b_before = Vec3::Zero(), w_b_before = Vec3::Zero();
  Vec3 v_b_after = Vec3::Zero(), w_b_after = Vec3::Zero();
};

}  // namespace poinsot
