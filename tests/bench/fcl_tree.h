// FCL's dynamic tree as a broad phase, with tight boxes and a rebuild policy of our own: the base
// line of bench_broad_phase.

#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include "poinsot/collision/broad_phase.h"

namespace poinsot::bench {

class FclTree {
 public:
  explicit FclTree(std::span<const Collider> colliders) : pairs_(colliders.size()) {
    const auto geometry = std::make_shared<fcl::Sphered>(1.0);  // never queried
    for (const Collider& collider : colliders) {
      size_.push_back(collider.size);
      moves_.push_back(true);
      is_set_.push_back(0);
      leaves_.push_back(std::make_unique<Leaf>(static_cast<int>(leaves_.size()), geometry));
    }
  }

  void set_moves(int i, bool moves) { moves_[static_cast<std::size_t>(i)] = moves; }

  void set(int i, const Aabb& box) {
    const auto k = static_cast<std::size_t>(i);
    fcl::AABBd& aabb = leaves_[k]->box();
    if (tree_) travel_ += 0.5 * (box.low + box.high - aabb.min_ - aabb.max_).norm() / size_[k];
    aabb.min_ = box.low;
    aabb.max_ = box.high;
    if (!is_set_[k]) list_.push_back(i);
    is_set_[k] = 1;
  }

  std::span<const ColliderPair> pairs() {
    if (list_.empty()) return pairs_.pairs();
    if (!tree_ || travel_ > 2.0 * static_cast<double>(leaves_.size())) {
      rebuild();
    } else {
      tree_->update();
    }
    // A query for each costs more than twice as much as all against all.
    if (list_.size() > leaves_.size() / 7) {
      tree_->collide(this, add);
      pairs_.replace_all();
    } else {
      query_set();
    }
    for (const int i : list_) is_set_[static_cast<std::size_t>(i)] = 0;
    list_.clear();
    return pairs_.pairs();
  }

 private:
  struct Leaf : fcl::CollisionObjectd {
    Leaf(int i, const std::shared_ptr<fcl::CollisionGeometryd>& geometry)
        : fcl::CollisionObjectd(geometry), index(i) {}
    fcl::AABBd& box() { return aabb; }
    int index;
  };

  static bool add(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
    static_cast<FclTree*>(self)->take(static_cast<Leaf*>(a)->index, static_cast<Leaf*>(b)->index);
    return false;
  }
  static bool add_one(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
    auto* tree = static_cast<FclTree*>(self);
    const int i = static_cast<int>(tree->asking_);
    const int j = static_cast<Leaf*>(a)->index + static_cast<Leaf*>(b)->index - i;
    if (j > i || !tree->is_set_[static_cast<std::size_t>(j)]) tree->take(i, j);
    return false;
  }
  void take(int i, int j) {
    if (i != j && (moves_[static_cast<std::size_t>(i)] || moves_[static_cast<std::size_t>(j)]))
      pairs_.found().push_back({std::min(i, j), std::max(i, j)});
  }

  void rebuild() {
    tree_ = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    std::vector<fcl::CollisionObjectd*> objects;
    for (const auto& leaf : leaves_) objects.push_back(leaf.get());
    tree_->registerObjects(objects);
    tree_->setup();
    travel_ = 0;
  }

  // A pair of two that were set is that of the first.
  void query_set() {
    for (asking_ = 0; asking_ < size_.size(); ++asking_)
      if (is_set_[asking_]) tree_->collide(leaves_[asking_].get(), this, add_one);
    pairs_.replace_touched(is_set_);
  }

  std::vector<double> size_;  // [m]
  std::vector<bool> moves_;
  std::vector<unsigned char> is_set_;
  std::vector<std::unique_ptr<Leaf>> leaves_;
  std::vector<int> list_;
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> tree_;
  double travel_ = 0;  // [-] sizes, summed
  std::size_t asking_ = 0;
  PairList pairs_;
};

}  // namespace poinsot::bench
