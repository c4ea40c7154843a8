#include "poinsot/cli/bus_checks.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "poinsot/base/error.h"
#include "poinsot/cli/connect.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/wire/publisher.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPoll = 5ms;
constexpr auto kAskAgain = 100ms;
constexpr auto kPeerLives = 20s;  // at most
constexpr auto kLook = 1s;        // for worlds

BusOptions bus_options(const BusFlags& flags) {
  BusOptions options;
  options.domain = flags.domain;
  options.lan = flags.lan;
  options.partition = flags.partition;
  options.discovery_server = flags.discovery_server;
  return options;
}

// This program again, as the peer. It gets the signals that this process keeps for itself.
class PeerProcess {
 public:
  PeerProcess(const BusFlags& flags, const std::string& meeting) {
    std::vector<std::string> words = {"poinsot",  "doctor",
                                      "--peer",   meeting,
                                      "--domain", std::to_string(flags.domain),
                                      "--listen", flags.lan ? "lan" : "local"};
    if (!flags.partition.empty()) words.insert(words.end(), {"--partition", flags.partition});
    if (!flags.discovery_server.empty())
      words.insert(words.end(), {"--discovery-server", flags.discovery_server});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
    started_ =
        posix_spawn(&id_, "/proc/self/exe", nullptr, &attributes, arguments.data(), environ) == 0;
    posix_spawnattr_destroy(&attributes);
  }
  ~PeerProcess() {
    if (!started_) return;
    kill(id_, SIGTERM);
    waitpid(id_, nullptr, 0);
  }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  bool started() const { return started_; }

 private:
  pid_t id_ = 0;
  bool started_ = false;
};

template <class Condition>
bool eventually(const Context& context, Clock::time_point until, Condition condition) {
  while (!condition()) {
    if (context.stop.stop_requested()) throw Stopped();
    if (Clock::now() >= until) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

namespace {

Finding meet(const Context& context) {
  const BusFlags& flags = context.flags.bus;
  const std::string meeting = "doctor-" + std::to_string(getpid());
  Participant participant(bus_options(flags));
  Publisher<RunControl> questions(participant, meeting);
  Subscriber<Reply> answers(participant, meeting);
  const auto start = Clock::now();
  const auto until = start + context.flags.timeout;
  const PeerProcess peer(flags, meeting);
  if (!peer.started())
    return {Health::fail, "meeting", "no second process can be started", std::strerror(errno)};
  if (!eventually(context, until, [&] { return questions.readers() > 0 && answers.writers() > 0; }))
    return {Health::fail, "meeting",
            fmt::format("two processes did not meet within {:g} s",
                        std::chrono::duration<double>(context.flags.timeout).count()),
            flags.discovery_server.empty()
                ? "look at the findings above: ports, interfaces, a firewall on loopback"
                : "is the discovery server running there?"};
  const double met = ms_since(start);
  const auto asked = Clock::now();
  auto ask_at = asked;
  Reply reply;
  const bool answered = eventually(context, until, [&] {
    if (Clock::now() >= ask_at) {
      questions.write({.client = 1, .seq = 1});
      ask_at += kAskAgain;
    }
    return answers.take(reply);
  });
  if (!answered)
    return {Health::fail, "meeting",
            fmt::format("two processes met in {:.0f} ms, but no message "
                        "came through",
                        met),
            "is /dev/shm shared by both, and large enough? Containers need --ipc=host"};
  return {Health::ok,
          "meeting",
          fmt::format("two processes met in {:.0f} ms, question and answer took {:.1f} ms", met,
                      ms_since(asked)),
          {}};
}

}  // namespace

Finding check_meeting(const Context& context) {
  try {
    return meet(context);
  } catch (const Error& error) {
    return {Health::fail, "meeting", error.what(),
            "are all ports taken, or does a profile file forbid it?"};
  }
}

ExitCode be_peer(const Context& context, const std::string& meeting) {
  Participant participant(bus_options(context.flags.bus));
  Subscriber<RunControl> questions(participant, meeting);
  Publisher<Reply> answers(participant, meeting);
  RunControl question;
  // It answers until it is ended: the first answer may come before the other side listens.
  eventually(context, Clock::now() + kPeerLives, [&] {
    while (questions.take(question))
      answers.write({.client = question.client, .seq = question.seq});
    return false;
  });
  return ExitCode::ok;
}

Findings check_worlds(const Context& context) {
  ClientOptions options = client_options(context);
  options.world.clear();
  const std::vector<std::string> worlds = find_worlds(options, kLook);
  if (worlds.empty())
    return {{Health::ok, "worlds", "no daemon runs here", "start one with 'poinsotd run SCENE'"}};
  Findings findings;
  for (const std::string& world : worlds) try {
      Context here = context;
      here.flags.world = world;
      Client client = connect(here);
      const RunReport report = client.report(here.flags.timeout);
      findings.push_back(
          {Health::ok,
           "world",
           fmt::format("{}: {}, {} bodies, frame {}, {:.2f} of real time, session "
                       "{:016x}",
                       world, name_of<RunState>(kRunStateNames, report.state), report.scene_bodies,
                       report.frame.frame, report.real_time_factor, report.session),
           {}});
    } catch (const std::runtime_error&) {
      findings.push_back({Health::fail, "world", world + ": announced, but does not answer",
                          "another version, or stopped (SIGSTOP, a debugger)? Start it again"});
    }
  return findings;
}

}  // namespace poinsot
