#include "poinsot/base/parallel.h"

#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(Team, DoesEveryTaskOnce) {
  for (const int threads : {1, 2, 4}) {
    Team team(threads);
    EXPECT_EQ(team.size(), threads);
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
      std::vector<int> done(count, 0);
      team.run(count, [&](std::size_t k, int thread) {
        ASSERT_LT(thread, threads);
        ++done[k];
      });
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
  }
}

TEST(Team, CanBeUsedManyTimesInARow) {
  Team team(3);
  std::vector<long> sums(7, 0);
  for (int round = 0; round < 2000; ++round)
    team.run(sums.size(), [&](std::size_t k, int) { sums[k] += round; });
  EXPECT_EQ(sums, std::vector<long>(7, 2000L * 1999 / 2));
}

TEST(Team, SeesInAStageWhatTheOneBeforeItWrote) {
  constexpr std::size_t kWide = 37, kStages = 400;
  for (const int threads : {1, 2, 4}) {
    Team team(threads);
    std::vector<std::size_t> counts, now(kWide, 0), then(kWide, 0);
    for (std::size_t stage = 0; stage < kStages; ++stage) counts.push_back(stage % 5 ? kWide : 1);
    bool complete = true;
    team.run_stages(counts, [&](std::size_t stage, std::size_t k, int thread) {
      ASSERT_LT(thread, threads);
      if (stage % 5 == 0) {
        for (std::size_t i = 0; i < kWide; ++i) complete = complete && now[i] == stage - stage / 5;
      } else {
        now[k] = then[(k + 1) % kWide] + 1;
        then[(k + 1) % kWide] = now[k];
      }
    });
    EXPECT_TRUE(complete);
  }
}

TEST(Team, DoesEmptyStagesAndNone) {
  Team team(2);
  int calls = 0;
  team.run_stages({}, [&](std::size_t, std::size_t, int) { ++calls; });
  const std::vector<std::size_t> counts = {0, 3, 0, 0, 2, 0};
  std::vector<int> done(5, 0);
  team.run_stages(counts,
                  [&](std::size_t stage, std::size_t k, int) { ++done[stage == 1 ? k : 3 + k]; });
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(done, std::vector<int>(5, 1));
}

}  // namespace
}  // namespace poinsot
