// What does not change about a body: the scene topic, one sample per body, keyed by id.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "poinsot/base/body_id.h"
#include "poinsot/math/pose.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

struct BodyInfo {
  std::uint64_t session = 0;  // of the daemon process
  BodyId id;
  std::uint32_t index = 0;  // place in the scene: its slot
  // Counts the changes of what is in the scene. Who has as many bodies as RunReport::scene_bodies
  // says for its scene_revision has them all.
  std::uint32_t revision = 1;
  bool removed = false;  // it is gone; only the id is of use
  std::string name;
  bool is_static = false;
  bool is_kinematic = false;       // moves with velocities of its own; has no mass
  MassProperties mass_properties;  // in B
  Pose pose;                       // of B in W at time 0 (for a static body: always)
  Material material;
  std::vector<ShapeDef> shapes;  // poses in B
};

}  // namespace poinsot
