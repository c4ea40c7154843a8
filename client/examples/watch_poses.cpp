// Prints where the bodies of a running simulation are, ten times a second.
//
//   watch_poses [WORLD]

#include <cstdio>
#include <string>
#include <thread>
#include <unordered_map>

#include "poinsot/client/client.h"

using namespace std::chrono_literals;

int main(int argc, char** argv) try {
  poinsot::Client client({.world = argc > 1 ? argv[1] : ""});
  client.wait_for_server(10s);

  poinsot::PoseSnapshot poses;
  std::uint64_t session = 0;
  std::unordered_map<std::uint32_t, std::string> names;  // by slot

  while (true) {
    std::this_thread::sleep_for(100ms);
    if (!client.latest_poses(poses)) continue;
    if (poses.session != session) {  // the first frame, or the daemon was started again
      session = poses.session;
      names.clear();
      for (const poinsot::BodyInfo& body : client.scene(5s)) names[body.id.slot] = body.name;
    }
    std::printf("frame %llu, t = %.3f s\n", static_cast<unsigned long long>(poses.frame),
                static_cast<double>(poses.sim_time_ns) * 1e-9);
    for (const poinsot::BodyState& body : poses.bodies)
      std::printf("  %-16s x %9.4f  y %9.4f  z %9.4f m\n", names[body.id.slot].c_str(),
                  body.position.x(), body.position.y(), body.position.z());
    std::fflush(stdout);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "watch_poses: %s\n", error.what());
  return 1;
}
