// Sparse LDLᵀ factorisation of a symmetric positive definite matrix of 6 × 6 blocks, one row of
// blocks per body.
//
//   BlockLdlt system;
//   system.analyse(bodies, pairs);       // cheap while the graph is the same
//   system.clear();  system.diagonal(i) += …;  system.add_coupling(p, block);
//   system.factorise();
//   system.solve(x);                     // as often as wanted
//
// Bodies are eliminated in an order of little fill. A pivot that rounding has made nothing of its
// diagonal is replaced by that diagonal: the factor is then of a nearby positive definite matrix.
// Nothing is allocated for problems no larger than any before. Left-looking by columns; source:
// Davis, Direct Methods for Sparse Linear Systems (2006).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "poinsot/contact/elimination_order.h"
#include "poinsot/math/types.h"

namespace poinsot {

class BlockLdlt {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Map = Eigen::Map<Block>;

  // Pairs of different bodies of 0 … bodies − 1, each pair once: where blocks may be non-zero.
  void analyse(int bodies, std::span<const std::array<int, 2>> pairs);

  void clear();
  Map diagonal(int body);
  // Rows of the pair's first body, columns of its second one.
  void add_coupling(int pair, const Block& block);

  void factorise();
  void solve(std::span<double> x) const;  // right-hand side in, solution out; 6 per body

  int replaced_pivots() const { return replaced_pivots_; }  // of the last factorisation
  int blocks() const { return static_cast<int>(order_.rows.size()); }

 private:
  void place_pairs();
  void list_rows();
  void gather(int column);
  void factorise_diagonal(int column);
  void divide(int column);

  struct Place {
    int block;
    bool transposed;
  };

  EliminationOrder order_;
  std::vector<std::array<int, 2>> pairs_;
  std::vector<Place> places_;             // of pairs
  std::vector<double> diagonal_;          // 36 per position, by columns; then their factors
  std::vector<double> pivots_, inverse_;  // 6 per position
  std::vector<double> below_;             // 36 per entry of order_.rows
  std::vector<int> row_start_;            // of position k: entries whose row is k …
  std::vector<int> row_entries_, row_columns_;
  std::vector<int> slot_;  // of a row in the column at hand
  int bodies_ = -1;
  int replaced_pivots_ = 0;
};

}  // namespace poinsot
