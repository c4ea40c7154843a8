#include "poinsot/collision/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <emmintrin.h>

namespace poinsot {
namespace {

// The tree is built anew when boxes have travelled this many sizes of their nodes, on average.
constexpr double kTravelPerBuild = 1.0;
// What one box may add to that [-]: it is no worse to be far away than to be elsewhere.
constexpr double kMostTravel = 2.0;

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

template <class F>
void each_bit(unsigned bits, F&& f) {
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

BoxTree::BoxTree(std::size_t boxes)
    : boxes_(boxes), item_(boxes), slot_of_(boxes), place_(boxes), travel_scale_(boxes) {
  for (std::size_t i = 0; i < boxes; ++i) item_[i] = slot_of_[i] = static_cast<std::int32_t>(i);
  if (boxes > 0) build();
}

void BoxTree::set(int i, const Aabb& box) {
  const std::size_t s = slot(i);
  note_travel(s, box);
  boxes_[s] = box;
  write(s);
}

void BoxTree::note_travel(std::size_t s, const Aabb& to) {
  const Aabb& from = boxes_[s];
  if (to.low[0] > to.high[0]) return;
  if (from.low[0] > from.high[0]) {
    travel_ += kMostTravel;
    return;
  }
  const double moved = 0.5 * (to.low + to.high - from.low - from.high).cwiseAbs().maxCoeff();
  const double sizes = moved * static_cast<double>(travel_scale_[s]);
  travel_ += std::min(sizes, kMostTravel);
}

void BoxTree::write(std::size_t s) {
  const Place place = place_[s];
  Node& node = nodes_[static_cast<std::size_t>(place.node)];
  const auto lane = static_cast<std::size_t>(place.lane);
  for (int k = 0; k < 3; ++k) {
    node.low[static_cast<std::size_t>(k)][lane] = static_cast<float>(boxes_[s].low[k] - origin_[k]);
    node.high[static_cast<std::size_t>(k)][lane] =
        static_cast<float>(boxes_[s].high[k] - origin_[k]);
  }
  mark(place.node);
}

void BoxTree::mark(std::int32_t node) {
  touched_[static_cast<std::size_t>(node) / 64] |= std::uint64_t{1} << (node % 64);
}

void BoxTree::update() {
  if (travel_ > kTravelPerBuild * static_cast<double>(boxes_.size())) {
    build();
  } else {
    refit();
  }
}

// Children come after their parents, so that one walk from the back sees every node once.
void BoxTree::refit() {
  for (std::size_t word = touched_.size(); word-- > 0;)
    while (touched_[word] != 0) {
      const auto bit = static_cast<std::size_t>(63 - std::countl_zero(touched_[word]));
      touched_[word] &= ~(std::uint64_t{1} << bit);
      const Node& node = nodes_[64 * word + bit];
      if (node.parent < 0) continue;
      const __m128 low = across(node.low, [](__m128 a, __m128 b) { return _mm_min_ps(a, b); });
      const __m128 high = across(node.high, [](__m128 a, __m128 b) { return _mm_max_ps(a, b); });
      alignas(16) std::array<float, 4> l, h;
      _mm_store_ps(l.data(), low);
      _mm_store_ps(h.data(), high);
      Node& parent = nodes_[static_cast<std::size_t>(node.parent)];
      const auto lane = static_cast<std::size_t>(node.lane);
      bool changed = false;
      for (std::size_t k = 0; k < 3; ++k) {
        changed |= parent.low[k][lane] != l[k] || parent.high[k][lane] != h[k];
        parent.low[k][lane] = l[k];
        parent.high[k][lane] = h[k];
      }
      if (changed) mark(node.parent);
    }
}

void BoxTree::emit(std::int32_t a, std::int32_t b, std::vector<ColliderPair>& pairs) const {
  const auto s = static_cast<std::size_t>(~a), t = static_cast<std::size_t>(~b);
  if (s == t || !overlap(boxes_[s], boxes_[t])) return;
  const int i = item_[s], j = item_[t];
  pairs.push_back({i < j ? i : j, i < j ? j : i});
}

void BoxTree::find(int i, std::vector<ColliderPair>& pairs) {
  tasks_[0] = {~static_cast<std::int32_t>(slot(i)), 0};
  run(1, pairs);
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
    run(tasks, pairs);
  }
}

void BoxTree::run(std::size_t tasks, std::vector<ColliderPair>& pairs) {
  const auto meet = [&](std::int32_t a, std::int32_t b) {
    if (a < 0 && b < 0) {
      emit(a, b, pairs);
    } else {
      tasks_[tasks++] = b < 0 ? Task{b, a} : Task{a, b};
    }
  };
  while (tasks > 0) {
    const auto [a, b] = tasks_[--tasks];
    const Node& right = nodes_[static_cast<std::size_t>(b)];
    if (a < 0) {
      const Place place = place_[static_cast<std::size_t>(~a)];
      const Box4 box = lane_of(nodes_[static_cast<std::size_t>(place.node)],
                               static_cast<std::size_t>(place.lane));
      each_bit(overlaps(right, box), [&](std::size_t d) { meet(a, right.child[d]); });
    } else {
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
}

}  // namespace poinsot
