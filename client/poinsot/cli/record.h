// The log of a run: record (written by the daemon), replay (run again and compared).

#pragma once

#include "poinsot/cli/context.h"
#include "poinsot/protocol/run_control.h"

namespace poinsot {

struct RecordOptions {
  std::string name;
  bool stop = false;
  bool json = false;
};

void add_record_options(CLI::App& app, RecordOptions& options);

// Throws Error if neither or both are asked for.
RunControl to_control(const RecordOptions& options);

Action declare_record(CLI::App& app);
Action declare_replay(CLI::App& app);

}  // namespace poinsot
