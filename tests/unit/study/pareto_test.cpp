#include "poinsot/study/pareto.h"

#include <gtest/gtest.h>

#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;

// Rows of (error, cost); certificate 1e-12.
StudyResult result(const std::vector<std::pair<double, double>>& rows) {
  std::vector<Row> all;
  for (const auto& [error, cost] : rows)
    all.push_back(test::row(test::setting(rk4, 0.1), {error, error / 2}, cost));
  return test::result(std::move(all));
}

std::vector<bool> marks(StudyResult study) {
  mark_pareto(study);
  std::vector<bool> marks;
  for (const Row& row : study.rows) marks.push_back(row.pareto);
  return marks;
}

TEST(Pareto, MarksWhatNoOtherBeatsInBoth) {
  EXPECT_EQ(marks(result({{1e-3, 1}, {1e-6, 2}, {1e-5, 3}, {1e-9, 10}, {1e-3, 2}})),
            (std::vector<bool>{true, true, false, true, false}));
}

TEST(Pareto, MarksBothOfTwoThatAreAlike) {
  EXPECT_EQ(marks(result({{1e-3, 1}, {1e-3, 1}})), (std::vector<bool>{true, true}));
}

TEST(Pareto, SeesNoDifferenceBelowTheCertificate) {
  EXPECT_EQ(marks(result({{1e-15, 5}, {1e-13, 4}})), (std::vector<bool>{false, true}));
}

TEST(Cheapest, IsTheLeastCostOfThoseThatAreGoodEnoughInMetresAndRadians) {
  StudyResult study = result({{1e-3, 1}, {1e-6, 3}, {1e-7, 2}, {1e-9, 10}});
  EXPECT_EQ(cheapest(study, 1e-5), &study.rows[2]);
  EXPECT_EQ(cheapest(study, 1e-8), &study.rows[3]);
  study.rows[2].measured.orientation = 1e-2;
  EXPECT_EQ(cheapest(study, 1e-5), &study.rows[1]);
}

TEST(Cheapest, IsNoneIfNoneIsGoodEnoughOrTheReferenceCannotTell) {
  const StudyResult study = result({{1e-3, 1}, {0, 3}});
  EXPECT_EQ(cheapest(study, 1e-13), nullptr);
  EXPECT_EQ(cheapest(result({{1e-3, 1}}), 1e-4), nullptr);
}

}  // namespace
}  // namespace poinsot
