#include "system/holding_client.h"

#include <cstdio>
#include <unistd.h>

#include "poinsot/client/client.h"
#include "support/test_domain.h"

namespace poinsot {

std::vector<std::string> holding_client(const std::string& body) {
  return {"hold", std::to_string(test_domain()), body};
}

int hold(int domain, const std::string& body) {
  Client client({.domain = domain});
  client.wait_for_server(kPatience);
  WrenchCommand command;
  command.body_name = body;
  command.force = Vec3(3, 0, 0);
  command.hold = Hold::duration;
  command.duration_ns = 1'000'000'000;
  const Reply reply = client.apply(command, kPatience);
  std::printf("%llu %llu\n", static_cast<unsigned long long>(reply.first_frame),
              static_cast<unsigned long long>(reply.last_frame));
  std::fflush(stdout);
  while (true) pause();
}

}  // namespace poinsot
