// poinsot watch: poses as they come, as a live table, as lines or as JSON.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "poinsot/cli/context.h"

namespace poinsot {

struct WatchOptions {
  std::vector<std::string> bodies;  // empty: all that move
  double rate = 0;                  // [Hz]; 0: every frame, and a readable rate for the table
  std::uint64_t count = 0;          // end after so many; 0: when asked
  bool json = false;
};

void add_watch_options(CLI::App& app, WatchOptions& options);
Action declare_watch(CLI::App& app);

}  // namespace poinsot
