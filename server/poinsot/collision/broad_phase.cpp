#include "poinsot/collision/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// From this share of boxes on, pairing all anew is cheaper than pairing those that were set.
constexpr std::size_t kAllAnew = 3;
// Few pairs are sorted by comparing, many by counting.
constexpr std::size_t kFewPairs = 8;

bool reaches(const Aabb& box, const Vec3& normal, double offset) {
  const Vec3 lowest = (normal.array() > 0).select(box.low, box.high);
  return box.low[0] <= box.high[0] && normal.dot(lowest) <= offset;
}

}  // namespace

BroadPhase::BroadPhase(std::span<const Collider> colliders)
    : tree_(colliders.size()), touched_(colliders.size(), 0), row_(colliders.size() + 1) {
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const bool plane = std::holds_alternative<HalfSpace>(colliders[i].shape);
    body_.push_back(colliders[i].body);
    moves_.push_back(!plane);
    plane_of_.push_back(plane ? static_cast<int>(planes_.size()) : -1);
    if (plane)
      planes_.push_back(
          {static_cast<int>(i), Vec3::Zero(), std::numeric_limits<double>::infinity()});
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
  const auto k = static_cast<std::size_t>(i);
  if (static_cast<bool>(moves_[k]) == moves) return;
  moves_[k] = moves;
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
  tree_.update();
  found_.clear();
  if (list_.size() * kAllAnew > touched_.size()) {
    find_all();
    sort_found();
    pairs_.swap(found_);
  } else {
    find_touched();
    sort_found();
    merge_found();
  }
  for (const int i : list_) touched_[static_cast<std::size_t>(i)] = 0;
  list_.clear();
  return pairs_;
}

bool BroadPhase::may_pair(int i, int j) const {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  return body_[a] != body_[b] && (moves_[a] | moves_[b]) != 0;
}

void BroadPhase::find_under(const Plane& plane, int i) {
  if (may_pair(plane.collider, i) && reaches(tree_.box(i), plane.normal, plane.offset))
    found_.push_back({std::min(plane.collider, i), std::max(plane.collider, i)});
}

void BroadPhase::find_all() {
  tree_.find_all(found_);
  std::erase_if(found_, [&](const ColliderPair& pair) { return !may_pair(pair.a, pair.b); });
  for (const Plane& plane : planes_)
    for (int i = 0; i < static_cast<int>(touched_.size()); ++i) find_under(plane, i);
}

// A pair of two touched ones is taken from the first.
void BroadPhase::find_touched() {
  const auto is_touched = [&](int i) { return touched_[static_cast<std::size_t>(i)] != 0; };
  for (const int i : list_) {
    if (const int plane = plane_of_[static_cast<std::size_t>(i)]; plane >= 0) {
      for (int j = 0; j < static_cast<int>(touched_.size()); ++j)
        if (!is_touched(j)) find_under(planes_[static_cast<std::size_t>(plane)], j);
      continue;
    }
    const std::size_t before = found_.size();
    tree_.find(i, found_);
    std::size_t kept = before;
    for (std::size_t k = before; k < found_.size(); ++k) {
      const ColliderPair pair = found_[k];
      if (may_pair(pair.a, pair.b) && (pair.a == i || !is_touched(pair.a))) found_[kept++] = pair;
    }
    found_.resize(kept);
    for (const Plane& plane : planes_) find_under(plane, i);
  }
}

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
  std::size_t first = 0;
  for (std::size_t i = 0; i + 1 < row_.size(); ++i) {
    std::sort(found_.begin() + static_cast<std::ptrdiff_t>(first),
              found_.begin() + static_cast<std::ptrdiff_t>(row_[i]));
    first = row_[i];
  }
}

// Puts what was found in place of the pairs of those touched.
void BroadPhase::merge_found() {
  scratch_.clear();
  auto next = found_.begin();
  for (const ColliderPair& pair : pairs_) {
    if (touched_[static_cast<std::size_t>(pair.a)] | touched_[static_cast<std::size_t>(pair.b)])
      continue;
    while (next != found_.end() && *next < pair) scratch_.push_back(*next++);
    scratch_.push_back(pair);
  }
  scratch_.insert(scratch_.end(), next, found_.end());
  pairs_.swap(scratch_);
}

std::span<const ColliderPair> BroadPhase::pairs(std::span<const Aabb> tight,
                                                std::span<const double> reach) {
  const bool fresh = grown_.empty();
  if (fresh) grown_.assign(tight.begin(), tight.end());
  for (std::size_t i = 0; i < tight.size(); ++i) {
    if (!fresh && grown_[i].contains(tight[i])) continue;
    grown_[i] = tight[i].grown(moves_[i] ? reach[i] : 0);
    set(static_cast<int>(i), grown_[i]);
  }
  return pairs();
}

}  // namespace poinsot
