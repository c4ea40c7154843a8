#include "poinsot/collision/broad_phase.h"

#include <algorithm>
#include <cmath>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

namespace poinsot {
namespace {

// After this many body sizes of travel since the last rebuild a refitted tree has decayed.
constexpr double kTravelPerRebuild = 2.0;

// FCL's own box of a turned object is that of its bounding sphere; ours is tight.
class Leaf : public fcl::CollisionObjectd {
 public:
  Leaf(int index, const std::shared_ptr<fcl::CollisionGeometryd>& geometry)
      : fcl::CollisionObjectd(geometry), index_(index) {}

  void set(const Aabb& box) {
    aabb.min_ = box.low;
    aabb.max_ = box.high;
  }
  int index() const { return index_; }

 private:
  int index_;
};

int index_of(fcl::CollisionObjectd* object) {
  return static_cast<Leaf*>(object)->index();
}

}  // namespace

struct BroadPhase::Impl {
  std::vector<Eigen::Index> body;  // per collider
  std::vector<bool> moves;
  std::vector<double> size;  // [m]
  std::vector<int> planes, boxed;
  std::vector<std::unique_ptr<Leaf>> leaves;  // per boxed collider
  std::vector<Aabb> grown;                    // per collider
  std::vector<ColliderPair> pairs;
  std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> tree;
  double travel = 0;  // [-] mean body sizes since the last rebuild
  bool fresh = false;

  bool is_pair(int i, int j) const {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    return body[a] != body[b] && (moves[a] || moves[b]);
  }
  void add(int i, int j) {
    if (is_pair(i, j)) pairs.push_back({std::min(i, j), std::max(i, j)});
  }

  bool all_inside(std::span<const Aabb> tight) const {
    return std::all_of(boxed.begin(), boxed.end(), [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      return !moves[k] || grown[k].contains(tight[k]);
    });
  }

  void grow(std::span<const Aabb> tight, std::span<const double> reach) {
    double sum = 0;
    for (std::size_t n = 0; n < boxed.size(); ++n) {
      const auto k = static_cast<std::size_t>(boxed[n]);
      if (fresh && !moves[k]) continue;
      const Vec3 before = grown[k].low + grown[k].high;
      grown[k] = tight[k].grown(moves[k] ? reach[k] : 0);
      if (fresh) sum += 0.5 * (grown[k].low + grown[k].high - before).norm() / size[k];
      leaves[n]->set(grown[k]);
    }
    if (!boxed.empty()) travel += sum / static_cast<double>(boxed.size());
  }

  void rebuild() {
    tree = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
    std::vector<fcl::CollisionObjectd*> objects;
    for (const auto& leaf : leaves) objects.push_back(leaf.get());
    tree->registerObjects(objects);
    tree->setup();
    travel = 0;
  }

  void find() {
    pairs.clear();
    if (leaves.size() > 1)
      tree->collide(this, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* self) {
        static_cast<Impl*>(self)->add(index_of(a), index_of(b));
        return false;
      });
    for (const int plane : planes)
      for (const int i : boxed) add(plane, i);
    std::sort(pairs.begin(), pairs.end());
  }
};

BroadPhase::BroadPhase(std::span<const Collider> colliders, const std::vector<bool>& moves)
    : impl_(std::make_unique<Impl>()) {
  const auto geometry = std::make_shared<fcl::Sphered>(1.0);  // never queried
  impl_->moves = moves;
  impl_->grown.resize(colliders.size());
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const Collider& collider = colliders[i];
    impl_->body.push_back(collider.body);
    impl_->size.push_back(collider.size);
    if (std::holds_alternative<HalfSpace>(collider.shape)) {
      impl_->planes.push_back(static_cast<int>(i));
    } else {
      impl_->boxed.push_back(static_cast<int>(i));
      impl_->leaves.push_back(std::make_unique<Leaf>(static_cast<int>(i), geometry));
    }
  }
  impl_->pairs.reserve(16 * colliders.size() + 16);
}

BroadPhase::~BroadPhase() = default;
BroadPhase::BroadPhase(BroadPhase&&) noexcept = default;
BroadPhase& BroadPhase::operator=(BroadPhase&&) noexcept = default;

std::span<const ColliderPair> BroadPhase::pairs(std::span<const Aabb> tight,
                                                std::span<const double> reach) {
  Impl& self = *impl_;
  if (self.fresh && self.all_inside(tight)) return self.pairs;
  self.grow(tight, reach);
  if (!self.fresh || self.travel > kTravelPerRebuild) {
    self.rebuild();
  } else {
    self.tree->update();
  }
  self.fresh = true;
  self.find();
  return self.pairs;
}

}  // namespace poinsot
