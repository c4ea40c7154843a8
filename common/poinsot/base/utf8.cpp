#include "poinsot/base/utf8.h"

#include <algorithm>

namespace poinsot {
namespace {

// Length of the well-formed printable character at the start of `text`; 0 if there is none.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7F ? 1 : 0;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  const std::size_t length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  // The second byte's range excludes C1 controls, overlong forms, surrogates, beyond U+10FFFF.
  const unsigned low = lead == 0xC2 || lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t k = 2; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  return length;
}

}  // namespace

bool is_printable_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

bool are_printable_lines(std::string_view text) {
  return to_printable_lines(text) == text;
}

std::string to_printable_lines(std::string_view text) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t length = text[0] == '\n' ? 1 : character_length(text);
    if (length == 0)
      lines += '?';
    else
      lines += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return lines;
}

}  // namespace poinsot
