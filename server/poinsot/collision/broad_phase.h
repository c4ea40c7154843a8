// Broad phase: which colliders may meet. FCL's dynamic AABB tree over boxes of our own.
//
// A collider's box is its tight box grown by what it may travel in the near future; pairs stay
// valid until a tight box leaves its grown one. Half-spaces have no box and are paired with every
// collider that moves. Colliders of one body, and pairs of which neither moves, are no pairs.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "poinsot/collision/collider.h"

namespace poinsot {

struct ColliderPair {
  int a, b;  // indices of colliders, a < b
  friend auto operator<=>(const ColliderPair&, const ColliderPair&) = default;
};

class BroadPhase {
 public:
  BroadPhase(std::span<const Collider> colliders, const std::vector<bool>& moves);  // per collider
  ~BroadPhase();
  BroadPhase(BroadPhase&&) noexcept;
  BroadPhase& operator=(BroadPhase&&) noexcept;

  // Pairs whose tight boxes may overlap, sorted. `reach[i]` [m]: how far collider i may travel
  // until the pairs are wanted afresh; a shorter reach costs more updates, never a missed pair.
  std::span<const ColliderPair> pairs(std::span<const Aabb> tight, std::span<const double> reach);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
