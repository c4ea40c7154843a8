#include "poinsot/contact/elimination_order.h"

#include <algorithm>

namespace poinsot {
namespace {

constexpr int kNone = -1;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void EliminationOrder::load(std::span<const std::array<int, 2>> pairs) {
  const std::size_t n = order.size();
  start_.assign(n + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++start_[at(a) + 1];
    ++start_[at(b) + 1];
  }
  for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
  neighbours_.resize(2 * pairs.size());
  elements_.resize(2 * pairs.size());
  neighbour_count_.assign(n, 0);
  element_count_.assign(n, 0);
  for (const auto& [a, b] : pairs) {
    neighbours_[at(start_[at(a)] + neighbour_count_[at(a)]++)] = b;
    neighbours_[at(start_[at(b)] + neighbour_count_[at(b)]++)] = a;
  }
  front_start_.assign(n, 0);
  front_size_.assign(n, 0);
  head_.assign(n, kNone);
  next_.assign(n, kNone);
  previous_.assign(n, kNone);
  mark_.assign(n, kNone);
  outside_mark_.assign(n, kNone);
  outside_.assign(n, 0);
  absorbed_.assign(n, 0);
  degree_.assign(neighbour_count_.begin(), neighbour_count_.end());
  least_ = 0;
  left_ = static_cast<int>(n);
  for (int i = left_ - 1; i >= 0; --i) file_by_degree(i);
}

void EliminationOrder::file_by_degree(int node) {
  const int degree = degree_[at(node)];
  const int first = head_[at(degree)];
  next_[at(node)] = first;
  previous_[at(node)] = kNone;
  if (first != kNone) previous_[at(first)] = node;
  head_[at(degree)] = node;
  least_ = std::min(least_, degree);
}

void EliminationOrder::unfile(int node) {
  const int before = previous_[at(node)], after = next_[at(node)];
  if (before == kNone)
    head_[at(degree_[at(node)])] = after;
  else
    next_[at(before)] = after;
  if (after != kNone) previous_[at(after)] = before;
}

int EliminationOrder::take_least() {
  while (head_[at(least_)] == kNone) ++least_;
  const int node = head_[at(least_)];
  unfile(node);
  return node;
}

// What the node is coupled to when its turn comes: its own neighbours and the fronts of its
// elements, which it takes over.
void EliminationOrder::gather_front(int node) {
  front_start_[at(node)] = static_cast<int>(rows.size());
  mark_[at(node)] = node;
  const auto add = [&](int i) {
    if (mark_[at(i)] == node) return;
    mark_[at(i)] = node;
    rows.push_back(i);
  };
  const int from = start_[at(node)];
  for (int k = 0; k < neighbour_count_[at(node)]; ++k) add(neighbours_[at(from + k)]);
  for (int k = 0; k < element_count_[at(node)]; ++k) {
    const int element = elements_[at(from + k)];
    for (int q = 0; q < front_size_[at(element)]; ++q) add(rows[at(front_start_[at(element)] + q)]);
    absorbed_[at(element)] = 1;
  }
  front_size_[at(node)] = static_cast<int>(rows.size()) - front_start_[at(node)];
}

// Lists and degree of a node in the pivot's front.
void EliminationOrder::renew(int node, int pivot, int front_size) {
  const int from = start_[at(node)];
  int degree = front_size - 1;
  int kept = 0;
  for (int k = 0; k < element_count_[at(node)]; ++k) {
    const int element = elements_[at(from + k)];
    if (absorbed_[at(element)]) continue;
    if (outside_[at(element)] == 0) continue;  // its front lies within the pivot's
    elements_[at(from + kept++)] = element;
    degree += outside_[at(element)];
  }
  elements_[at(from + kept++)] = pivot;
  element_count_[at(node)] = kept;
  kept = 0;
  for (int k = 0; k < neighbour_count_[at(node)]; ++k) {
    const int neighbour = neighbours_[at(from + k)];
    if (mark_[at(neighbour)] == pivot) continue;  // known through the pivot from now on
    neighbours_[at(from + kept++)] = neighbour;
    ++degree;
  }
  neighbour_count_[at(node)] = kept;
  degree_[at(node)] = std::min(degree, left_ - 1);
}

void EliminationOrder::eliminate(int node) {
  gather_front(node);
  const int first = front_start_[at(node)], size = front_size_[at(node)];
  --left_;
  for (int q = 0; q < size; ++q) {
    const int i = rows[at(first + q)];
    for (int k = 0; k < element_count_[at(i)]; ++k) {
      const int element = elements_[at(start_[at(i)] + k)];
      if (absorbed_[at(element)]) continue;
      if (outside_mark_[at(element)] != node) {
        outside_mark_[at(element)] = node;
        outside_[at(element)] = front_size_[at(element)];
      }
      --outside_[at(element)];
    }
  }
  for (int q = 0; q < size; ++q) {
    const int i = rows[at(first + q)];
    unfile(i);
    renew(i, node, size);
    file_by_degree(i);
  }
}

void EliminationOrder::sort_rows() {
  for (std::size_t k = 0; k + 1 < column_start.size(); ++k) {
    const auto from = rows.begin() + column_start[k], to = rows.begin() + column_start[k + 1];
    std::transform(from, to, from, [&](int node) { return position[at(node)]; });
    std::sort(from, to);
  }
}

void EliminationOrder::compute(int nodes, std::span<const std::array<int, 2>> pairs) {
  order.resize(at(nodes));
  position.resize(at(nodes));
  column_start.assign(at(nodes) + 1, 0);
  rows.clear();
  load(pairs);
  for (int k = 0; k < nodes; ++k) {
    const int node = take_least();
    order[at(k)] = node;
    position[at(node)] = k;
    eliminate(node);
    column_start[at(k) + 1] = static_cast<int>(rows.size());
  }
  sort_rows();
}

}  // namespace poinsot
