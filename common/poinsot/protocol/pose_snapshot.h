// The bodies of one frame: one sample on the bus.
//
// A pose is that of the body frame B in W; the linear velocity is that of the centre of mass.
// Dynamic bodies only: static poses are in the scene topic.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/base/body_id.h"
#include "poinsot/math/types.h"

namespace poinsot {

struct BodyState {
  BodyId id;
  Vec3 position = Vec3::Zero();          // [m] of B's origin, in W
  Quat orientation = Quat::Identity();   // B → W
  Vec3 linear_velocity = Vec3::Zero();   // [m/s] of the centre of mass, in W
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] in W
};

struct PoseSnapshot {
  std::uint64_t session = 0;         // of the daemon process: changes when it restarts
  std::uint32_t epoch = 0;           // of the run: grows with each reset, from 1
  std::uint64_t frame = 0;           // index of the frame, 0 is the initial state
  std::uint64_t sequence = 0;        // counts the samples of its topic, from 1: a gap is a loss
  std::int64_t sim_time_ns = 0;      // [ns] frame / frame_rate, rounded
  std::int64_t publish_time_ns = 0;  // [ns] since 1970 (UTC) when it was handed to the bus
  std::uint64_t state_hash = 0;
  // Bodies that the topic is about: all, or those that its name asks for. It may hold fewer, those
  // that moved; a complete one holds all.
  std::uint32_t total = 0;
  bool complete = true;
  std::vector<BodyState> bodies;  // in the order of their slots: of the scene file, then spawned
};

}  // namespace poinsot
