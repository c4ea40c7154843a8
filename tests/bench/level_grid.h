// A hierarchical uniform grid as a broad phase, for comparison: a level to each octave of size, the
// cells of all levels in one hash table. A box lies in the cell of its low corner, on the level
// whose cells are as large as it or larger.

#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "poinsot/collision/collider.h"
#include "poinsot/collision/pair_list.h"

namespace poinsot::bench {

class LevelGrid {
 public:
  explicit LevelGrid(std::span<const Collider> colliders)
      : items_(colliders.size()), is_set_(colliders.size(), 0), pairs_(colliders.size()) {
    std::size_t size = 64;
    while (size < 2 * colliders.size()) size *= 2;
    head_.assign(size, -1);
    mask_ = size - 1;
  }

  void set_moves(int i, bool moves) { items_[index(i)].moves = moves; }

  void set(int i, const Aabb& box) {
    Item& item = items_[index(i)];
    item.box = box;
    if (!is_set_[index(i)]) list_.push_back(i);
    is_set_[index(i)] = 1;
    Cell cell;
    cell.level = std::ilogb((box.high - box.low).maxCoeff()) + 1;
    for (int k = 0; k < 3; ++k) cell.at[k] = coordinate(box.low[k], cell.level);
    if (item.placed && cell == item.cell) return;
    if (item.placed) unlink(i);
    item.cell = cell;
    item.placed = true;
    link(i);
  }

  std::span<const ColliderPair> pairs() {
    all_ = list_.size() == items_.size();
    std::sort(list_.begin(), list_.end());
    for (const int i : list_) query(i);
    if (all_) {
      pairs_.replace_all();
    } else {
      pairs_.replace_touched(is_set_);
    }
    for (const int i : list_) is_set_[index(i)] = 0;
    list_.clear();
    return pairs_.pairs();
  }

 private:
  struct Cell {
    int level = 0, at[3] = {0, 0, 0};
    bool operator==(const Cell&) const = default;
  };
  struct Item {
    Aabb box;
    Cell cell;
    int next = -1, previous = -1;
    bool placed = false, moves = true;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static int coordinate(double x, int level) {
    return static_cast<int>(std::floor(std::ldexp(x, -level)));
  }
  std::size_t bucket(const Cell& cell) const {
    std::uint64_t h = static_cast<std::uint32_t>(cell.level);
    for (const int x : cell.at) h = (h ^ static_cast<std::uint32_t>(x)) * 0x9E3779B97F4A7C15u;
    return (h >> 32) & mask_;
  }
  void link(int i) {
    Item& item = items_[index(i)];
    int& head = head_[bucket(item.cell)];
    item.next = head;
    item.previous = -1;
    if (head >= 0) items_[index(head)].previous = i;
    head = i;
    ++count_[level_index(item.cell.level)];
  }
  void unlink(int i) {
    const Item& item = items_[index(i)];
    (item.previous >= 0 ? items_[index(item.previous)].next : head_[bucket(item.cell)]) = item.next;
    if (item.next >= 0) items_[index(item.next)].previous = item.previous;
    --count_[level_index(item.cell.level)];
  }
  static std::size_t level_index(int level) { return static_cast<std::size_t>(level + 32); }

  void query(int i) {
    const Aabb box = items_[index(i)].box;
    // With all boxes set, those of finer levels look up this one.
    for (int level = all_ ? items_[index(i)].cell.level : -32; level < 32; ++level) {
      if (count_[level_index(level)] == 0) continue;
      int low[3], high[3];
      double cells = 1;
      for (int k = 0; k < 3; ++k) {
        low[k] = coordinate(box.low[k], level) - 1;
        high[k] = coordinate(box.high[k], level);
        cells *= high[k] - low[k] + 1.0;
      }
      if (cells > static_cast<double>(items_.size())) {  // fewer boxes than cells
        for (std::size_t j = 0; j < items_.size(); ++j)
          if (items_[j].cell.level == level) meet(i, static_cast<int>(j), box);
        continue;
      }
      Cell cell;
      cell.level = level;
      for (cell.at[2] = low[2]; cell.at[2] <= high[2]; ++cell.at[2])
        for (cell.at[1] = low[1]; cell.at[1] <= high[1]; ++cell.at[1])
          for (cell.at[0] = low[0]; cell.at[0] <= high[0]; ++cell.at[0])
            for (int j = head_[bucket(cell)]; j >= 0; j = items_[index(j)].next)
              if (items_[index(j)].cell == cell) meet(i, j, box);
    }
  }
  void meet(int i, int j, const Aabb& box) {
    const Item& other = items_[index(j)];
    const bool coarser = all_ && other.cell.level > items_[index(i)].cell.level;
    if ((j > i || coarser || (j < i && !is_set_[index(j)])) &&
        (other.moves || items_[index(i)].moves) && box.overlaps(other.box))
      pairs_.found().push_back({std::min(i, j), std::max(i, j)});
  }

  std::vector<Item> items_;
  std::vector<unsigned char> is_set_;
  std::vector<int> list_, head_;
  std::size_t mask_ = 0;
  bool all_ = false;             // boxes were set
  std::array<int, 64> count_{};  // of boxes, per level
  PairList pairs_;
};

}  // namespace poinsot::bench
