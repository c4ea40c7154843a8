// A manual page, written from a program's verbs and options: roff with the macros of man(7).

#pragma once

#include <span>
#include <string>
#include <string_view>

#include "poinsot/program/command_tree.h"

namespace poinsot {

struct EnvironmentRow {
  std::string_view name;
  std::string_view meaning;
};

// What both executables read.
std::span<const EnvironmentRow> bus_environment();

// `see_also`: names of other pages, as "poinsotd(1)".
std::string man_page(const CommandTree& tree, std::string_view see_also);

}  // namespace poinsot
