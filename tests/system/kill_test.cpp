// Sudden ends: kill -9 of a client and of the daemon.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <optional>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/holding_client.h"
#include "system/programs.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;

// A new daemon is there "at once": far below the 5 s after which a dead participant is forgotten.
// Beside a client that watches, a restart now and then waits for Fast DDS's health check of the
// dead daemon's queue, some two seconds.
constexpr std::chrono::seconds kAtOnce{5};

constexpr const char* kScene = R"(world: free
simulation: {gravity: [0, 0, 0]}
bodies:
  - {name: probe, mass: 1.5, shape: {sphere: 0.2}}
)";

TEST(Kill, OfAClientInTheMiddleOfItsPushEndsThePushOnTimeAndDelaysNoFrame) {
  const TemporaryFile scene("free.yaml", kScene);
  const Daemon daemon(scene.path());
  Watcher watcher;
  Watcher doomed;
  Json frame = watcher.next();
  doomed.next();
  ChildProcess pusher(holding_client("probe"));
  unsigned long long first = 0, last = 0;
  ASSERT_EQ(std::sscanf(pusher.read_line().c_str(), "%llu %llu", &first, &last), 2);
  ASSERT_EQ(last - first + 1, 60u);

  bool alive = true;
  while (frame["frame"].get<unsigned long long>() < last + 30) {
    const auto number = frame["frame"].get<unsigned long long>();
    if (alive && number >= first + 10) {
      ASSERT_LT(number, last);
      pusher.signal(SIGKILL);
      doomed.signal(SIGKILL);
      EXPECT_EQ(pusher.wait(), 128 + SIGKILL);
      alive = false;
    }
    const auto pushed = number < first ? 0 : std::min(number, last) - first + 1;
    const double expected = 3.0 / 1.5 * static_cast<double>(pushed) / 60;
    EXPECT_NEAR(frame["bodies"][0]["linear_velocity"][0].get<double>(), expected, 1e-12 * expected)
        << number;
    frame = watcher.next();
    ASSERT_EQ(frame["frame"], number + 1);
  }
  EXPECT_FALSE(alive);
}

TEST(Kill, OfTheDaemonLetsTheNextStartAtOnceAndItsClientsResume) {
  std::optional<Daemon> daemon(std::in_place, "push_me");
  const std::string session = client_json({"status"})["session"];
  Watcher watcher;
  watcher.next();
  client_json({"pause"});
  client_json({"step", "1000"});  // beyond what the next daemon reaches in this test
  client_json({"resume"});
  while (watcher.next()["frame"] < 1000) continue;
  daemon->signal(SIGKILL);
  EXPECT_EQ(daemon->wait(), 128 + SIGKILL);

  const auto started = Clock::now();
  daemon.emplace("push_me");
  EXPECT_LT(Clock::now() - started, kAtOnce);

  // The same watcher, not restarted: what is left of the old run, then the new one without a gap.
  int frame = 1000;
  while (frame >= 1000) frame = watcher.next()["frame"];
  EXPECT_LT(Clock::now() - started, kPatience);
  for (int i = 0; i < 60; ++i) {
    const int next = watcher.next()["frame"];
    ASSERT_EQ(next, frame + 1);
    frame = next;
  }
  EXPECT_NE(client_json({"status"})["session"], session);
}

}  // namespace
}  // namespace poinsot
