#include "poinsot/contact/block_ldlt.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/allocation_counter.h"

namespace poinsot {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

struct System {
  std::vector<BlockLdlt::Block> diagonal, coupling;
  Eigen::MatrixXd dense;
};

// M + Σ JᵀJ over pairs, each with its own random rows.
System random_system(int bodies, const Pairs& pairs, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random_block = [&] {
    BlockLdlt::Block block;
    for (int i = 0; i < 36; ++i) block(i) = uniform(generator);
    return block;
  };
  System system;
  system.diagonal.assign(static_cast<std::size_t>(bodies), BlockLdlt::Block::Identity());
  system.dense = Eigen::MatrixXd::Identity(6 * bodies, 6 * bodies);
  for (const auto& [a, b] : pairs) {
    const BlockLdlt::Block x = random_block(), y = random_block();
    system.diagonal[static_cast<std::size_t>(a)] += x * x.transpose();
    system.diagonal[static_cast<std::size_t>(b)] += y * y.transpose();
    system.coupling.push_back(x * y.transpose());
    system.dense.block<6, 6>(6 * a, 6 * a) += x * x.transpose();
    system.dense.block<6, 6>(6 * b, 6 * b) += y * y.transpose();
    system.dense.block<6, 6>(6 * a, 6 * b) += x * y.transpose();
    system.dense.block<6, 6>(6 * b, 6 * a) += y * x.transpose();
  }
  return system;
}

void fill(BlockLdlt& ldlt, const System& system) {
  ldlt.clear();
  for (std::size_t i = 0; i < system.diagonal.size(); ++i)
    ldlt.diagonal(static_cast<int>(i)) += system.diagonal[i];
  for (std::size_t p = 0; p < system.coupling.size(); ++p)
    ldlt.add_coupling(static_cast<int>(p), system.coupling[p]);
  ldlt.factorise();
}

Pairs random_pairs(int bodies, double density, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Pairs pairs;
  for (int a = 0; a < bodies; ++a)
    for (int b = 0; b < a; ++b)
      if (uniform(generator) < density)
        pairs.push_back(uniform(generator) < 0.5 ? std::array{a, b} : std::array{b, a});
  return pairs;
}

Pairs line(int bodies) {
  Pairs pairs;
  for (int i = 0; i + 1 < bodies; ++i) pairs.push_back({i, i + 1});
  return pairs;
}

TEST(BlockLdlt, SolvesLikeADenseFactorisation) {
  std::mt19937 generator(7);
  for (const int bodies : {1, 2, 3, 10, 40})
    for (const double density : {0.0, 0.05, 0.3, 1.0}) {
      const Pairs pairs = random_pairs(bodies, density, generator);
      const System system = random_system(bodies, pairs, generator);
      BlockLdlt ldlt;
      ldlt.analyse(bodies, pairs);
      fill(ldlt, system);
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(6 * bodies, -1, 2);
      Eigen::VectorXd b = system.dense * x;
      ldlt.solve({b.data(), static_cast<std::size_t>(b.size())});
      // Backward stable: the error is the condition times some roundings of each row.
      const double condition = 1 / system.dense.llt().rcond();
      EXPECT_LE((b - x).norm(), 1e-15 * 6 * bodies * condition * x.norm());
      EXPECT_EQ(ldlt.replaced_pivots(), 0);
    }
}

TEST(BlockLdlt, AStackAndAStarFillNothing) {
  BlockLdlt ldlt;
  ldlt.analyse(50, line(50));
  EXPECT_EQ(ldlt.blocks(), 49);
  Pairs star;
  for (int i = 1; i < 50; ++i) star.push_back({i, 0});
  ldlt.analyse(50, star);
  EXPECT_EQ(ldlt.blocks(), 49);
}

TEST(BlockLdlt, ARingFillsOneBlockPerBodyLeft) {
  Pairs ring = line(50);
  ring.push_back({49, 0});
  BlockLdlt ldlt;
  ldlt.analyse(50, ring);
  EXPECT_EQ(ldlt.blocks(), 50 + 47);  // every elimination but the last three joins two neighbours
}

TEST(BlockLdlt, AGridFillsFarLessThanItsBand) {
  const int side = 20;
  Pairs grid;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (i > 0) grid.push_back({i * side + j, (i - 1) * side + j});
      if (j > 0) grid.push_back({i * side + j, i * side + j - 1});
    }
  BlockLdlt ldlt;
  ldlt.analyse(side * side, grid);
  EXPECT_LT(ldlt.blocks(), side * side * side / 2);
}

TEST(BlockLdlt, WhatHasNoPivotLeftStaysFinite) {
  BlockLdlt ldlt;
  ldlt.analyse(2, Pairs{{0, 1}});
  ldlt.clear();
  const BlockLdlt::Block ones = BlockLdlt::Block::Ones();  // of rank one, and shared
  ldlt.diagonal(0) += ones;
  ldlt.diagonal(1) += ones;
  ldlt.add_coupling(0, -ones);
  ldlt.factorise();
  EXPECT_EQ(ldlt.replaced_pivots(), 11);
  std::vector<double> x(12, 1.0);
  ldlt.solve(x);
  for (const double value : x) EXPECT_TRUE(std::isfinite(value));
}

TEST(BlockLdlt, DoesNotAllocateForTheSameGraph) {
  if (!test::can_count_allocations()) GTEST_SKIP();
  std::mt19937 generator(3);
  const Pairs pairs = random_pairs(30, 0.2, generator), smaller = line(20);
  const System system = random_system(30, pairs, generator);
  BlockLdlt ldlt;
  ldlt.analyse(30, pairs);
  fill(ldlt, system);
  std::vector<double> x(180, 1.0);
  const std::size_t before = test::allocations();
  ldlt.analyse(30, pairs);
  fill(ldlt, system);
  ldlt.solve(x);
  ldlt.analyse(20, smaller);
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace poinsot
