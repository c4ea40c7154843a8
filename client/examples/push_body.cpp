// Pushes one body upwards with 50 N for half a second of simulated time.
//
//   push_body BODY [WORLD]

#include <cstdio>

#include "poinsot/client/client.h"

using namespace std::chrono_literals;

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: push_body BODY [WORLD]\n");
    return 2;
  }
  poinsot::Client client({.world = argc > 2 ? argv[2] : ""});
  client.wait_for_server(10s);

  poinsot::WrenchCommand push;
  push.body_name = argv[1];
  push.force = {0, 0, 50};  // [N] along axes of the world, at the centre of mass
  push.hold = poinsot::Hold::duration;
  push.duration_ns = 500'000'000;
  push.outlives_client = true;  // this program ends at once; else the push would end with it

  const poinsot::Reply reply = client.apply(push, 2s);
  if (reply.code != poinsot::ResultCode::ok) {
    std::fprintf(stderr, "push_body: %s\n", reply.message.c_str());
    return 1;
  }
  std::printf("%s is pushed in frames %llu to %llu\n", argv[1],
              static_cast<unsigned long long>(reply.first_frame),
              static_cast<unsigned long long>(reply.last_frame));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "push_body: %s\n", error.what());
  return 1;
}
