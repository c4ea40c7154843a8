#include "system/free_world.h"

#include <csignal>

namespace poinsot {
namespace {

Words in_world(Words arguments) {
  arguments.insert(arguments.end(), {"--world", "free"});
  return arguments;
}

}  // namespace

void FreeWorld::start(const Words& more) {
  Words options = more;
  options.insert(options.end(), {"--data", data()});
  daemon_.emplace(scene(), options);
}

void FreeWorld::kill() {
  daemon_->signal(SIGKILL);
  daemon_->wait();
}

Ended FreeWorld::run(Words arguments) {
  return client(in_world(std::move(arguments)));
}

Json FreeWorld::json(Words arguments) {
  return client_json(in_world(std::move(arguments)));
}

Json FreeWorld::state_of(const std::string& body) {
  return json({"watch", "-n", "1", "--body", body})["bodies"].at(0);
}

}  // namespace poinsot
