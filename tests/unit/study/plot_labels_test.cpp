#include "poinsot/study/plot_labels.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(PlotLabels, PutANameWhereItsCurveIsAlone) {
  const std::vector<PlotLabel> labels = place_labels(
      {{"a", {{1, 1e-2, "1"}, {10, 1e-10, "2"}}}, {"b", {{1, 2e-2, "1"}, {10, 1e-1, "2"}}}});
  EXPECT_EQ(labels[0].text, "a");
  EXPECT_EQ(labels[0].x, 10);
  EXPECT_EQ(labels[1].text, "b");
  EXPECT_EQ(labels[1].x, 10);
}

TEST(PlotLabels, NameEveryCurveEvenWhereAllMeet) {
  const Curve point{"", {{5, 1e-9, "default"}}};
  const std::vector<PlotLabel> labels = place_labels({point, point, point});
  EXPECT_EQ(std::count_if(labels.begin(), labels.end(), [](const auto& l) { return l.is_name; }),
            3);
  EXPECT_EQ(labels.size(), 3u) << "settings have no room there";
}

}  // namespace
}  // namespace poinsot
