// The daemon and the client as a shell would start them, on this process's own domain.

#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/child_process.h"

namespace poinsot {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

// How a program ended.
struct Ended {
  int code = -1;
  std::string out;
  std::string errors;
};

// Runs to its end; neither adds --domain: for `check`, --offline, --help and the like.
Ended run_daemon(const Words& arguments);
Ended run_client_alone(const Words& arguments);

// A verb on this process's domain.
Ended client(Words arguments);
// The same with --json, parsed; throws with both outputs if it failed.
Json client_json(Words arguments);

// Processes that go on, on this process's domain.
struct Daemon : ChildProcess {
  // poinsotd run SCENE ...; returns when it has joined the bus and said so.
  explicit Daemon(const std::string& scene, const Words& more = {});
  std::vector<std::string> welcome;  // the three lines that invite clients
};
struct Watcher : ChildProcess {
  // poinsot watch --json ...
  explicit Watcher(Words more = {});
  Json next();  // the next frame; throws if none comes
};

struct Listener : ChildProcess {
  // poinsot events --json ...
  explicit Listener(Words more = {});
  Json next();  // the next impact; throws if none comes
};

// A file that is gone at the end of the test.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text = {});
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }
  std::string text() const;

 private:
  std::string directory_;
  std::string path_;
};

}  // namespace poinsot
