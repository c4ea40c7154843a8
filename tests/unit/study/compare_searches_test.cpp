#include "poinsot/study/compare_searches.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace poinsot {
namespace {

RunLimit seconds(int n) {
  return {std::chrono::steady_clock::now() + std::chrono::seconds(n), {}};
}

Scene bouncing() {
  BodyDef ball = test::body("ball", Sphere{0.1}, {0, 0, 1.1});
  ball.material.restitution = 0.9;
  return test::scene({ball, test::ground(0, 0.9)});
}

TEST(CompareSearches, RunsEverySearchOnTheScene) {
  const auto rows = compare_searches(bouncing(), 90, 1, seconds(20));  // 1.5 s: two bounces
  ASSERT_EQ(rows.size(), kImpactSearchNames.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].search, kImpactSearchNames[i].value);
    EXPECT_EQ(rows[i].of_the_scene, rows[i].search == ImpactSearchKind::conservative);
    EXPECT_GE(rows[i].runs, 1u);
    if (rows[i].search == ImpactSearchKind::none) continue;
    EXPECT_DOUBLE_EQ(rows[i].impacts, 2 / 1.5);
    EXPECT_GE(rows[i].searches, rows[i].impacts);
    EXPECT_GE(rows[i].poses, rows[i].searches);
    EXPECT_LT(rows[i].difference.larger(), 1e-12);
  }
  EXPECT_EQ(rows.front().difference, PoseError{});  // from itself
  // Fixed steps know an impact at 4 m/s to no better than a part of a step.
  EXPECT_GT(rows.back().difference.position, 1e-4);
  EXPECT_EQ(rows.back().impacts, 0);
}

TEST(CompareSearches, HasNothingToSayWhereNothingMeets) {
  const Scene scene = test::scene({test::body("ball", Sphere{0.1}, {0, 0, 1.1})});
  EXPECT_TRUE(compare_searches(scene, 60, 1, seconds(20)).empty());
}

TEST(CompareSearches, StopsAtItsLimit) {
  EXPECT_TRUE(compare_searches(bouncing(), 1'000'000, 100, seconds(0)).empty());
}

}  // namespace
}  // namespace poinsot
