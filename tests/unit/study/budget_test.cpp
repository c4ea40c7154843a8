#include "poinsot/study/budget.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using Seconds = std::chrono::duration<double>;

double left(Budget::Clock::time_point deadline) {
  return Seconds(deadline - Budget::Clock::now()).count();
}

// A busy machine may stop the test between two looks at the clock, for less than this.
constexpr double kSlack = 5;  // [s]

TEST(Budget, IsSharedOutAndWhatARunLeavesGoesToTheOthers) {
  Budget budget(Seconds(1000), 10);
  EXPECT_NEAR(left(budget.deadline(2)), 200, kSlack);
  EXPECT_NEAR(budget.shared_out(), 0.2, 1e-12);
  EXPECT_NEAR(left(budget.deadline()), 125, kSlack);  // nothing was used
  EXPECT_NEAR(left(budget.deadline(6, 0.5)), 1000 * 6 / 7. / 2, kSlack);
  EXPECT_NEAR(left(budget.deadline()), 1000, kSlack);
  EXPECT_EQ(budget.shared_out(), 1);
}

}  // namespace
}  // namespace poinsot
