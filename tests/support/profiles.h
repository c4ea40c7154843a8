// The two profiles that hard cases are run in.

#pragma once

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "poinsot/scene/scene.h"

namespace poinsot::test {

inline constexpr Profile kProfiles[] = {Profile::accurate, Profile::fast};

inline Scene with_profile(Scene scene, Profile profile) {
  scene.collision = collision_defaults(profile);
  return scene;
}

inline std::string profile_name(const testing::TestParamInfo<Profile>& info) {
  return info.param == Profile::accurate ? "accurate" : "fast";
}

}  // namespace poinsot::test
