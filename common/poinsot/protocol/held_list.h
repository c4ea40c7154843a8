// What is held on bodies, by whom: the held topic, written when it changes, while somebody reads
// it.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct HeldItem {
  std::uint64_t client = 0;  // 0: the scene
  std::uint64_t seq = 0;
  std::uint32_t slot = 0;
  BodyId body;
  WrenchKind kind = WrenchKind::force;
  Axes axes = Axes::world;        // of force and torque
  Vec3 force = Vec3::Zero();      // [N]; of an impulse [N·s]
  Vec3 torque = Vec3::Zero();     // [N·m]; of an impulse [N·m·s]
  Vec3 point_B = Vec3::Zero();    // [m] where it acts, from the origin of B, in B
  Vec3 target = Vec3::Zero();     // [m] of a tether, in W
  double stiffness = 0;           // [N/m] of a tether
  double damping = 0;             // [N·s/m] of a tether
  std::uint64_t first_frame = 0;  // of effect …
  std::uint64_t last_frame = 0;   // … kForever: until cleared
  bool outlives_client = false;
};

struct HeldList {
  std::uint64_t session = 0;
  std::uint32_t epoch = 0;
  std::uint64_t frame = 0;      // the last one advanced
  std::uint64_t sequence = 0;   // counts the samples of the topic, from 1
  std::uint32_t left_out = 0;   // items beyond kMaxListed
  std::vector<HeldItem> items;  // in the order (client, seq)
};

}  // namespace poinsot
