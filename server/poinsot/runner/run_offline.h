// A run without a bus: frames as fast as they can be advanced, the same states as any other run of
// the scene with the same commands.

#pragma once

#include <cstdint>
#include <filesystem>
#include <stop_token>

#include "poinsot/runner/run_summary.h"

namespace poinsot {

struct OfflineOptions {
  std::uint64_t frames = 0;               // 0: until stopped; with commands: until their log ends
  std::filesystem::path trajectory = {};  // empty: none
  // A command log that begins at frame 0: what it says is done to this scene; hashes are not
  // compared. What was done to the recorded run before the log began is not in it.
  std::filesystem::path commands = {};
  std::filesystem::path record = {};  // a command log to write; a file of this name is replaced
};

// Throws Error if a file cannot be read or created, std::runtime_error if one cannot be written.
RunSummary run_offline(Scene scene, const OfflineOptions& options, std::stop_token stop);

}  // namespace poinsot
