// Who may include whom: the table of the house as data, and the check of one file against it.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace poinsot {

// Modules are named by their folder; "server_main", "client_main" and "examples" are the programs.
struct ModuleRule {
  std::string_view module;
  std::string_view may_include;  // modules, apart by spaces
  std::string_view libraries;    // third parties, apart by spaces; Eigen is allowed everywhere
  std::string_view never;        // standard headers that it must not use
};

// A third party: the include prefixes by which it is known.
struct LibraryRule {
  std::string_view library;
  std::string_view prefixes;  // apart by spaces
  std::string_view files;     // if not empty: only in files of these stems (a '*' ends a prefix)
};

const std::vector<ModuleRule>& module_rules();
const std::vector<LibraryRule>& library_rules();

// The module of a path relative to the source tree; empty if the path belongs to none.
std::string module_of(std::string_view path);

// One line "path:line: what" for each #include of `text` that the table does not allow.
std::vector<std::string> violations(std::string_view path, std::string_view text);

}  // namespace poinsot
