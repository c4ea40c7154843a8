// poinsot delay: how old poses are when they are received, or how long a push takes to be seen.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "poinsot/cli/context.h"

namespace poinsot {

struct DelayOptions {
  std::string body;         // to push; empty: ages of poses
  std::uint64_t count = 0;  // frames or pushes; 0: when asked
  bool json = false;
};

// Ages of frames [s].
std::string age_text(const std::vector<double>& ages);
std::string age_json(const std::vector<double>& ages);

// From a push to the frame in which it is seen: in frames, and until it is received [s].
struct SeenPush {
  double frames = 0;
  double seconds = 0;
};
std::string seen_text(const std::vector<SeenPush>& pushes);
std::string seen_json(const std::vector<SeenPush>& pushes);

void add_delay_options(CLI::App& app, DelayOptions& options);
Action declare_delay(CLI::App& app);

}  // namespace poinsot
