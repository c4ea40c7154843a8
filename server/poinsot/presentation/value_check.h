// Checks of single values that came from outside, and the words for what is wrong with them.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "poinsot/math/types.h"
#include "poinsot/protocol/result.h"

namespace poinsot {

// Why something is not done: the code and the reason in words, with the value received.
struct Refusal {
  ResultCode code = ResultCode::invalid_value;
  std::string reason;
};

inline Refusal invalid(std::string reason) {
  return {ResultCode::invalid_value, std::move(reason)};
}

std::string text(double x);
std::string text(const Vec3& v);

// Every component must be finite and at most `limit` in size.
std::optional<Refusal> check_vector(std::string_view what, const Vec3& v, std::string_view unit,
                                    double limit);
// Must be 0 to `limit`.
std::optional<Refusal> check_coefficient(std::string_view what, double x, std::string_view unit,
                                         double limit);

template <class Enum>
std::optional<Refusal> check_enumerator(std::string_view what, Enum value, Enum last) {
  if (value <= last) return std::nullopt;
  return invalid(std::string(what) + " is " + std::to_string(static_cast<int>(value)) +
                 ": the largest known value is " + std::to_string(static_cast<int>(last)));
}

}  // namespace poinsot
