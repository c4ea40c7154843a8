// Command lines of both executables: the options they share, typed values, and one way to fail.
//
// A faulty command line is told on stderr with the option's name, what is wrong and the nearest
// known word, and ends with ExitCode::usage. Help and version go to stdout and end with
// ExitCode::ok.

#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

namespace poinsot {

// Which bus: --domain N (environment: POINSOT_DOMAIN_ID), --listen local|lan.
struct BusFlags {
  int domain = 77;   // DDS domain, 0 … 232
  bool lan = false;  // false: this host only
};
void add_bus_options(CLI::App& app, BusFlags& flags);

// -v, --verbose: once for more, twice for all.
void add_verbose_option(CLI::App& app, int& verbosity);

// --version: "<name> <version>".
void add_version_option(CLI::App& app);

// Options whose values are vectors "x,y,z" and durations "0.5s"; see parse.h.
CLI::Option* add_vector_option(CLI::App& app, const std::string& name, Eigen::Vector3d& value,
                               const std::string& description);
CLI::Option* add_duration_option(CLI::App& app, const std::string& name,
                                 std::chrono::nanoseconds& value, const std::string& description);

// Parses argv. Nothing: go on. A value: the process is to end with it; all has been said.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      std::ostream& out, std::ostream& err);

}  // namespace poinsot
