// A state hash as people and files see it: 16 hexadecimal digits.

#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace poinsot {

inline constexpr std::size_t kHashDigits = 16;

inline std::string hash_text(std::uint64_t hash) {
  std::string text(kHashDigits, '0');
  for (std::size_t k = 0; k < kHashDigits; ++k)
    text[kHashDigits - 1 - k] = "0123456789abcdef"[hash >> (4 * k) & 15];
  return text;
}

inline std::optional<std::uint64_t> hash_from(std::string_view text) {
  std::uint64_t hash = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, hash, 16);
  if (text.size() != kHashDigits || error != std::errc() || stop != end) return std::nullopt;
  return hash;
}

}  // namespace poinsot
