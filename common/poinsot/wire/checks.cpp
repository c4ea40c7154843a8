#include "poinsot/wire/checks.h"

#include <cstdio>

#include "poinsot/base/utf8.h"

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

void Checks::text(std::string_view value, std::string_view name, std::size_t limit) {
  require(value.size() <= limit,
          std::string(name) + " is longer than " + std::to_string(limit) + " bytes");
  require(is_printable_utf8(value), std::string(name) + " is not printable UTF-8");
}

void Checks::lines(std::string_view value, std::string_view name, std::size_t limit) {
  require(value.size() <= limit,
          std::string(name) + " is longer than " + std::to_string(limit) + " bytes");
  require(are_printable_lines(value), std::string(name) + " is not printable UTF-8");
}

}  // namespace poinsot
