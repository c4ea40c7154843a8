#include "poinsot/collision/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// From this share of boxes on, pairing all anew is cheaper than pairing those that were set.
// Fewer pairs than this share of the colliders are sorted by comparing, more by counting.
constexpr std::size_t kFewPairs = 32;

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
      row_(colliders.size() + 1) {
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    if (!std::holds_alternative<HalfSpace>(colliders[i].shape)) continue;
    plane_of_[i] = static_cast<int>(planes_.size());
    planes_.push_back({static_cast<int>(i), Vec3::Zero(), std::numeric_limits<double>::infinity()});
    tree_.set_idle(static_cast<int>(i), true);
  }
  list_.reserve(colliders.size());
  for (auto* list : {&pairs_, &found_, &scratch_}) list->reserve(16 * colliders.size());
}

BroadPhase::BroadPhase(std::span<const Collider> colliders, const std::vector<bool>& moves)
    : BroadPhase(colliders) {
  for (std::size_t i = 0; i < moves.size(); ++i) set_moves(static_cast<int>(i), moves[i]);
}

void BroadPhase::touch(int i) {
  const auto k = static_cast<std::size_t>(i);
  if (touched_[k]) return;
  touched_[k] = 1;
  list_.push_back(i);
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
  if (list_.empty()) return pairs_;
  found_.clear();
  const bool all = tree_.find_changed(found_);
  find_under_planes(all);
  sort_found();
  if (all) {
    pairs_.swap(found_);
  } else {
    merge_found();
  }
  for (const int i : list_) touched_[static_cast<std::size_t>(i)] = 0;
  list_.clear();
  return pairs_;
}

void BroadPhase::find_under_planes(bool all) {
  for (const Plane& plane : planes_) {
    if (!all && !touched_[static_cast<std::size_t>(plane.collider)]) {
      for (const int i : list_) find_under(plane, i);
    } else {
      for (int i = 0; i < static_cast<int>(body_.size()); ++i) find_under(plane, i);
    }
  }
}

void BroadPhase::find_under(const Plane& plane, int i) {
  if (tree_.is_idle(i) && tree_.is_idle(plane.collider)) return;
  if (body_[static_cast<std::size_t>(i)] == body_[static_cast<std::size_t>(plane.collider)]) return;
  if (reaches(tree_.box(i), plane.normal, plane.offset))
    found_.push_back({std::min(plane.collider, i), std::max(plane.collider, i)});
}

// Counted into rows of equal a, each row then sorted by b.
void BroadPhase::sort_found() {
  if (found_.size() * kFewPairs < touched_.size()) {
    std::sort(found_.begin(), found_.end());
    return;
  }
  std::fill(row_.begin(), row_.end(), 0);
  for (const ColliderPair& pair : found_) ++row_[static_cast<std::size_t>(pair.a) + 1];
  for (std::size_t i = 1; i < row_.size(); ++i) row_[i] += row_[i - 1];
  scratch_.resize(found_.size());
  for (const ColliderPair& pair : found_) scratch_[row_[static_cast<std::size_t>(pair.a)]++] = pair;
  found_.swap(scratch_);
  const auto at = [&](std::size_t k) { return found_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::size_t first = 0;
  for (std::size_t i = 0; i + 1 < row_.size(); ++i) {
    if (row_[i] - first > 1) std::sort(at(first), at(row_[i]));
    first = row_[i];
  }
}

// Puts what was found in place of the pairs of those touched.
void BroadPhase::merge_found() {
  const auto is_touched = [&](int i) { return touched_[static_cast<std::size_t>(i)]; };
  std::size_t kept = 0;
  for (const ColliderPair pair : pairs_) {
    pairs_[kept] = pair;
    kept += (is_touched(pair.a) | is_touched(pair.b)) == 0;
  }
  pairs_.resize(kept);
  scratch_.resize(kept + found_.size());
  std::merge(pairs_.begin(), pairs_.end(), found_.begin(), found_.end(), scratch_.begin());
  pairs_.swap(scratch_);
}

std::span<const ColliderPair> BroadPhase::pairs(std::span<const Aabb> tight,
                                                std::span<const double> reach) {
  const bool fresh = grown_.empty();
  if (fresh) grown_.assign(tight.begin(), tight.end());
  for (std::size_t i = 0; i < tight.size(); ++i) {
    if (!fresh && grown_[i].contains(tight[i])) continue;
    grown_[i] = tight[i].grown(tree_.is_idle(static_cast<int>(i)) ? 0 : reach[i]);
    set(static_cast<int>(i), grown_[i]);
  }
  return pairs();
}

}  // namespace poinsot
