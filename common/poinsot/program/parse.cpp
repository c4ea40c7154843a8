#include "poinsot/program/parse.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "poinsot/base/error.h"
#include "poinsot/base/names.h"

namespace poinsot {
namespace {

constexpr std::array<Named<double>, 6> kTimeUnits = {{
    {"s", 1e9},
    {"ms", 1e6},
    {"us", 1e3},
    {"ns", 1},
    {"min", 60e9},
    {"h", 3600e9},
}};

// Below 2^63 ns, with room for rounding: 292 years.
constexpr double kMaxNanoseconds = 9.2e18;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// Reads a number at the front of `text` and removes it; the locale plays no part.
std::optional<double> take_number(std::string_view& text) {
  std::string_view rest = text;
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc()) return std::nullopt;
  text = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return value;
}

// N finite numbers with commas between them. `expected`: what it should have been, with an example.
template <std::size_t N>
std::array<double, N> parse_numbers(std::string_view text, std::string_view expected) {
  std::array<double, N> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = i + 1 < N ? rest.find(',') : rest.size();
    std::string_view word = trimmed(rest.substr(0, comma));
    const std::optional<double> value = take_number(word);
    if (comma == std::string_view::npos || !value || !word.empty())
      throw Error("'" + std::string(text) + "' is not " + std::string(expected));
    if (!std::isfinite(*value)) throw Error("'" + std::string(text) + "' is not finite");
    numbers[i] = *value;
    if (i + 1 < N) rest.remove_prefix(comma + 1);
  }
  return numbers;
}

}  // namespace

Eigen::Vector3d parse_vector(std::string_view text) {
  const auto v = parse_numbers<3>(text, "a vector: expected three numbers x,y,z, like 0,0,50");
  return {v[0], v[1], v[2]};
}

Eigen::Quaterniond parse_orientation(std::string_view text) {
  const auto q =
      parse_numbers<4>(text, "a quaternion: expected four numbers x,y,z,w, like 0,0,0,1");
  const Eigen::Quaterniond orientation(q[3], q[0], q[1], q[2]);
  if (!(orientation.squaredNorm() > 0)) throw Error("'" + std::string(text) + "' is no rotation");
  return orientation.normalized();
}

std::chrono::nanoseconds parse_duration(std::string_view text) {
  std::string_view unit = trimmed(text);
  const std::optional<double> value = take_number(unit);
  unit = trimmed(unit);
  const std::optional<double> scale = unit.empty() ? 1e9 : find_named<double>(kTimeUnits, unit);
  if (!value || !scale)
    throw Error("'" + std::string(text) +
                "' is not a duration: expected a number with s, ms, us, ns, min or h, like 0.5s");
  const double nanoseconds = *value * *scale;
  if (!(nanoseconds >= 0)) throw Error("'" + std::string(text) + "' is a negative duration");
  if (!(nanoseconds < kMaxNanoseconds)) throw Error("'" + std::string(text) + "' is too long");
  return std::chrono::nanoseconds(std::llround(nanoseconds));
}

}  // namespace poinsot
