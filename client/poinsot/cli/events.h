// poinsot events: impacts as they happen, as lines or as JSON.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "poinsot/cli/context.h"

namespace poinsot {

struct EventsOptions {
  std::vector<std::string> bodies;  // of which one must take part; empty: any
  std::uint64_t count = 0;          // end after so many; 0: when asked
  bool json = false;
};

void add_events_options(CLI::App& app, EventsOptions& options);
Action declare_events(CLI::App& app);

}  // namespace poinsot
