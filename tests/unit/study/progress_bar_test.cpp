#include "poinsot/study/progress_bar.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(ProgressLine, GrowsFromEmptyToFull) {
  EXPECT_EQ(progress_line(0, "reference"),
            "[                                        ]   0 %  reference");
  EXPECT_EQ(progress_line(0.5, "x"), "[####################                    ]  50 %  x");
  EXPECT_EQ(progress_line(1, "x"), "[########################################] 100 %  x");
}

TEST(ProgressLine, StaysWithinItsBoundsAndOnOneLine) {
  EXPECT_EQ(progress_line(7, "x"), progress_line(1, "x"));
  EXPECT_EQ(progress_line(-1, "x"), progress_line(0, "x"));
  EXPECT_EQ(progress_line(0.5, std::string(200, 'x')).size(), 79u);
}

}  // namespace
}  // namespace poinsot
