// Names: look-up in a table, and the nearest known name to a misspelt one.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace poinsot {

// One row of a name table: what a user writes for a value of a closed set.
template <class Value>
struct Named {
  std::string_view name;
  Value value;
};

template <class Value>
constexpr std::optional<Value> find_named(std::span<const Named<Value>> table,
                                          std::string_view name) {
  for (const auto& row : table)
    if (row.name == name) return row.value;
  return std::nullopt;
}

template <class Value>
constexpr std::string_view name_of(std::span<const Named<Value>> table, Value value) {
  for (const auto& row : table)
    if (row.value == value) return row.name;
  return "?";
}

// Number of single-character edits (insert, delete, replace, swap of neighbours) between a and b.
// Source: the optimal string alignment distance (Damerau 1964).
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate with the fewest edits from `name`; empty when none is near (more than half of the
// name would change). Ties go to the first.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

// ", did you mean 'x'?" or nothing: the tail of an error message.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace poinsot
