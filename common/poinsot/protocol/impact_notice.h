// An impact that was located: the events topic, one sample each, in order of time where they belong
// together.

#pragma once

#include <cstdint>

#include "poinsot/base/body_id.h"
#include "poinsot/math/types.h"

namespace poinsot {

// What an impact did to one of its two bodies. Velocities in W: of the centre of mass [m/s], and
// angular [rad/s].
struct ImpactedBody {
  BodyId id;
  Vec3 linear_before = Vec3::Zero(), angular_before = Vec3::Zero();
  Vec3 linear_after = Vec3::Zero(), angular_after = Vec3::Zero();
};

struct ImpactNotice {
  std::uint64_t session = 0;
  std::uint32_t epoch = 0;
  std::uint64_t frame = 0;      // that was advanced when it happened
  std::uint64_t sequence = 0;   // counts the samples of the topic, from 1: a gap is a loss
  double time = 0;              // [s]
  ImpactedBody a, b;            // a moves, b may be static
  Vec3 point = Vec3::Zero();    // [m] in W; of several points, weighted by their impulses
  Vec3 normal = Vec3::UnitZ();  // unit, in W, from b to a
  Vec3 impulse = Vec3::Zero();  // [N·s] on a, in W; the opposite acts on b
};

}  // namespace poinsot
