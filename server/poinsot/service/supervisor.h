// Supervisor: runs a program as a child and starts it again when it fails. What it is told (SIGINT,
// SIGTERM, SIGHUP) it tells the child and waits for its end. The child ends with the supervisor.

#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "poinsot/program/log.h"

namespace poinsot {

struct Supervision {
  std::vector<std::string> first;  // the command line, first[0] is the program's path
  std::vector<std::string> again;  // the same after a failure
  // More failures than that within the time, and the supervisor gives up.
  int failures = 5;
  std::chrono::seconds within{10};
};

// Returns the exit code of the child when it ended well (0), by its own mistake (ExitCode::usage
// of the first: again would not help) or because it was told to; ExitCode::failure after too many
// failures. Called before there is any thread, with the signals blocked as StopSignals does.
int supervise(const Supervision& supervision, const Logger& logger);

}  // namespace poinsot
