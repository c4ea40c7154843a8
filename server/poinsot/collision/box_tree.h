// A tree of boxes, four to a node: finds the pairs of boxes that overlap.
//
// Nodes bound their children in single precision, so that one comparison of four lanes decides four
// boxes. Rounding to nearest is monotone: boxes that overlap do so rounded too, and what the tree
// hands on is decided on the exact boxes. A box that is set refits the nodes above it; the tree is
// built anew once boxes have moved so far that it has decayed. What is found depends on the boxes
// alone, in what order does not.
//
// Built top down by the surface-area heuristic over position and size: Wald, "On fast construction
// of SAH-based bounding volume hierarchies" (2007); big boxes are parted from small ones, as a
// ground from what stands on it.

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/collision/collider.h"
#include "poinsot/collision/pair_list.h"

namespace poinsot {

// Bits that are walked in order.
class BitSet {
 public:
  void resize(std::size_t n) { words_.assign((n + 63) / 64, 0); }
  bool test(std::size_t i) const { return (words_[i / 64] >> (i % 64) & 1) != 0; }
  void set(std::size_t i) { words_[i / 64] |= std::uint64_t{1} << (i % 64); }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  template <class F>
  void each(F&& f) const {
    for (std::size_t k = 0; k < words_.size(); ++k)
      for (std::uint64_t left = words_[k]; left != 0; left &= left - 1)
        f(64 * k + static_cast<std::size_t>(std::countr_zero(left)));
  }
  // From the last to the first, those set on the way included; none is left.
  template <class F>
  void drain_backwards(F&& f) {
    for (std::size_t k = words_.size(); k-- > 0;)
      while (words_[k] != 0) {
        const auto bit = static_cast<std::size_t>(63 - std::countl_zero(words_[k]));
        words_[k] &= ~(std::uint64_t{1} << bit);
        f(64 * k + bit);
      }
  }

 private:
  std::vector<std::uint64_t> words_;
};

class BoxTree {
 public:
  // All boxes empty: they overlap nothing. Two boxes of one group do not pair, nor do two that are
  // idle; none is idle at first.
  explicit BoxTree(std::span<const int> group);

  // Finite or empty [m].
  void set(int i, const Aabb& box);
  void set_idle(int i, bool idle);
  const Aabb& box(int i) const { return items_[static_cast<std::size_t>(i)].box; }
  bool is_idle(int i) const { return items_[static_cast<std::size_t>(i)].idle; }

  // Appends the pairs of overlapping boxes of which at least one was set, or became idle or ceased
  // to be, since the last call: each once, a < b, in no order to rely on. If that was so many that
  // it appended all pairs there are, it returns true.
  bool find_changed(std::vector<ColliderPair>& pairs);

  std::size_t builds() const { return builds_; }

 private:
  static constexpr std::size_t kWidth = 4;

  // What was set, until the next search.
  struct Item {
    Aabb box;
    std::int32_t slot;  // of its leaf
    bool idle = false;
  };
  // Leaves are in the order of the tree: what is near in space is near in memory.
  struct Leaf {
    Aabb box;  // exact [m]
    std::int32_t item, group;
    std::int32_t node;  // that holds it
    std::uint8_t lane;
    bool idle = false;
  };
  // A child is a node (>= 0) or a leaf (~leaf); a lane without a child has an empty box.
  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> low, high;  // [m] from the origin, per axis and lane
    std::array<std::int32_t, kWidth> child;
    std::int32_t parent;  // before its children; -1: none
    std::int32_t lane;    // of the parent, which holds its own bounds
  };
  struct Task {
    std::int32_t a, b;  // a: node or ~leaf; b: node
  };

  // A box while building: x, y, z from the origin [m] and, as a fourth axis, how large it is
  // [octaves].
  struct alignas(16) Part {
    std::array<float, 4> low, high;
    std::int32_t leaf;
  };
  struct Range {
    std::size_t first, count;
  };

  void change(const Item& item);
  void take_up();
  void note_travel(std::size_t slot, const Aabb& to);
  void write(const Leaf& leaf);
  void refit();
  void refit(std::size_t node);
  void find_all(std::vector<ColliderPair>& pairs);
  void find(std::size_t slot, std::vector<ColliderPair>& pairs);
  void find_between(std::size_t tasks, std::vector<ColliderPair>& pairs);
  void emit(std::int32_t a, std::int32_t b, std::vector<ColliderPair>& pairs) const;

  void build();
  void gather();
  std::int32_t add_node(Range range, std::int32_t parent, std::size_t lane, std::size_t depth);
  std::size_t part(Range range);
  std::size_t halve(std::span<Part> parts, std::size_t axis);
  void scale_travel();

  std::vector<Item> items_;
  std::vector<Leaf> leaves_;
  std::vector<float> travel_scale_;  // per leaf [1/m]: one over the size of its node when built
  std::vector<Node> nodes_;
  BitSet loose_;             // nodes whose own bounds may have changed
  BitSet changed_;           // leaves
  std::size_t changes_ = 0;  // leaves that have changed
  std::vector<Task> tasks_;
  std::vector<Part> parts_;       // while building
  std::vector<Leaf> old_leaves_;  // while building
  BitSet was_changed_;            // while building
  std::size_t depth_ = 0;         // nodes from the root to the lowest
  Vec3 origin_ = Vec3::Zero();    // [m] of the nodes' coordinates
  double travel_ = 0;             // [-] sizes of nodes, summed over boxes, since the last build
  double debt_ = 0;               // [-] what searches since then have cost more for it
  std::size_t builds_ = 0;
};

}  // namespace poinsot
