#include "poinsot/contact/contact_colors.h"

#include <array>
#include <bit>

namespace poinsot {

void ContactColors::assign(std::span<const ColorPair> pairs, int bodies) {
  used_.assign(static_cast<std::size_t>(bodies), 0);
  color_.resize(pairs.size());
  order_.resize(pairs.size());
  std::array<std::size_t, kColors + 1> counts = {};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [a, b] = pairs[k];
    const bool held = a < 0 || b < 0;
    std::uint64_t taken = 0;
    if (a >= 0) taken |= used_[static_cast<std::size_t>(a)];
    if (b >= 0) taken |= used_[static_cast<std::size_t>(b)];
    // The lowest or highest bit that is free; kColors if none is.
    int color = held ? kColors - 1 - std::countl_one(taken) : std::countr_one(taken);
    if (color < 0) color = kColors;
    color_[k] = static_cast<std::uint8_t>(color);
    ++counts[static_cast<std::size_t>(color)];
    if (color == kColors) continue;
    const std::uint64_t bit = std::uint64_t{1} << color;
    if (a >= 0) used_[static_cast<std::size_t>(a)] |= bit;
    if (b >= 0) used_[static_cast<std::size_t>(b)] |= bit;
  }
  starts_.assign(1, 0);
  std::array<std::size_t, kColors + 1> next = {};
  for (std::size_t color = 0; color <= kColors; ++color) {
    next[color] = starts_.back();
    if (color < kColors && counts[color] > 0) starts_.push_back(starts_.back() + counts[color]);
  }
  for (std::size_t k = 0; k < counts[kColors]; ++k) starts_.push_back(starts_.back() + 1);
  for (std::size_t k = 0; k < pairs.size(); ++k) order_[next[color_[k]]++] = static_cast<int>(k);
}

}  // namespace poinsot
