// How many frames a second a client in lock step gets through over the bus: each frame is a push,
// an advance and its answer. Prints one line.
//
//   lock_step_rate WORLD DOMAIN [SECONDS]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "poinsot/client/client.h"

int main(int argc, char** argv) {
  using namespace poinsot;
  using namespace std::chrono_literals;
  using Clock = std::chrono::steady_clock;
  if (argc < 3) return 2;
  Client client({.world = argv[1], .domain = std::atoi(argv[2]), .poses = std::nullopt});
  client.wait_for_server(5s);
  const std::chrono::duration<double> span(argc > 3 ? std::atof(argv[3]) : 3.0);
  client.lock_step(1s, 5s);
  client.control({.action = ControlAction::scale, .value = 0}, 5s);
  client.control({.action = ControlAction::resume}, 5s);
  std::vector<double> rounds;  // [s]
  std::uint64_t first = 0, last = 0;
  const auto begin = Clock::now();
  while (Clock::now() - begin < span) {
    const auto start = Clock::now();
    const Reply reply = client.advance(5s);
    rounds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    if (reply.code != ResultCode::ok) {
      std::fprintf(stderr, "%s\n", reply.message.c_str());
      return 1;
    }
    if (first == 0) first = reply.last_frame;
    last = reply.last_frame;
  }
  const double wall = std::chrono::duration<double>(Clock::now() - begin).count();
  std::sort(rounds.begin(), rounds.end());
  std::printf("frames %llu in %.2f s: %.0f frames/s; round p50 %.0f us, p99 %.0f us\n",
              static_cast<unsigned long long>(last - first + 1), wall,
              static_cast<double>(last - first + 1) / wall, 1e6 * rounds[rounds.size() / 2],
              1e6 * rounds[rounds.size() * 99 / 100]);
  client.lock_step(0s, 5s);
  client.control({.action = ControlAction::scale, .value = 1}, 5s);
  return 0;
}
