// Slots of the tool's own: those of a user are numbers that are easy to type, those of drags follow
// from the body's name, so that a drag replaces the last one of the same body and of no other.

#pragma once

#include <cstdint>
#include <string_view>

namespace poinsot {

inline constexpr std::uint32_t kMaxUserSlot = 0x7FFFFFFF;

constexpr std::uint32_t drag_slot(std::string_view body) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  return hash | (kMaxUserSlot + 1);
}

constexpr bool is_drag_slot(std::uint32_t slot) {
  return slot > kMaxUserSlot;
}

}  // namespace poinsot
