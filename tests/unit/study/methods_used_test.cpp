#include "poinsot/study/methods_used.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

MethodsUsed used(std::initializer_list<Method> methods) {
  MethodsUsed result;
  for (const Method method : methods) {
    FrameReport report;
    report.methods[static_cast<std::size_t>(method)] = 3;
    result.see(report);
  }
  return result;
}

TEST(MethodsUsed, AreThoseOfAnyFrameInTheOrderOfTheirNames) {
  EXPECT_EQ(used({Method::taylor, Method::none, Method::flight}).list(),
            (std::vector<Method>{Method::flight, Method::taylor}));
}

TEST(MethodsUsed, OfTwoRunsThatBothLeaveABodyAloneHaveNothingInCommon) {
  const MethodsUsed flight = used({Method::flight, Method::none});
  EXPECT_FALSE(flight.shares_one_with(used({Method::dop853, Method::none})));
  EXPECT_TRUE(flight.shares_one_with(used({Method::taylor, Method::flight})));
}

TEST(MethodsUsed, KnowARunInClosedFormThroughout) {
  EXPECT_TRUE(used({Method::flight, Method::none}).only_flight());
  EXPECT_FALSE(used({Method::flight, Method::taylor}).only_flight());
  EXPECT_FALSE(used({Method::none}).only_flight());
}

}  // namespace
}  // namespace poinsot
