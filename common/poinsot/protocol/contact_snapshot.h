// All contact points of one frame that push: the contacts topic, while somebody reads it.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/base/body_id.h"
#include "poinsot/math/types.h"

namespace poinsot {

struct ContactState {
  BodyId a, b;
  Vec3 point = Vec3::Zero();    // [m] in W
  Vec3 normal = Vec3::UnitZ();  // unit, in W, from b to a
  Vec3 force = Vec3::Zero();    // [N] on a, in W, as last solved in the frame; the opposite on b
};

struct ContactSnapshot {
  std::uint64_t session = 0;  // as in PoseSnapshot
  std::uint32_t epoch = 0;
  std::uint64_t frame = 0;
  std::uint64_t sequence = 0;  // counts the samples of the topic, from 1: a gap is a loss
  std::int64_t sim_time_ns = 0;
  std::uint32_t left_out = 0;  // points beyond kMaxContacts
  std::vector<ContactState> contacts;
};

}  // namespace poinsot
