#include "poinsot/wire/checks.h"

#include <algorithm>
#include <cstdio>

namespace poinsot {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

void Checks::number(double value, std::string_view name, double limit) {
  if (!ok()) return;
  if (!std::isfinite(value))
    reason_ = std::string(name) + " is not finite";
  else if (std::abs(value) > limit)
    reason_ = std::string(name) + " " + number_text(value) + " is beyond " + number_text(limit);
}

void Checks::vector(const Vec3& value, std::string_view name, double limit) {
  if (value.allFinite() && value.cwiseAbs().maxCoeff() <= limit)
    return;  // no text in the usual case
  constexpr std::array<std::string_view, 3> kAxes = {".x", ".y", ".z"};
  for (int i = 0; i < 3; ++i)
    number(value[i], std::string(name).append(kAxes[static_cast<std::size_t>(i)]), limit);
}

void Checks::unit(const Quat& value, std::string_view name) {
  if (std::abs(value.squaredNorm() - 1) <= kUnitSlack || !ok()) return;  // false for NaN as well
  reason_ =
      std::string(name) + " is not a unit quaternion (norm " + number_text(value.norm()) + ")";
}

// Source: Unicode 15, table 3-7 (well-formed byte sequences).
bool is_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto between = [&](std::size_t i, int low, int high) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  for (std::size_t i = 0; i < text.size();) {
    const int lead = byte(i);
    std::size_t length = 1;
    if (lead >= 0x80) {
      if (lead < 0xC2 || lead > 0xF4) return false;
      length = lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
      // The second byte's range excludes overlong forms, surrogates and what is beyond U+10FFFF.
      const int low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
      const int high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
      if (!between(i + 1, low, high)) return false;
      for (std::size_t k = 2; k < length; ++k)
        if (!between(i + k, 0x80, 0xBF)) return false;
    }
    i += length;
  }
  return true;
}

void Checks::text(std::string_view value, std::string_view name, std::size_t limit) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  require(value.size() <= limit,
          std::string(name) + " is longer than " + std::to_string(limit) + " bytes");
  require(is_utf8(value), std::string(name) + " is not UTF-8");
  require(std::none_of(value.begin(), value.end(), is_control),
          std::string(name) + " holds control characters");
}

}  // namespace poinsot
