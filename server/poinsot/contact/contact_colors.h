// Colours of contacts: no movable body is twice in a colour, so those of one colour can be solved
// in any order, or at once.
//
// Greedy in the order given, from nothing each time: a colouring has no history. Contacts with an
// immovable body fill colours from the last one down: solved last, they hold best. Those for which
// no colour is left come after all others and are to be solved one by one.

#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace poinsot {

// Two bodies of a contact; −1: immovable.
struct ColorPair {
  int a, b;
};

class ContactColors {
 public:
  static constexpr int kColors = 64;

  // Groups of contacts: one per colour that is in use, and of one contact each if no colour was
  // left for it.
  void assign(std::span<const ColorPair> pairs, int bodies);

  // Of a movable body, up to kColors of them; 0 of others.
  int contacts_of(int body) const { return std::popcount(used_[static_cast<std::size_t>(body)]); }

  std::size_t groups() const { return starts_.size() - 1; }
  std::span<const int> group(std::size_t k) const {
    return std::span(order_).subspan(starts_[k], starts_[k + 1] - starts_[k]);
  }

 private:
  std::vector<std::uint64_t> used_;  // colours of each body
  std::vector<std::uint8_t> color_;  // of each contact; kColors: none
  std::vector<int> order_;
  std::vector<std::size_t> starts_ = {0};
};

}  // namespace poinsot
