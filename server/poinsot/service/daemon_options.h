// What a daemon is told beside its scene.

#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "poinsot/service/clients.h"
#include "poinsot/wire/participant.h"

namespace poinsot {

struct DaemonOptions {
  int domain = kDefaultDomain;        // DDS domain
  bool lan = false;                   // false: this host only
  std::string partition = {};         // see BusOptions
  std::string discovery_server = {};  // see BusOptions
  std::string world = {};             // name on the bus; empty: the scene's
  bool take_over = false;             // even if another daemon serves this world
  double scale = 1;                   // simulated / wall time; 0: as fast as frames can be advanced
  bool paused = false;                // wait for resume or step
  std::uint64_t frames = 0;           // end after so many; 0: when asked
  std::string client = "poinsot";     // how a shell calls the client, see client_command.h
  std::filesystem::path trajectory = {};   // empty: none
  std::filesystem::path data = {};         // where the store is; empty: Store's default
  std::string restore = {};                // name of a checkpoint to begin with; see kLatest
  std::string record = {};                 // name of a log from the beginning; empty: none
  std::chrono::nanoseconds autosave = {};  // between autosaves, wall time; 0: none
  ClientLimits limits = {};
};

// The newest checkpoint that can be read; if there is none, the scene.
inline constexpr const char* kLatest = "latest";

}  // namespace poinsot
