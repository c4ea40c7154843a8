// Worlds that are changed between frames, and what is asked of them.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "poinsot/collision/collision_layer.h"
#include "support/scene_builder.h"

namespace poinsot::test {

inline const World& world_of(const CollisionLayer& layer) {
  return layer.world();
}

inline Eigen::Index column(const CollisionLayer& layer, const std::string& name) {
  return world_of(layer).find(name).value();
}

inline Course::Column state_of(const CollisionLayer& layer, const std::string& name) {
  return world_of(layer).y.col(column(layer, name));
}

inline Vec3 place_of(const CollisionLayer& layer, const std::string& name) {
  return position(world_of(layer).y, column(layer, name));
}

inline std::uint64_t fingerprint(const CollisionLayer& layer) {
  Hash64 hash;
  hash.add({layer.world().y.data(), static_cast<std::size_t>(layer.world().y.size())});
  layer.hash_into(hash);
  return hash.value();
}

inline BodyDef brick(const std::string& name, const Vec3& position) {
  return body(name, Box{{1, 1, 1}}, position);
}

inline BodyDef made_static(BodyDef def) {
  def.is_static = true;
  def.mass_properties = {};
  return def;
}

inline BodyDef made_kinematic(BodyDef def) {
  def.is_kinematic = true;
  def.mass_properties = {};
  return def;
}

// Boxes on one another, to stand on z = 0 at `at`.
inline std::vector<BodyDef> tower(int boxes, const Vec3& at = Vec3::Zero(),
                                  const std::string& of = "box") {
  std::vector<BodyDef> bodies;
  for (int k = 0; k < boxes; ++k)
    bodies.push_back(brick(of + std::to_string(k), at + Vec3(0, 0, 0.5 + k)));
  return bodies;
}

inline Scene on_ground(std::vector<BodyDef> bodies) {
  bodies.insert(bodies.begin(), ground());
  return scene(std::move(bodies));
}

// A tower that sleeps, one that falls and settles, a flight, and "changed": each far from the
// others.
inline Scene several() {
  std::vector<BodyDef> bodies = tower(3);
  for (BodyDef& def : tower(4, {20, 0, 0.2}, "falling")) bodies.push_back(std::move(def));
  bodies.push_back(box("flying", {0, 30, 40}, {0.3, 0.4, 0.5}));
  bodies.back().angular_velocity = {0.1, 3, 0.2};
  bodies.push_back(brick("changed", {-20, 0, 0.5}));
  return on_ground(std::move(bodies));
}

}  // namespace poinsot::test
