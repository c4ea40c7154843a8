// The pairs of colliders that may meet, in order, of which a few are found anew now and then.
//
// Sorting is by counting: its cost is proportional to the pairs and the colliders. Replacing the
// pairs of some colliders walks once over all pairs and sorts only those found anew.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace poinsot {

struct ColliderPair {
  int a, b;  // indices of colliders, a < b
  friend auto operator<=>(const ColliderPair&, const ColliderPair&) = default;
};

class PairList {
 public:
  explicit PairList(std::size_t colliders);

  // Sorted by (a, b).
  std::span<const ColliderPair> pairs() const { return pairs_; }

  // To be filled, each pair once, in any order; the calls below take it over and empty it.
  std::vector<ColliderPair>& found() { return found_; }
  // All pairs there are have been found.
  void replace_all();
  // All pairs with one of those touched (a flag per collider) have been found, and no others.
  void replace_touched(std::span<const unsigned char> touched);

 private:
  void sort_found();

  std::vector<ColliderPair> pairs_, found_, scratch_;
  std::vector<std::uint32_t> rows_of_a_, rows_of_b_;  // while sorting, per collider
};

}  // namespace poinsot
