// poinsot watch: poses as they come, as a live table, as lines or as JSON.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "poinsot/cli/context.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/wire/stream_name.h"

namespace poinsot {

struct WatchOptions {
  std::vector<std::string> bodies;  // empty: all that move
  std::string match;                // patterns of names; empty: all
  double rate = 0;                  // [Hz]; 0: every frame, and a readable rate for the table
  double deadband = 0;              // [m, rad]
  bool has_deadband = false;
  std::uint64_t count = 0;  // end after so many; 0: when asked
  bool json = false;
};

// What the daemon is asked for.
PoseFilter to_filter(const WatchOptions& options);

// The bodies of frames that hold only what moved: each where it was last.
class LastPoses {
 public:
  // `poses` becomes all that is known, in the order of slots.
  void complete(PoseSnapshot& poses);

 private:
  std::uint64_t session_ = 0;
  std::uint32_t epoch_ = 0;
  std::map<BodyId, BodyState> bodies_;
};

void add_watch_options(CLI::App& app, WatchOptions& options);
Action declare_watch(CLI::App& app);

}  // namespace poinsot
