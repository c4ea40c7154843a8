#include "poinsot/collision/pair_list.h"

#include <algorithm>
#include <limits>

namespace poinsot {
namespace {

// Fewer pairs than this share of the colliders are sorted by comparing, more by counting.
constexpr std::size_t kFew = 32;
// Room for so many pairs to a collider is there from the start.
constexpr std::size_t kPairsAtFirst = 16;

std::uint64_t key(const ColliderPair& pair) {
  return static_cast<std::uint64_t>(pair.a) << 32 | static_cast<std::uint64_t>(pair.b);
}

}  // namespace

PairList::PairList(std::size_t colliders) : rows_of_a_(colliders + 1), rows_of_b_(colliders + 1) {
  for (auto* list : {&pairs_, &found_, &scratch_}) list->reserve(kPairsAtFirst * colliders + 1);
}

void PairList::replace_all() {
  sort_found();
  pairs_.swap(found_);
  found_.clear();
}

void PairList::replace_touched(std::span<const unsigned char> touched) {
  sort_found();
  constexpr int kLast = std::numeric_limits<int>::max();
  found_.push_back({kLast, kLast});
  scratch_.resize(pairs_.size() + found_.size());
  const ColliderPair* next = found_.data();
  ColliderPair* out = scratch_.data();
  for (const ColliderPair pair : pairs_) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if ((touched[a] | touched[b]) != 0) continue;
    while (key(*next) < key(pair)) *out++ = *next++;
    *out++ = pair;
  }
  const ColliderPair* const end = &found_.back();
  out = std::copy(next, end, out);
  scratch_.resize(static_cast<std::size_t>(out - scratch_.data()));
  pairs_.swap(scratch_);
  found_.clear();
}

// Counted by b, then, keeping that order, by a.
void PairList::sort_found() {
  if (found_.size() * kFew < rows_of_a_.size()) {
    std::sort(found_.begin(), found_.end());
    return;
  }
  std::fill(rows_of_a_.begin(), rows_of_a_.end(), 0);
  std::fill(rows_of_b_.begin(), rows_of_b_.end(), 0);
  for (const ColliderPair& pair : found_) {
    ++rows_of_a_[static_cast<std::size_t>(pair.a) + 1];
    ++rows_of_b_[static_cast<std::size_t>(pair.b) + 1];
  }
  for (std::size_t i = 1; i < rows_of_a_.size(); ++i) {
    rows_of_a_[i] += rows_of_a_[i - 1];
    rows_of_b_[i] += rows_of_b_[i - 1];
  }
  scratch_.resize(found_.size());
  for (const ColliderPair& pair : found_)
    scratch_[rows_of_b_[static_cast<std::size_t>(pair.b)]++] = pair;
  for (const ColliderPair& pair : scratch_)
    found_[rows_of_a_[static_cast<std::size_t>(pair.a)]++] = pair;
}

}  // namespace poinsot
