// What a daemon is told beside its scene.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace poinsot {

struct DaemonOptions {
  int domain = 77;                 // DDS domain
  bool lan = false;                // false: this host only
  std::string world = {};          // name on the bus; empty: the scene's
  bool fast = false;               // frames as fast as they can be advanced, not in real time
  bool paused = false;             // wait for resume or step
  std::uint64_t frames = 0;        // end after so many; 0: when asked
  std::string client = "poinsot";  // how a shell calls the client, see client_command.h
  std::filesystem::path trajectory = {};  // empty: none
};

}  // namespace poinsot
