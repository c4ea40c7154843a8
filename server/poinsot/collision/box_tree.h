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

#include <array>
#include <cstdint>
#include <vector>

#include "poinsot/collision/collider.h"

namespace poinsot {

struct ColliderPair {
  int a, b;  // indices of colliders, a < b
  friend auto operator<=>(const ColliderPair&, const ColliderPair&) = default;
};

class BoxTree {
 public:
  explicit BoxTree(std::size_t boxes = 0);  // all empty: they overlap nothing

  // Finite or empty [m]. Takes effect at the next update.
  void set(int i, const Aabb& box);
  const Aabb& box(int i) const { return boxes_[slot(i)]; }

  void update();

  // Appends the pairs of boxes that overlap, each once, a < b, in no order to rely on: all of them,
  // or those of one box. Up to date only after update().
  void find_all(std::vector<ColliderPair>& pairs);
  void find(int i, std::vector<ColliderPair>& pairs);

  std::size_t builds() const { return builds_; }

 private:
  static constexpr int kWidth = 4;
  // A child is a node (>= 0) or the slot of a box (~slot); a lane without a child is empty.
  struct alignas(64) Node {
    std::array<std::array<float, kWidth>, 3> low, high;  // [m] from the origin, per axis and lane
    std::array<std::int32_t, kWidth> child;
    std::int32_t parent, lane;  // where its own bounds are; parent < this; -1: none
  };
  struct Place {
    std::int32_t node, lane;
  };
  struct Task {
    std::int32_t a, b;  // a: node or ~slot; b: node
  };

  std::size_t slot(int i) const {
    return static_cast<std::size_t>(slot_of_[static_cast<std::size_t>(i)]);
  }
  // A box while building: x, y, z from the origin [m] and, as a fourth axis, how large it is
  // [octaves].
  struct alignas(16) Item {
    std::array<float, 4> low, high;
    std::int32_t slot;
  };
  struct Range {
    std::size_t first, count;
  };

  void build();
  void gather();
  std::int32_t add_node(Range range, Place parent, std::size_t depth);
  std::size_t part(Range range);
  void reorder();
  void scale_travel();
  void refit();
  void mark(std::int32_t node);
  void write(std::size_t slot);
  void note_travel(std::size_t slot, const Aabb& to);
  void run(std::size_t tasks, std::vector<ColliderPair>& pairs);
  void emit(std::int32_t a, std::int32_t b, std::vector<ColliderPair>& pairs) const;

  // Slots are the boxes in the order of the tree: what is near in space is near in memory.
  std::vector<Aabb> boxes_;             // per slot, exact [m]
  std::vector<std::int32_t> item_;      // per slot: the index it is set by
  std::vector<std::int32_t> slot_of_;   // per index
  std::vector<Place> place_;            // per slot
  std::vector<float> travel_scale_;     // per slot [1/m]: one over the size of its node when built
  std::vector<Node> nodes_;             // a parent before its children
  std::vector<std::uint64_t> touched_;  // a bit per node: its own bounds may have changed
  std::vector<Task> tasks_;
  std::vector<Item> items_;          // while building
  std::vector<Aabb> old_boxes_;      // while building
  std::vector<std::int32_t> order_;  // while building: the old slot of each new one
  std::size_t depth_ = 0;            // nodes from the root to the lowest
  Vec3 origin_ = Vec3::Zero();       // [m] of the nodes' coordinates
  double travel_ = 0;                // [-] sizes of nodes, summed over boxes, since the last build
  std::size_t builds_ = 0;
};

}  // namespace poinsot
