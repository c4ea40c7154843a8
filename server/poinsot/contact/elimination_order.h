// In which order bodies are eliminated from a sparse symmetric system, and what fills in.
//
// Minimum degree on the quotient graph: always the body next that is coupled to fewest others, the
// couplings its elimination makes counted. Degrees are upper bounds where elements overlap. Ties go
// to the body whose degree was renewed last, so the order depends on nothing but the graph.
// Source: Amestoy, Davis, Duff, An Approximate Minimum Degree Ordering Algorithm (1996).

#pragma once

#include <array>
#include <span>
#include <vector>

namespace poinsot {

class EliminationOrder {
 public:
  // Pairs of different nodes of 0 … nodes − 1, each pair once. Allocates only for graphs larger
  // than any before.
  void compute(int nodes, std::span<const std::array<int, 2>> pairs);

  int nodes() const { return static_cast<int>(order.size()); }

  std::vector<int> order;         // position → node
  std::vector<int> position;      // node → position
  std::vector<int> column_start;  // of position k: rows[column_start[k] … column_start[k + 1])
  std::vector<int> rows;          // positions below the diagonal that column k reaches, ascending

 private:
  void load(std::span<const std::array<int, 2>> pairs);
  void file_by_degree(int node);
  void unfile(int node);
  int take_least();
  void eliminate(int node);
  void gather_front(int node);
  void renew(int node, int pivot, int front_size);
  void sort_rows();

  std::vector<int> start_;       // of a node's lists, each of which only shrinks
  std::vector<int> neighbours_;  // that are not eliminated and share no element with the node
  std::vector<int> neighbour_count_;
  std::vector<int> elements_;  // eliminated nodes whose front holds the node
  std::vector<int> element_count_;
  std::vector<int> front_start_, front_size_;  // of an eliminated node, in rows
  std::vector<int> degree_, head_, next_, previous_;
  std::vector<int> mark_, outside_mark_, outside_;  // outside_: of an element, beyond this front
  std::vector<char> absorbed_;
  int least_ = 0;
  int left_ = 0;
};

}  // namespace poinsot
