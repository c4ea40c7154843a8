// What every verb of the command-line client is given, and what it gives back.

#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <string>

#include <CLI/CLI.hpp>

#include "poinsot/program/exit_code.h"
#include "poinsot/program/log.h"
#include "poinsot/program/options.h"

namespace poinsot {

// Which daemon to talk to, and how long to wait for it.
struct ConnectionFlags {
  BusFlags bus;
  std::string world;  // empty: the only one there is
  std::chrono::nanoseconds timeout = std::chrono::seconds(5);
};

struct Context {
  ConnectionFlags flags;
  Logger logger;
  // Ctrl-C and the like: what waits on the bus then throws Stopped, which ends the program with
  // ExitCode::ok, everything put away.
  std::stop_token stop;
};

// Does a verb's work, after its options have been read. Throws NoAnswer, Error or Stopped.
using Action = std::function<ExitCode(const Context&)>;

}  // namespace poinsot
