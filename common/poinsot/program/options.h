// Command lines of both executables: the options they share, typed values, and one way to fail.
//
// A faulty command line is told on stderr with the option's name, what is wrong and the nearest
// known word, and ends with ExitCode::usage. Help and version go to stdout and end with
// ExitCode::ok.

#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "poinsot/base/names.h"

namespace poinsot {

// "'wold' is not one of world, body, did you mean 'world'?".
std::string unknown_choice(std::string_view word, std::span<const std::string_view> names);
std::string joined(std::span<const std::string_view> names, std::string_view separator);

// Which bus: --domain N (environment: POINSOT_DOMAIN_ID), --listen local|lan, --partition NAME
// (POINSOT_PARTITION), --discovery-server ADDRESS:PORT (POINSOT_DISCOVERY_SERVER).
struct BusFlags {
  int domain = 77;               // DDS domain, 0 … 232
  bool lan = false;              // false: this host only
  std::string partition;         // empty: the default one
  std::string discovery_server;  // empty: none, participants greet each other
};
void add_bus_options(CLI::App& app, BusFlags& flags);

// -v, --verbose: once for more, twice for all.
void add_verbose_option(CLI::App& app, int& verbosity);

std::string_view program_version();  // "0.1.0"

// --version: "<name> <version>".
void add_version_option(CLI::App& app);

// Help texts with an option's names and its value's name, without the library's notes on checks,
// exclusions and environment. Before verbs are added, which inherit it.
void set_plain_help(CLI::App& app);

// Options whose values are vectors "x,y,z", orientations "x,y,z,w" and durations "0.5s"; see
// parse.h.
CLI::Option* add_vector_option(CLI::App& app, const std::string& name, Eigen::Vector3d& value,
                               const std::string& description);
CLI::Option* add_orientation_option(CLI::App& app, const std::string& name,
                                    Eigen::Quaterniond& value, const std::string& description);
CLI::Option* add_duration_option(CLI::App& app, const std::string& name,
                                 std::chrono::nanoseconds& value, const std::string& description);

// An option whose value is one of a table of names.
template <class Value>
CLI::Option* add_choice_option(CLI::App& app, const std::string& name, Value& value,
                               std::span<const Named<Value>> table,
                               const std::string& description) {
  std::vector<std::string_view> names;
  for (const Named<Value>& row : table) names.push_back(row.name);
  const auto read = [&value, table, name, names](const std::string& text) {
    const std::optional<Value> found = find_named<Value>(table, text);
    if (!found) throw CLI::ValidationError(name, unknown_choice(text, names));
    value = *found;
  };
  return app.add_option_function<std::string>(name, read, description)
      ->type_name(joined(names, "|"));
}

// Parses argv. Nothing: go on. A value: the process is to end with it; all has been said.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      std::ostream& out, std::ostream& err);

}  // namespace poinsot
