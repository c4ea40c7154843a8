#include <gtest/gtest.h>

#include "poinsot/cli/format.h"
#include "unit/cli/sample.h"

namespace poinsot {
namespace {

const WatchHeader kHeader{.world = "push_me", .state = "playing", .frames_per_second = 59.97};

std::vector<std::string> table(const Screen& screen, const std::vector<std::string>& wanted = {}) {
  return pose_table(sample::poses(), Roster(sample::bodies(), wanted), kHeader, screen);
}

// A world of many bodies, body i at (i, 0, 0).
struct Crowd {
  explicit Crowd(std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const BodyId id{i, 1};
      infos.push_back(sample::body(id, "body_" + std::to_string(i), Sphere{1}, 1));
      BodyState state;
      state.id = id;
      poses.bodies.push_back(state);
    }
    poses.session = infos.front().session;
  }
  std::vector<BodyInfo> infos;
  PoseSnapshot poses;
};

TEST(PoseTable, BeginsWithWorldStateFrameTimeAndRate) {
  EXPECT_EQ(table({.columns = 200, .rows = 50}).front(),
            "push_me  playing  frame 12  time 0.200 s  60.0 frames/s");
}

TEST(PoseTable, HasOneRowPerBody) {
  const auto lines = table({.columns = 200, .rows = 50});
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_TRUE(lines[2].starts_with("box "));
  EXPECT_TRUE(lines[3].starts_with("big ball "));
}

TEST(PoseTable, ShowsAllQuantitiesOnAWideScreen) {
  const auto lines = table({.columns = 200, .rows = 50});
  for (const char* text : {"0.1000", "-2.0000", "-0.5000", "-9.8100", "0.3333"})
    EXPECT_NE(lines[2].find(text), std::string::npos) << text << " in " << lines[2];
  EXPECT_NE(lines[1].find("angular velocity"), std::string::npos);
}

TEST(PoseTable, KeepsColumnsInLineWhenNumbersAreHuge) {
  const auto lines = table({.columns = 200, .rows = 50});
  EXPECT_EQ(lines[2].size(), lines[3].size());
  EXPECT_NE(lines[3].find("1.2e+08"), std::string::npos) << lines[3];
}

TEST(PoseTable, WritesZeroWithoutASign) {
  PoseSnapshot poses = sample::poses();
  poses.bodies[1].position = {-1e-9, -0.0, 1e-9};
  const auto lines = pose_table(poses, Roster(sample::bodies(), {"big ball"}), kHeader,
                                {.columns = 200, .rows = 50});
  EXPECT_EQ(lines[2].find("-0.0000"), std::string::npos) << lines[2];
}

TEST(PoseTable, NeverExceedsTheScreen) {
  const Crowd crowd(1000);
  const Roster roster(crowd.infos, {});
  for (const std::size_t columns : {1u, 20u, 40u, 80u, 81u, 120u, 200u}) {
    for (const std::size_t rows : {1u, 2u, 3u, 4u, 24u, 2000u}) {
      const auto lines =
          pose_table(crowd.poses, roster, kHeader, {.columns = columns, .rows = rows});
      EXPECT_LE(lines.size(), rows) << columns << "×" << rows;
      for (const std::string& line : lines) EXPECT_LE(line.size(), columns) << line;
    }
  }
}

TEST(PoseTable, SaysHowManyBodiesDoNotFit) {
  const Crowd crowd(1000);
  const auto lines =
      pose_table(crowd.poses, Roster(crowd.infos, {}), kHeader, {.columns = 80, .rows = 24});
  ASSERT_EQ(lines.size(), 24u);
  EXPECT_EQ(lines.back(), "and 979 more (--body NAME chooses)");  // 24 − 2 − 1 rows are shown
}

TEST(PoseTable, ShowsTheChosenBodyOnly) {
  const auto lines = table({.columns = 80, .rows = 24}, {"big ball"});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(lines[2].starts_with("big ball"));
}

TEST(PoseTable, CountsCharactersNotBytes) {
  std::vector<BodyInfo> bodies = sample::bodies();
  bodies[1].name = "würfel";  // one byte more than characters
  const auto lines =
      pose_table(sample::poses(), Roster(bodies, {}), kHeader, {.columns = 200, .rows = 50});
  EXPECT_EQ(lines[2].size(), lines[3].size() + 1);
}

}  // namespace
}  // namespace poinsot
