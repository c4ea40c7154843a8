#include "bus/roles.h"

#include <cstdio>

#include "poinsot/wire/participant.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/protocol_samples.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

// Reads poses; says "ready" when matched, then frame, number of bodies and whether they are the
// sample's, for each frame until the last one (`count`).
int read_poses(const Role& role) {
  Participant participant({.domain = role.domain});
  Subscriber<PoseSnapshot> poses(participant, role.world);
  Waiter waiter;
  waiter.attach(poses);
  if (!eventually([&] { return poses.writers() > 0; })) return 1;
  say("ready");
  PoseSnapshot snapshot;
  while (waiter.wait(kPatience))
    while (poses.take(snapshot)) {
      bool good = true;
      for (std::uint32_t i = 0; i < snapshot.bodies.size(); ++i)
        good = good && snapshot.bodies[i].position == sample::body_state(i).position &&
               snapshot.bodies[i].id == sample::body_state(i).id;
      say(std::to_string(snapshot.frame) + " " + std::to_string(snapshot.bodies.size()) + " " +
          (good ? "good" : "bad"));
      if (snapshot.frame == static_cast<std::uint64_t>(role.count)) return 0;
    }
  return 1;
}

// Reads the scene of `count` bodies; says how many of them arrived.
int read_scene(const Role& role) {
  Participant participant({.domain = role.domain});
  Subscriber<BodyInfo> scene(participant, role.world);
  std::vector<bool> seen(static_cast<std::size_t>(role.count), false);
  int bodies = 0;
  BodyInfo body;
  eventually([&] {
    while (scene.take(body))
      if (body.index < seen.size() && !seen[body.index]) {
        seen[body.index] = true;
        ++bodies;
      }
    return bodies == role.count;
  });
  say(std::to_string(bodies));
  return 0;
}

// A daemon for the bus alone: frames at 200 Hz from `count`, one body, a reply to each command. The
// session is the process id.
int serve(const Role& role) {
  Participant participant({.domain = role.domain, .bodies = 1});
  Publisher<PoseSnapshot> poses(participant, role.world);
  Publisher<BodyInfo> scene(participant, role.world);
  Publisher<RunReport> report(participant, role.world);
  Publisher<Reply> reply(participant, role.world);
  Subscriber<WrenchCommand> wrench(participant, role.world);
  Subscriber<RunControl> control(participant, role.world);
  const auto session = static_cast<std::uint64_t>(getpid());
  BodyInfo body = sample::body_info(0, 1);
  body.session = session;
  scene.write(body);
  RunReport status = sample::report();
  status.session = session;
  status.scene_bodies = 1;
  status.scene_revision = 1;
  report.write(status);
  PoseSnapshot frame = sample::poses(static_cast<std::uint64_t>(role.count), 1);
  frame.session = session;
  say("ready");
  WrenchCommand command;
  RunControl request;
  for (;; ++frame.frame) {
    poses.write(frame);
    const auto answer = [&](std::uint64_t client, std::uint64_t seq) {
      reply.write({.client = client, .seq = seq, .message = {}, .first_frame = frame.frame});
    };
    while (wrench.take(command)) answer(command.client, command.seq);
    while (control.take(request)) answer(request.client, request.seq);
    std::this_thread::sleep_for(5ms);
  }
}

// Is there until it is killed.
int idle(const Role& role) {
  Participant participant({.domain = role.domain, .bodies = 1000});
  Publisher<PoseSnapshot> poses(participant, role.world);
  say("ready");
  std::this_thread::sleep_for(kPatience);
  return 0;
}

}  // namespace

int play(const Role& role) {
  if (role.name == "read_poses") return read_poses(role);
  if (role.name == "read_scene") return read_scene(role);
  if (role.name == "serve") return serve(role);
  if (role.name == "idle") return idle(role);
  return 2;
}

std::vector<std::string> role(const std::string& name, const std::string& world, int count) {
  return {name, std::to_string(test_domain()), world, std::to_string(count)};
}

}  // namespace poinsot
