// Sort and sweep as a broad phase, for comparison: boxes in single precision, sorted along one
// axis by insertion, four compared at a time; what the sweep lets through is decided exactly.

#pragma once

#include <algorithm>
#include <bit>
#include <emmintrin.h>
#include <limits>
#include <span>
#include <vector>

#include "poinsot/collision/collider.h"
#include "poinsot/collision/pair_list.h"

namespace poinsot::bench {

class Sweep {
 public:
  explicit Sweep(std::span<const Collider> colliders)
      : boxes_(colliders.size()),
        moves_(colliders.size(), true),
        order_(colliders.size()),
        pairs_(colliders.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<int>(i);
    for (auto* row : {&x_low_, &y_low_, &z_low_})
      row->assign(colliders.size() + 4, std::numeric_limits<float>::infinity());
    for (auto* row : {&x_high_, &y_high_, &z_high_})
      row->assign(colliders.size() + 4, -std::numeric_limits<float>::infinity());
  }

  void set_moves(int i, bool moves) { moves_[static_cast<std::size_t>(i)] = moves; }
  void set(int i, const Aabb& box) { boxes_[static_cast<std::size_t>(i)] = box; }

  std::span<const ColliderPair> pairs() {
    sort();
    for (std::size_t k = 0; k < order_.size(); ++k) sweep(k);
    pairs_.replace_all();
    return pairs_.pairs();
  }

 private:
  const Aabb& box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }

  void sort() {
    const auto before = [this](int a, int b) { return box(a).low[0] < box(b).low[0]; };
    if (!sorted_) std::sort(order_.begin(), order_.end(), before);
    sorted_ = true;
    for (std::size_t k = 1; k < order_.size(); ++k) {
      const int moved = order_[k];
      std::size_t at = k;
      for (; at > 0 && before(moved, order_[at - 1]); --at) order_[at] = order_[at - 1];
      order_[at] = moved;
    }
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const Aabb& b = box(order_[k]);
      x_low_[k] = static_cast<float>(b.low[0]);
      y_low_[k] = static_cast<float>(b.low[1]);
      z_low_[k] = static_cast<float>(b.low[2]);
      x_high_[k] = static_cast<float>(b.high[0]);
      y_high_[k] = static_cast<float>(b.high[1]);
      z_high_[k] = static_cast<float>(b.high[2]);
    }
  }

  void sweep(std::size_t k) {
    const __m128 y_low = _mm_set1_ps(y_low_[k]), y_high = _mm_set1_ps(y_high_[k]);
    const __m128 z_low = _mm_set1_ps(z_low_[k]), z_high = _mm_set1_ps(z_high_[k]);
    for (std::size_t j = k + 1; x_low_[j] <= x_high_[k]; j += 4) {
      const __m128 y = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&y_low_[j]), y_high),
                                  _mm_cmple_ps(y_low, _mm_loadu_ps(&y_high_[j])));
      const __m128 z = _mm_and_ps(_mm_cmple_ps(_mm_loadu_ps(&z_low_[j]), z_high),
                                  _mm_cmple_ps(z_low, _mm_loadu_ps(&z_high_[j])));
      auto hits = static_cast<unsigned>(_mm_movemask_ps(_mm_and_ps(y, z)));
      for (; hits != 0; hits &= hits - 1)
        meet(order_[k], j + static_cast<std::size_t>(std::countr_zero(hits)));
    }
  }
  void meet(int i, std::size_t k) {
    const int j = order_[k];
    if ((moves_[static_cast<std::size_t>(i)] || moves_[static_cast<std::size_t>(j)]) &&
        box(i).overlaps(box(j)))
      pairs_.found().push_back({std::min(i, j), std::max(i, j)});
  }

  std::vector<Aabb> boxes_;
  std::vector<bool> moves_;
  std::vector<int> order_;
  bool sorted_ = false;
  std::vector<float> x_low_, y_low_, z_low_, x_high_, y_high_, z_high_;  // in order
  PairList pairs_;
};

}  // namespace poinsot::bench
