#include "poinsot/collision/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

std::vector<int> bodies(std::span<const Collider> colliders) {
  std::vector<int> result;
  for (const Collider& collider : colliders) result.push_back(static_cast<int>(collider.body));
  return result;
}

bool reaches(const Aabb& box, const Vec3& normal, double offset) {
  const Vec3 lowest = (normal.array() > 0).select(box.low, box.high);
  return box.low[0] <= box.high[0] && normal.dot(lowest) <= offset;
}

}  // namespace

BroadPhase::BroadPhase(std::span<const Collider> colliders)
    : body_(bodies(colliders)),
      tree_(body_),
      plane_of_(colliders.size(), -1),
      touched_(colliders.size(), 0),
      list_(colliders.size()) {
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    if (!std::holds_alternative<HalfSpace>(colliders[i].shape)) continue;
    plane_of_[i] = static_cast<int>(planes_.size());
    planes_.push_back({static_cast<int>(i), Vec3::Zero(), std::numeric_limits<double>::infinity()});
    tree_.set_idle(static_cast<int>(i), true);
  }
  which_.reserve(colliders.size());
}

void BroadPhase::touch(int i) {
  const auto k = static_cast<std::size_t>(i);
  if (touched_[k]) return;
  touched_[k] = 1;
  which_.push_back(i);
}

bool BroadPhase::set(int i, const Aabb& box) {
  if (plane_of_[static_cast<std::size_t>(i)] >= 0) return true;
  touch(i);
  const bool finite = box.low.allFinite() && box.high.allFinite();
  const bool empty = (box.low.array() > box.high.array()).any();
  tree_.set(i, finite && !empty ? box : Aabb{});
  return finite || empty;
}

void BroadPhase::set_moves(int i, bool moves) {
  if (tree_.is_idle(i) != moves) return;
  tree_.set_idle(i, !moves);
  touch(i);
}

bool BroadPhase::set_plane(int i, const Vec3& normal_W, double offset_W) {
  touch(i);
  const bool finite = normal_W.allFinite() && std::isfinite(offset_W);
  Plane& plane = planes_[static_cast<std::size_t>(plane_of_[static_cast<std::size_t>(i)])];
  plane.normal = finite ? normal_W : Vec3(Vec3::Zero());
  plane.offset = finite ? offset_W : -std::numeric_limits<double>::infinity();
  return finite;
}

std::span<const ColliderPair> BroadPhase::pairs() {
  if (which_.empty()) return list_.pairs();
  const bool all = tree_.find_changed(list_.found());
  find_under_planes(all);
  if (all) {
    list_.replace_all();
  } else {
    list_.replace_touched(touched_);
  }
  for (const int i : which_) touched_[static_cast<std::size_t>(i)] = 0;
  which_.clear();
  return list_.pairs();
}

void BroadPhase::find_under_planes(bool all) {
  for (const Plane& plane : planes_) {
    if (!all && !touched_[static_cast<std::size_t>(plane.collider)]) {
      for (const int i : which_) find_under(plane, i);
    } else {
      for (int i = 0; i < static_cast<int>(body_.size()); ++i) find_under(plane, i);
    }
  }
}

void BroadPhase::find_under(const Plane& plane, int i) {
  if (tree_.is_idle(i) && tree_.is_idle(plane.collider)) return;
  if (body_[static_cast<std::size_t>(i)] == body_[static_cast<std::size_t>(plane.collider)]) return;
  if (reaches(tree_.box(i), plane.normal, plane.offset))
    list_.found().push_back({std::min(plane.collider, i), std::max(plane.collider, i)});
}

}  // namespace poinsot
