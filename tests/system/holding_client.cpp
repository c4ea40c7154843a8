#include "system/holding_client.h"

#include <cstdio>
#include <unistd.h>

#include "poinsot/client/client.h"
#include "support/test_domain.h"

namespace poinsot {

std::vector<std::string> holding_client(const std::string& body, Hold hold) {
  return {hold == Hold::duration ? "push" : "hold", std::to_string(test_domain()), body};
}

std::vector<std::string> blocking_client() {
  return {"block", std::to_string(test_domain()), ""};
}

int block(int domain) {
  Client client({.domain = domain, .poses = std::nullopt});
  client.wait_for_server(kPatience);
  const Reply reply = client.lock_step(std::chrono::minutes(1), kPatience);
  std::printf("%llu\n", static_cast<unsigned long long>(reply.last_frame));
  std::fflush(stdout);
  while (true) pause();
}

int hold(int domain, const std::string& body, Hold hold) {
  Client client({.domain = domain});
  client.wait_for_server(kPatience);
  WrenchCommand command;
  command.body_name = body;
  command.force = Vec3(3, 0, 0);
  command.hold = hold;
  if (hold == Hold::duration) command.duration_ns = 1'000'000'000;
  const Reply reply = client.apply(command, kPatience);
  std::printf("%llu %llu\n", static_cast<unsigned long long>(reply.first_frame),
              static_cast<unsigned long long>(reply.last_frame));
  std::fflush(stdout);
  while (true) pause();
}

}  // namespace poinsot
