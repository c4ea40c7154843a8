// The two profiles that hard cases are run in.

#pragma once

#include "poinsot/scene/scene.h"

namespace poinsot {

// Stands in for those of the scene module.
enum class Profile { accurate, fast };
inline CollisionDef collision_defaults(Profile profile) {
  CollisionDef def;
  if (profile == Profile::fast) def.impact_search = ImpactSearchKind::none;
  return def;
}

namespace test {

inline constexpr Profile kProfiles[] = {Profile::accurate, Profile::fast};

inline Scene with_profile(Scene scene, Profile profile) {
  scene.collision = collision_defaults(profile);
  return scene;
}

}  // namespace test
}  // namespace poinsot
