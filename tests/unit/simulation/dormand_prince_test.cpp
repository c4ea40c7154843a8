// The tables against the conditions that they must fulfil: a wrong digit breaks one.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/simulation/embedded_pair.h"

namespace poinsot {
namespace {

// Rounding of the weights to double, and of the nodes that are sums of others.
double rounding(EmbeddedPair::Row row) {
  double size = 1;
  for (const EmbeddedPair::Term& term : row) size += std::abs(term.weight);
  return 2e-15 * size;
}

double sum(EmbeddedPair::Row row) {
  double total = 0;
  for (const EmbeddedPair::Term& term : row) total += term.weight;
  return total;
}

// Where each stage is taken: the row's sum. The stage after the last is at the end.
std::vector<double> nodes(const EmbeddedPair& pair) {
  std::vector<double> c = {0};
  for (const EmbeddedPair::Row row : pair.stages) c.push_back(sum(row));
  c.push_back(1);
  for (const EmbeddedPair::Row row : pair.extra) c.push_back(sum(row));
  return c;
}

double moment(const EmbeddedPair& pair, EmbeddedPair::Row row, int power) {
  const std::vector<double> c = nodes(pair);
  double total = 0;
  for (const EmbeddedPair::Term& term : row)
    total += term.weight * std::pow(c[static_cast<std::size_t>(term.stage)], power);
  return total;
}

class Tables : public testing::TestWithParam<const EmbeddedPair*> {};

// Σ bᵢ cᵢᵏ⁻¹ = 1/k up to the order: the pair integrates polynomials exactly.
TEST_P(Tables, IntegratePolynomialsUpToTheirOrder) {
  const EmbeddedPair& pair = *GetParam();
  for (int k = 1; k <= pair.order; ++k)
    EXPECT_NEAR(moment(pair, pair.solution, k - 1), 1.0 / k, rounding(pair.solution)) << k;
  EXPECT_GT(std::abs(moment(pair, pair.solution, pair.order) - 1.0 / (pair.order + 1)), 1e-6);
}

// Differences of two solutions: nothing is left of polynomials of the lower order.
TEST_P(Tables, EstimateNoErrorWhereThereIsNone) {
  const EmbeddedPair& pair = *GetParam();
  const int lower = pair.order == 8 ? 5 : 4;
  for (int k = 1; k <= lower; ++k)
    EXPECT_NEAR(moment(pair, pair.error, k - 1), 0, rounding(pair.error)) << k;
  EXPECT_GT(std::abs(moment(pair, pair.error, lower)), 1e-6);
  if (pair.error3.empty()) return;
  for (int k = 1; k <= 3; ++k)
    EXPECT_NEAR(moment(pair, pair.error3, k - 1), 0, rounding(pair.error3)) << k;
}

TEST_P(Tables, HaveStagesWithinTheStep) {
  for (const double c : nodes(*GetParam())) {
    EXPECT_GE(c, 0);
    EXPECT_LE(c, 1 + 1e-13);
  }
}

// Σⱼ aᵢⱼ cⱼ = cᵢ²/2 from the third stage on: each stage is of second order at least.
TEST_P(Tables, HaveStagesOfSecondOrder) {
  const EmbeddedPair& pair = *GetParam();
  const std::vector<double> c = nodes(pair);
  std::size_t stage = 2;
  for (std::size_t s = 1; s < pair.stages.size(); ++s, ++stage)
    EXPECT_NEAR(moment(pair, pair.stages[s], 1), c[stage] * c[stage] / 2, rounding(pair.stages[s]))
        << stage;
  ++stage;
  for (const EmbeddedPair::Row row : pair.extra) {
    EXPECT_NEAR(moment(pair, row, 1), c[stage] * c[stage] / 2, rounding(row)) << stage;
    ++stage;
  }
}

// Dense output adds nothing to the constant: rows of further coefficients sum to zero.
TEST_P(Tables, HaveDenseRowsThatVanishForAConstant) {
  for (const EmbeddedPair::Row row : GetParam()->dense) EXPECT_NEAR(sum(row), 0, rounding(row));
}

std::string name_of_table(const testing::TestParamInfo<const EmbeddedPair*>& info) {
  return info.param->order == 5 ? "dopri5" : "dop853";
}
INSTANTIATE_TEST_SUITE_P(All, Tables, testing::Values(&kDopri5, &kDop853), name_of_table);

}  // namespace
}  // namespace poinsot
