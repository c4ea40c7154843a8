#include "poinsot/study/settings.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/scene_builder.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;

Scene spinning() {
  return test::scene({test::free_body("body", 1, Vec3(1, 2, 3))});
}

std::vector<Setting> of(const std::vector<Setting>& all, const std::string& family) {
  std::vector<Setting> some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [&](const Setting& setting) { return setting.family == family; });
  return some;
}

TEST(Settings, TryEveryIntegratorInTheOrderOfItsNames) {
  std::vector<std::string> families;
  for (const Setting& setting : settings_for(spinning()))
    if (families.empty() || families.back() != setting.family) families.push_back(setting.family);
  std::vector<std::string> names;
  for (const auto& row : kIntegratorNames) names.emplace_back(row.name);
  EXPECT_EQ(families, names);
}

TEST(Settings, AreStepsFromTheFrameDownwardsOrTolerancesWithTheDefault) {
  const std::vector<Setting> all = settings_for(spinning());
  std::vector<std::string> steps, tolerances;
  for (const Setting& setting : of(all, "rk4")) steps.push_back(setting.label);
  for (const Setting& setting : of(all, "dop853")) tolerances.push_back(setting.label);
  EXPECT_EQ(steps, (std::vector<std::string>{"1/60 s", "1/240 s", "1/960 s", "1/3840 s"}));
  EXPECT_EQ(tolerances.front(), "1e-3");
  EXPECT_EQ(tolerances.back(), "1e-12");
  EXPECT_EQ(std::count(tolerances.begin(), tolerances.end(), "default"), 1);
}

TEST(Settings, ThatTheSceneWouldNotBeValidWithAreLeftOut) {
  Scene slow = spinning();
  slow.presentation.frame_rate = 0.5;  // a frame is longer than the longest step
  if (!validate(slow).empty()) slow.presentation.frame_rate = 1;
  for (const Setting& setting : settings_for(slow))
    EXPECT_TRUE(validate(with(slow, setting)).empty()) << setting.name();
}

TEST(Settings, HoldTheScenesOwnOnceInItsPlaceOnTheCurve) {
  Scene scene = spinning();
  scene.simulation.integrator = rk4;
  scene.simulation.step = 1e-3;
  const std::vector<Setting> rk4s = of(settings_for(scene), "rk4");
  ASSERT_EQ(rk4s.size(), 5u);
  EXPECT_EQ(rk4s[3].label, "1/1000 s");
  EXPECT_TRUE(rk4s[3].of_the_scene);

  scene.simulation.integrator = dop853;
  scene.simulation.tolerance = 1e-6;  // is in the list already; dop853 reads no step
  const std::vector<Setting> all = settings_for(scene);
  EXPECT_EQ(all.size(), settings_for(spinning()).size());
  const auto own =
      std::find_if(all.begin(), all.end(), [](const Setting& s) { return s.of_the_scene; });
  ASSERT_NE(own, all.end());
  EXPECT_EQ(own->name(), "dop853 1e-6");
}

TEST(Settings, OfTheSceneThatAreFinerThanAllStandLast) {
  Scene scene = spinning();
  scene.simulation.integrator = rk4;
  scene.simulation.step = 1e-5;
  EXPECT_TRUE(of(settings_for(scene), "rk4").back().of_the_scene);
  EXPECT_FALSE(settings_for(scene).back().of_the_scene) << "they went behind another family";
}

TEST(Settings, AreNamedByWhatTheMethodReads) {
  EXPECT_EQ(test::setting(rk4, 0).name(), "rk4 contact step");
  EXPECT_EQ(test::setting(rk4, 0.0125).name(), "rk4 1/80 s");
  EXPECT_EQ(test::setting(rk4, 0.7).name(), "rk4 0.7 s");
  EXPECT_EQ(test::setting(taylor, 0).name(), "taylor default");
  EXPECT_EQ(test::setting(taylor, 3e-7).name(), "taylor 3e-07");
  EXPECT_EQ(test::setting(dopri5, 1e-10).name(), "dopri5 1e-10");
}

TEST(RunningOrder, IsTheScenesOwnAndTheDefaultsThenTheCoarsestOfEachFamily) {
  std::vector<Setting> settings = {test::setting(exact, 1e-3), test::setting(exact, 0),
                                   test::setting(rk4, 0.1),    test::setting(rk4, 0.01),
                                   test::setting(rk4, 0.001),  test::setting(explicit_euler, 0.1)};
  settings[4].of_the_scene = true;
  EXPECT_EQ(running_order(settings), (std::vector<std::size_t>{1, 4, 0, 2, 5, 3}));
}

}  // namespace
}  // namespace poinsot
