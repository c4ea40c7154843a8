#include "system/programs.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/temp_path.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

Ended finish(ChildProcess& process) {
  Ended ended;
  ended.out = process.read_rest();
  ended.code = process.wait();
  ended.errors = process.errors();
  return ended;
}

Words on_test_domain(Words arguments, const Words& more = {}) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  arguments.insert(arguments.end(), {"--domain", std::to_string(test_domain())});
  return arguments;
}

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

Ended run_daemon(const Words& arguments) {
  ChildProcess process(POINSOT_DAEMON, arguments);
  return finish(process);
}

Ended run_client_alone(const Words& arguments) {
  ChildProcess process(POINSOT_CLIENT, arguments);
  return finish(process);
}

Ended client(Words arguments) {
  return run_client_alone(on_test_domain(std::move(arguments), {"--timeout", "10s"}));
}

Json client_json(Words arguments) {
  arguments.push_back("--json");
  const Ended ended = client(arguments);
  if (ended.code != 0)
    throw std::runtime_error(arguments[0] + " failed: " + ended.out + ended.errors);
  return Json::parse(ended.out);
}

Daemon::Daemon(const std::string& scene, const Words& more)
    : ChildProcess(POINSOT_DAEMON, on_test_domain({"run", scene}, more)) {
  for (int i = 0; i < 3; ++i) welcome.push_back(read_line());
  if (welcome.back().empty()) throw std::runtime_error("the daemon did not start: " + errors());
}

Watcher::Watcher(Words more)
    : ChildProcess(POINSOT_CLIENT, on_test_domain(joined({"watch", "--json"}, more))) {}

Json Watcher::next() {
  const std::string line = read_line();
  if (line.empty()) throw std::runtime_error("no frame came: " + errors());
  return Json::parse(line);
}

Listener::Listener(Words more)
    : ChildProcess(POINSOT_CLIENT, on_test_domain(joined({"events", "--json"}, more))) {}

Json Listener::next() {
  const std::string line = read_line();
  if (line.empty()) throw std::runtime_error("no impact came: " + errors());
  return Json::parse(line);
}

TemporaryFile::TemporaryFile(const std::string& name, const std::string& text)
    : directory_(test::make_temp_directory()), path_(directory_ + "/" + name) {
  std::ofstream(path_) << text;
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

std::string TemporaryFile::text() const {
  std::ostringstream text;
  text << std::ifstream(path_).rdbuf();
  return text.str();
}

}  // namespace poinsot
