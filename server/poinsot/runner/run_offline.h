// A run without a bus: frames as fast as they can be advanced, the same states as any other run of
// the scene without commands.

#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>

#include "poinsot/runner/run_summary.h"

namespace poinsot {

struct OfflineOptions {
  std::uint64_t frames = 0;               // 0: until stopped
  std::filesystem::path trajectory = {};  // empty: none
};

// Throws Error if the trajectory cannot be created, std::runtime_error if it cannot be written.
RunSummary run_offline(Scene scene, const OfflineOptions& options, std::stop_token stop);

}  // namespace poinsot
