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

}  // namespace
}  // namespace poinsot
