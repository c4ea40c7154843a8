#include "poinsot/runner/base64.h"

#include <array>
#include <cstdint>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t kNoLetter = 64;

constexpr std::array<std::uint8_t, 256> values_of_letters() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoLetter);
  for (std::size_t k = 0; k < kLetters.size(); ++k)
    values[static_cast<unsigned char>(kLetters[k])] = static_cast<std::uint8_t>(k);
  return values;
}
constexpr std::array<std::uint8_t, 256> kValues = values_of_letters();

[[noreturn]] void fail() {
  throw Error("not base64");
}

}  // namespace

std::string to_base64(std::span<const std::byte> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (; !bytes.empty(); bytes = bytes.subspan(bytes.size() < 3 ? bytes.size() : 3)) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= bytes.size() ? kLetters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::vector<std::byte> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) fail();
  std::vector<std::byte> bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (; !text.empty(); text.remove_prefix(4)) {
    const bool is_last = text.size() == 4;
    const std::size_t padding = !is_last || text[3] != '=' ? 0 : text[2] != '=' ? 1 : 2;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t value =
          k < 4 - padding ? kValues[static_cast<unsigned char>(text[k])] : 0;
      if (value == kNoLetter) fail();
      bits = bits << 6 | value;
    }
    if ((bits & ((1u << (8 * padding)) - 1)) != 0) fail();  // bits that no byte takes
    for (std::size_t k = 0; k < 3 - padding; ++k)
      bytes.push_back(static_cast<std::byte>(bits >> (16 - 8 * k) & 0xff));
  }
  return bytes;
}

}  // namespace poinsot
