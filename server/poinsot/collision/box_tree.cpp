#include "poinsot/collision/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <emmintrin.h>
#include <limits>

namespace poinsot {
namespace {

// The tree is built anew when searching a decayed one has cost about as much as building. What a
// search of all boxes costs grows with their mean travel, in sizes of their nodes: by half after
// one. Building costs twice a search.
constexpr double kDebtPerBuild = 2.0;  // [-] per box
// What one box may have travelled at once [-]: it is no worse to be far away than to be elsewhere.
constexpr double kMostTravel = 4.0;
// Room for the tasks of any tree but a freak.
constexpr std::size_t kTasksAtFirst = 2048;
// What was set is fetched so many leaves ahead: it lies anywhere.
constexpr std::size_t kAhead = 12;
// From this share of boxes on, pairing all with all is cheaper than each that has changed with all.
constexpr std::size_t kAllAtOnce = 3;

// Finite, so that nothing overlaps a lane without a child.
float single(double x) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -kLargest, kLargest));
}

struct Box4 {
  __m128 low[3], high[3];  // the same box in all lanes
};

template <class Node>
Box4 lane_of(const Node& node, std::size_t lane) {
  Box4 box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = _mm_set1_ps(node.low[k][lane]);
    box.high[k] = _mm_set1_ps(node.high[k][lane]);
  }
  return box;
}

// A bit per lane of the node that overlaps the box.
template <class Node>
unsigned overlaps(const Node& node, const Box4& box) {
  __m128 all = _mm_and_ps(_mm_cmple_ps(_mm_load_ps(node.low[0].data()), box.high[0]),
                          _mm_cmple_ps(box.low[0], _mm_load_ps(node.high[0].data())));
  for (std::size_t k = 1; k < 3; ++k) {
    all = _mm_and_ps(all, _mm_cmple_ps(_mm_load_ps(node.low[k].data()), box.high[k]));
    all = _mm_and_ps(all, _mm_cmple_ps(box.low[k], _mm_load_ps(node.high[k].data())));
  }
  return static_cast<unsigned>(_mm_movemask_ps(all));
}

template <class Bits, class F>
void each_bit(Bits bits, F&& f) {
  for (; bits != 0; bits &= bits - 1) f(static_cast<std::size_t>(std::countr_zero(bits)));
}

bool overlap(const Aabb& a, const Aabb& b) {
  const __m128d x =
      _mm_and_pd(_mm_cmple_pd(_mm_loadu_pd(a.low.data()), _mm_loadu_pd(b.high.data())),
                 _mm_cmple_pd(_mm_loadu_pd(b.low.data()), _mm_loadu_pd(a.high.data())));
  const __m128d z = _mm_cmple_pd(_mm_set_pd(a.low[2], b.low[2]), _mm_set_pd(b.high[2], a.high[2]));
  return _mm_movemask_pd(_mm_and_pd(x, z)) == 3;
}

// x, y, z, - of the least or the largest of four lanes.
template <class Combine>
__m128 across(const std::array<std::array<float, 4>, 3>& rows, Combine&& combine) {
  __m128 x = _mm_load_ps(rows[0].data()), y = _mm_load_ps(rows[1].data());
  __m128 z = _mm_load_ps(rows[2].data()), w = z;
  _MM_TRANSPOSE4_PS(x, y, z, w);
  return combine(combine(x, y), combine(z, w));
}

}  // namespace

BoxTree::BoxTree(std::span<const int> group)
    : items_(group.size()), leaves_(group.size()), travel_scale_(group.size()) {
  for (std::size_t i = 0; i < group.size(); ++i) {
    leaves_[i].item = items_[i].slot = static_cast<std::int32_t>(i);
    leaves_[i].group = group[i];
  }
  changed_.resize(leaves_.size());
  loose_.resize(leaves_.size());
  tasks_.reserve(kTasksAtFirst);
  if (!leaves_.empty()) build();
}

void BoxTree::set(int i, const Aabb& box) {
  Item& item = items_[static_cast<std::size_t>(i)];
  item.box = box;
  change(item);
}

void BoxTree::set_idle(int i, bool idle) {
  Item& item = items_[static_cast<std::size_t>(i)];
  item.idle = idle;
  change(item);
}

void BoxTree::change(const Item& item) {
  const auto s = static_cast<std::size_t>(item.slot);
  changes_ += !changed_.test(s);
  changed_.set(s);
}

// In the order of the leaves, not of the calls: large trees do not fit into the cache.
void BoxTree::take_up() {
  changed_.each([this](std::size_t s) {
    const std::size_t soon = std::min(s + kAhead, leaves_.size() - 1);
    __builtin_prefetch(&items_[static_cast<std::size_t>(leaves_[soon].item)]);
    Leaf& leaf = leaves_[s];
    const Item& item = items_[static_cast<std::size_t>(leaf.item)];
    note_travel(s, item.box);
    leaf.box = item.box;
    leaf.idle = item.idle;
    write(leaf);
    loose_.set(static_cast<std::size_t>(leaf.node));
  });
}

void BoxTree::note_travel(std::size_t s, const Aabb& to) {
  const Aabb& from = leaves_[s].box;
  if (to.low[0] > to.high[0]) return;
  if (from.low[0] > from.high[0]) {
    travel_ += kMostTravel;
    return;
  }
  double moved = 0;
  for (Eigen::Index k = 0; k < 3; ++k)
    moved = std::max(moved, std::abs(to.low[k] - from.low[k] + (to.high[k] - from.high[k])));
  const double sizes = 0.5 * moved * static_cast<double>(travel_scale_[s]);
  travel_ += sizes < kMostTravel ? sizes : kMostTravel;  // huge boxes may give no number
}

void BoxTree::write(const Leaf& leaf) {
  Node& node = nodes_[static_cast<std::size_t>(leaf.node)];
  const auto lane = static_cast<std::size_t>(leaf.lane);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    node.low[k][lane] = single(leaf.box.low[axis] - origin_[axis]);
    node.high[k][lane] = single(leaf.box.high[axis] - origin_[axis]);
  }
}

// Children come after their parents: one walk from the back sees each loose node once, after all
// under it.
void BoxTree::refit() {
  loose_.drain_backwards([this](std::size_t node) { refit(node); });
}

void BoxTree::refit(std::size_t index) {
  const Node& node = nodes_[index];
  if (node.parent < 0) return;
  Node& parent = nodes_[static_cast<std::size_t>(node.parent)];
  const auto lane = static_cast<std::size_t>(node.lane);
  alignas(16) std::array<float, 4> low, high;
  _mm_store_ps(low.data(), across(node.low, _mm_min_ps));
  _mm_store_ps(high.data(), across(node.high, _mm_max_ps));
  bool same = true;
  for (std::size_t k = 0; k < 3; ++k) {
    same &= parent.low[k][lane] == low[k] && parent.high[k][lane] == high[k];
    parent.low[k][lane] = low[k];
    parent.high[k][lane] = high[k];
  }
  if (!same) loose_.set(static_cast<std::size_t>(node.parent));
}

bool BoxTree::find_changed(std::vector<ColliderPair>& pairs) {
  take_up();
  const auto n = static_cast<double>(leaves_.size());
  debt_ += travel_ / n * static_cast<double>(changes_);
  if (debt_ > kDebtPerBuild * n) build();
  refit();
  const bool all = changes_ * kAllAtOnce > leaves_.size();
  if (all) {
    find_all(pairs);
  } else {
    changed_.each([&](std::size_t s) { find(s, pairs); });
  }
  changed_.clear();
  changes_ = 0;
  return all;
}

void BoxTree::emit(std::int32_t a, std::int32_t b, std::vector<ColliderPair>& pairs) const {
  const Leaf& s = leaves_[static_cast<std::size_t>(~a)];
  const Leaf& t = leaves_[static_cast<std::size_t>(~b)];
  if (s.group == t.group || (s.idle && t.idle) || !overlap(s.box, t.box)) return;
  pairs.push_back({std::min(s.item, t.item), std::max(s.item, t.item)});
}

void BoxTree::find_all(std::vector<ColliderPair>& pairs) {
  for (const Node& node : nodes_) {
    std::size_t tasks = 0;
    for (std::size_t c = 0; c + 1 < kWidth; ++c) {
      const unsigned later = 0xEu << c & 0xFu;
      each_bit(overlaps(node, lane_of(node, c)) & later, [&](std::size_t d) {
        const std::int32_t a = node.child[c], b = node.child[d];
        if (a < 0 && b < 0) {
          emit(a, b, pairs);
        } else {
          tasks_[tasks++] = b < 0 ? Task{b, a} : Task{a, b};
        }
      });
    }
    find_between(tasks, pairs);
  }
}

void BoxTree::find_between(std::size_t tasks, std::vector<ColliderPair>& pairs) {
  Task* const stack = tasks_.data();
  const auto meet = [&](std::int32_t a, std::int32_t b) {
    if (a < 0 && b < 0) {
      emit(a, b, pairs);
    } else {
      stack[tasks++] = b < 0 ? Task{b, a} : Task{a, b};
    }
  };
  while (tasks > 0) {
    const auto [a, b] = stack[--tasks];
    const Node& right = nodes_[static_cast<std::size_t>(b)];
    if (a < 0) {
      const Leaf& leaf = leaves_[static_cast<std::size_t>(~a)];
      const Box4 box = lane_of(nodes_[static_cast<std::size_t>(leaf.node)], leaf.lane);
      each_bit(overlaps(right, box), [&](std::size_t d) { meet(a, right.child[d]); });
      continue;
    }
    const Node& left = nodes_[static_cast<std::size_t>(a)];
    const Box4 whole = lane_of(nodes_[static_cast<std::size_t>(right.parent)],
                               static_cast<std::size_t>(right.lane));
    each_bit(overlaps(left, whole), [&](std::size_t c) {
      const std::int32_t child = left.child[c];
      each_bit(overlaps(right, lane_of(left, c)),
               [&](std::size_t d) { meet(child, right.child[d]); });
    });
  }
}

// A pair of two that have changed is that of the first.
void BoxTree::find(std::size_t s, std::vector<ColliderPair>& pairs) {
  const auto self = static_cast<std::int32_t>(s);
  const Leaf& leaf = leaves_[s];
  const Box4 box = lane_of(nodes_[static_cast<std::size_t>(leaf.node)], leaf.lane);
  Task* const stack = tasks_.data();
  std::size_t tasks = 0;
  std::int32_t index = 0;
  for (;;) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    each_bit(overlaps(node, box), [&](std::size_t d) {
      const std::int32_t child = node.child[d];
      if (child >= 0) {
        stack[tasks++].b = child;
      } else if (~child > self || !changed_.test(static_cast<std::size_t>(~child))) {
        emit(~self, child, pairs);
      }
    });
    if (tasks == 0) return;
    index = stack[--tasks].b;
  }
}

}  // namespace poinsot
