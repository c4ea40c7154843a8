// A world of two free bodies, served with a data directory of its own: nothing but commands moves
// them. Every call of the tool names the world, so that it need not wait for others.

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "support/temp_path.h"
#include "system/programs.h"

namespace poinsot {

class FreeWorld {
 public:
  // Serves it; with other options more than once.
  void start(const Words& more = {"--paused"});
  void kill();  // -9

  Daemon& daemon() { return *daemon_; }
  std::filesystem::path directory() const { return data_.path() / "free"; }
  std::string data() const { return data_.path().string(); }
  std::string scene() const { return scene_.path(); }

  // A verb, as client() and client_json() do it.
  static Ended run(Words arguments);
  static Json json(Words arguments);

  // As in a line of watch.
  static Json state_of(const std::string& body);

 private:
  const TemporaryFile scene_{"free.yaml",
                             "world: free\n"
                             "simulation: {gravity: [0, 0, 0]}\n"
                             "bodies:\n"
                             "  - {name: probe, shape: {sphere: 0.1}, mass: 2}\n"
                             "  - {name: bystander, shape: {sphere: 0.1}, mass: 1,"
                             " position: [50, 0, 0]}\n"};
  const test::TempDirectory data_;
  std::optional<Daemon> daemon_;
};

}  // namespace poinsot
