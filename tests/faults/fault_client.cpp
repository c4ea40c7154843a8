// A client that behaves badly, or watches closely, as a process:
//
//   fault_client hold DOMAIN WORLD                 reads frames until it is killed; prints "ready"
//   fault_client visit DOMAIN WORLD TIMES          joins, reads a frame, leaves, so often
//   fault_client flood DOMAIN WORLD RATE SECONDS   RATE pushes a second of a body that is not
//   there;
//                                                  prints how many were sent and answered
//   fault_client follow DOMAIN WORLD SECONDS BODY  over the local network: prints each frame that
//                                                  comes, and pushes BODY for a frame with no force
//                                                  twice a second, printing each reply:
//     frame FRAME HASH LATENCY_MS WALL_S
//     reply SEQ CODE FIRST_FRAME TOOK_MS WALL_S
//     lost SEQ WALL_S                              no answer within 5 s
//   fault_client expect 0 SCENE FRAMES             hashes of an undisturbed run, from frame 0
//
// Exit status 0: done; 1: the daemon did not answer.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>

#include "faults/witness.h"
#include "poinsot/client/client.h"
#include "poinsot/wire/participant.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"
#include "support/test_domain.h"

namespace poinsot::faults {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void say(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

int hold(int domain, const std::string& world) {
  Client client({.world = world, .domain = domain});
  PoseSnapshot snapshot;
  if (!client.next_poses(snapshot, kPatience)) return 1;
  say("ready");
  while (true) client.next_poses(snapshot, 1s);
}

int visit(int domain, const std::string& world, int times) {
  for (int i = 0; i < times; ++i) {
    Client client({.world = world, .domain = domain});
    PoseSnapshot snapshot;
    if (!client.next_poses(snapshot, kPatience)) return 1;
  }
  say("left");
  return 0;
}

// Without the client library, which waits for each answer.
int flood(int domain, const std::string& world, double rate, double seconds) {
  Participant participant({.domain = domain});
  Publisher<WrenchCommand> wrench(participant, world);
  Subscriber<Reply> reply(participant, world);
  if (!eventually([&] { return wrench.readers() == 1 && reply.writers() == 1; })) return 1;
  WrenchCommand command;
  command.client = 0xF100D;
  command.body_name = "~nobody~";
  Reply answer;
  std::uint64_t answered = 0;
  const auto start = Clock::now();
  const auto count = static_cast<std::uint64_t>(rate * seconds);
  while (command.seq < count) {
    const auto due = static_cast<std::uint64_t>(rate * seconds_since(start));
    for (; command.seq < std::min(due, count);) {
      ++command.seq;
      wrench.write(command);
    }
    while (reply.take(answer)) answered += answer.client == command.client;
    std::this_thread::sleep_for(1ms);
  }
  const double took = seconds_since(start);
  eventually([&] { return reply.take(answer) && answer.seq == count; }, 1s);
  std::printf("%llu sent in %.2f s, %llu answered\n", static_cast<unsigned long long>(command.seq),
              took, static_cast<unsigned long long>(answered));
  return 0;
}

void push_for_nothing(Client& client, const std::string& body, std::uint64_t number,
                      Clock::time_point start) {
  const auto sent = Clock::now();
  try {
    const Reply reply = client.apply({.body_name = body}, 5s);
    std::printf("reply %llu %d %llu %.1f %.3f\n", static_cast<unsigned long long>(number),
                static_cast<int>(reply.code), static_cast<unsigned long long>(reply.first_frame),
                1e3 * seconds_since(sent), seconds_since(start));
  } catch (const NoAnswer&) {
    std::printf("lost %llu %.3f\n", static_cast<unsigned long long>(number), seconds_since(start));
  }
}

// Two clients, because one waits for its answers.
int follow(int domain, const std::string& world, double seconds, const std::string& body) {
  const auto start = Clock::now();
  const std::jthread pusher([&] {
    Client client({.world = world, .domain = domain, .lan = true});
    for (std::uint64_t n = 1; seconds_since(start) < seconds; ++n) {
      push_for_nothing(client, body, n, start);
      std::this_thread::sleep_for(500ms);
    }
  });
  Client client({.world = world, .domain = domain, .lan = true});
  PoseSnapshot snapshot;
  while (seconds_since(start) < seconds) {
    if (!client.next_poses(snapshot, 100ms)) continue;
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    const auto now_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    std::printf("frame %llu %llu %.2f %.3f\n", static_cast<unsigned long long>(snapshot.frame),
                static_cast<unsigned long long>(snapshot.state_hash),
                1e-6 * static_cast<double>(now_ns - snapshot.publish_time_ns),
                seconds_since(start));
  }
  return 0;
}

int expect(const std::string& scene, std::uint64_t frames) {
  for (const std::uint64_t hash : undisturbed_hashes(scene, frames))
    std::printf("%llu\n", static_cast<unsigned long long>(hash));
  return 0;
}

int play(int argc, char** argv) {
  const std::string role = argc > 3 ? argv[1] : "";
  const auto word = [&](int i) { return std::string(i < argc ? argv[i] : ""); };
  const auto number = [&](int i) { return std::atof(word(i).c_str()); };
  const int domain = std::atoi(word(2).c_str());
  if (role == "hold") return hold(domain, word(3));
  if (role == "visit") return visit(domain, word(3), static_cast<int>(number(4)));
  if (role == "flood") return flood(domain, word(3), number(4), number(5));
  if (role == "follow") return follow(domain, word(3), number(4), word(5));
  if (role == "expect") return expect(word(3), static_cast<std::uint64_t>(number(4)));
  std::fprintf(stderr, "usage: fault_client expect|hold|visit|flood|follow DOMAIN WORLD ...\n");
  return 2;
}

}  // namespace
}  // namespace poinsot::faults

int main(int argc, char** argv) try {
  return poinsot::faults::play(argc, argv);
} catch (const std::exception& error) {
  std::fprintf(stderr, "fault_client: %s\n", error.what());
  return 1;
}
