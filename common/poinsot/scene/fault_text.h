// What the texts of validate()'s faults share. Private to this module.

#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "poinsot/math/types.h"

namespace poinsot {

inline constexpr double kMagnitude = 1e12;  // SI; lengths and speeds beyond it are slips of the pen

inline std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

inline std::string in_quotes(std::string_view text) {
  return std::string("'").append(text).append("'");
}

inline bool is_within(const Vec3& v, double limit) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= limit;
}

// Of a coefficient that must be ≥ 0; empty if it is good.
inline std::string coefficient_fault(std::string_view what, double value, std::string_view unit) {
  if (value >= 0 && value <= kMagnitude) return {};
  return std::string(what) + " must be 0 to " + digits(kMagnitude) + " " + std::string(unit) +
         ", is " + digits(value);
}

}  // namespace poinsot
