#include "poinsot/study/sweep.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/study/settings.h"
#include "support/scene_builder.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;

Scene tumbling() {
  BodyDef body = test::free_body("body", 2, Vec3(1, 2, 3));
  body.angular_velocity = Vec3(1, 3, 2);
  return test::scene({body});
}

void ignore(double, const std::string&) {}

TEST(Sweep, AccountsForEverySetting) {
  const Scene scene = tumbling();
  const StudyResult result =
      sweep(scene, {.frames = 30, .budget = std::chrono::seconds(2)}, ignore, {});
  std::size_t settings = result.skipped.size();
  for (const Row& row : result.rows) settings += 1 + row.equal.size();
  EXPECT_EQ(settings, settings_for(scene).size());
  EXPECT_EQ(result.horizon, 30u);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(std::count_if(result.rows.begin(), result.rows.end(),
                          [](const Row& row) { return row.setting.of_the_scene; }),
            1);
  EXPECT_TRUE(std::any_of(result.rows.begin(), result.rows.end(),
                          [](const Row& row) { return row.pareto; }));
}

TEST(Sweep, ShowsProgressThatOnlyGrows) {
  double last = 0;
  bool named = false;
  const auto show = [&](double done, const std::string& what) {
    EXPECT_GE(done, last - 1e-12);
    EXPECT_LE(done, 1);
    last = done;
    named = named || what == "rk4 1/240 s";
  };
  sweep(tumbling(), {.frames = 30, .budget = std::chrono::seconds(2)}, show, {});
  EXPECT_GT(last, 0.9);
  EXPECT_TRUE(named);
}

TEST(Sweep, ShortensTheHorizonRatherThanTakeMoreThanItsBudget) {
  const auto start = std::chrono::steady_clock::now();
  const StudyResult result = sweep(
      tumbling(), {.frames = 100'000'000, .budget = std::chrono::milliseconds(500)}, ignore, {});
  EXPECT_EQ(result.reference.end, HorizonEnd::budget);
  EXPECT_LT(result.horizon, result.asked);
  EXPECT_FALSE(result.rows.empty());
  // Single frames are not cut short; a busy machine takes its time.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Sweep, OfASceneInWhichNothingMovesIsAnError) {
  EXPECT_THROW(sweep(test::scene({test::floor()}), {}, ignore, {}), Error);
}

TEST(Sweep, EndsWhenStopped) {
  std::stop_source stop;
  const auto show = [&](double, const std::string& what) {
    if (what != "reference") stop.request_stop();
  };
  const StudyResult result =
      sweep(tumbling(), {.frames = 30, .budget = std::chrono::seconds(2)}, show, stop.get_token());
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.horizon, 30u);
  EXPECT_LT(result.rows.size(), 2u);
}

TEST(SpeaksFor, TheDefaultThenTheScenesOwnThenTheFiner) {
  const Setting standard = test::setting(exact, 0), fine = test::setting(exact, 1e-9);
  Setting coarse = test::setting(exact, 1e-3);
  EXPECT_TRUE(speaks_for(standard, fine));
  EXPECT_TRUE(speaks_for(fine, coarse));
  EXPECT_FALSE(speaks_for(coarse, fine));
  coarse.of_the_scene = true;
  EXPECT_TRUE(speaks_for(coarse, fine));
  EXPECT_TRUE(speaks_for(test::setting(rk4, 0.01), test::setting(rk4, 0.02)));
}

}  // namespace
}  // namespace poinsot
