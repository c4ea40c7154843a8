// The verbs of the bus, as a shell would use them: what they do to a run, and what they leave.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <signal.h>
#include <thread>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

constexpr double kFrameRate = 60;  // [Hz]

// Free bodies, far from each other, and no gravity: nothing but commands moves them.
constexpr const char* kFree = R"(world: free
simulation: {gravity: [0, 0, 0]}
bodies:
  - {name: probe, shape: {sphere: 0.1}, mass: 2}
  - {name: bystander, shape: {sphere: 0.1}, mass: 1, position: [50, 0, 0]}
)";

constexpr const char* kNewcomer =
    "bodies: [{name: newcomer, shape: {sphere: 0.1}, mass: 1, position: [0, 20, 0]}]\n";

class Verbs : public testing::Test {
 protected:
  const TemporaryFile scene_{"free.yaml", kFree};
  const TemporaryFile data_{"unused"};
  Daemon daemon_{
      scene_.path(),
      {"--paused", "--data", std::filesystem::path(data_.path()).parent_path().string()}};

  static Json state_of(const std::string& body) {
    return client_json({"watch", "-n", "1", "--body", body})["bodies"].at(0);
  }

  static double velocity_x(const std::string& body) {
    return state_of(body)["linear_velocity"][0].get<double>();
  }

  static Words names() {
    Words names;
    const Json list = client_json({"list"});
    for (const Json& body : list["bodies"]) names.push_back(body["name"]);
    return names;
  }
};

TEST_F(Verbs, AnImpulseChangesTheVelocityByItselfOverTheMass) {
  const Json reply = client_json({"push", "probe", "--impulse", "3,0,0"});
  EXPECT_EQ(reply["first_frame"], reply["last_frame"]);
  client_json({"step", "1"});
  EXPECT_NEAR(velocity_x("probe"), 1.5, 1e-14);
  client_json({"step", "5"});
  EXPECT_NEAR(velocity_x("probe"), 1.5, 1e-14);
}

TEST_F(Verbs, APushThatIsHeldIsListedUntilItIsCleared) {
  client_json({"push", "probe", "--force", "1,0,0", "--hold", "--slot", "3"});
  client_json({"push", "bystander", "--force", "0,1,0", "--hold"});
  Json held = client_json({"pushes"})["held"];
  ASSERT_EQ(held.size(), 2u);
  EXPECT_EQ(held[0]["body"], "probe");
  EXPECT_EQ(held[0]["slot"], 3);
  EXPECT_TRUE(held[0]["you"]) << "though the program that sent it is gone";
  EXPECT_NE(client({"pushes"}).out.find("force (1, 0, 0) N"), std::string::npos);

  // The same slot again replaces it, on another body.
  client_json({"push", "bystander", "--force", "0,0,1", "--hold", "--slot", "3"});
  client_json({"step", "6"});
  EXPECT_EQ(velocity_x("probe"), 0);
  client_json({"clear", "bystander"});
  client_json({"step", "1"});
  held = client_json({"pushes"})["held"];
  EXPECT_EQ(held.size(), 0u) << held;
}

TEST_F(Verbs, ADragBringsABodyThereWithoutOvershoot) {
  client_json({"drag", "probe", "--to", "1,0,0"});
  double last = 0;
  for (int i = 0; i < 6; ++i) {
    client_json({"step", "10"});
    const double x = state_of("probe")["position"][0];
    ASSERT_LT(x, 1 + 1e-9);
    ASSERT_GE(x, last - 1e-9);
    last = x;
    // Critical damping from rest: x = 1 − (1 + ωt) exp(−ωt).
    const double t = 10 * (i + 1) / kFrameRate, omega = 6.64 / 0.3;
    ASSERT_NEAR(x, 1 - (1 + omega * t) * std::exp(-omega * t), 1e-6) << t;
  }
  // Another target is the same drag, moved.
  client_json({"drag", "probe", "--to", "0,0,0"});
  EXPECT_EQ(client_json({"pushes"})["held"].size(), 1u);
  client_json({"clear"});
}

TEST_F(Verbs, BodiesComeAndGo) {
  const TemporaryFile fragment("newcomer.yaml", kNewcomer);
  client_json({"spawn", fragment.path()});
  EXPECT_EQ(names(), (Words{"probe", "bystander", "newcomer"}));
  EXPECT_EQ(state_of("newcomer")["position"][1], 20.0);
  EXPECT_EQ(client({"spawn", fragment.path()}).code, 1) << "its name is taken";
  client_json({"remove", "probe"});
  EXPECT_EQ(names(), (Words{"bystander", "newcomer"}));
  const Ended gone = client({"remove", "newcomr"});
  EXPECT_EQ(gone.code, 1);
  EXPECT_NE(gone.errors.find("newcomer"), std::string::npos) << gone.errors;
  client_json({"reset"});
  EXPECT_EQ(names(), (Words{"probe", "bystander"}));
}

TEST_F(Verbs, SetPutsABodySomewhereAtOnce) {
  client_json({"set", "probe", "--position", "1,2,3", "--velocity", "6,0,0", "--rpy", "0,0,1"});
  const Json probe = state_of("probe");
  EXPECT_EQ(probe["position"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(probe["linear_velocity"], Json({6.0, 0.0, 0.0}));
  EXPECT_NEAR(probe["orientation"]["z"].get<double>(), std::sin(0.5), 1e-15);
  client_json({"step", "10"});
  EXPECT_NEAR(state_of("probe")["position"][0].get<double>(), 2, 1e-12);
}

TEST_F(Verbs, ARestoredRunGoesOnWithTheSameBits) {
  client_json({"push", "probe", "--force", "1,2,3", "--at", "0.1,0,0", "--hold"});
  client_json({"step", "7"});
  client_json({"save", "here"});
  const Json first = client_json({"step", "9"});
  const Json back = client_json({"restore", "here"});
  EXPECT_EQ(back["frame"], 7);
  const Json second = client_json({"step", "9"});
  EXPECT_EQ(second["frame"], 16);
  EXPECT_EQ(second["state_hash"], first["state_hash"]);
  client_json({"save", "--disk"});
  EXPECT_EQ(client_json({"restore"})["frame"], 16);
  EXPECT_EQ(client({"restore", "nowhere"}).code, 1);
}

TEST_F(Verbs, UntilRunsToATimeAndPauses) {
  client_json({"scale", "20"});
  EXPECT_EQ(client_json({"until", "2s"})["frame"], 120);
  const Json status = client_json({"status"});
  EXPECT_EQ(status["state"], "paused");
  EXPECT_EQ(status["time_scale"], 20.0);
  EXPECT_EQ(client({"scale", "--", "-1"}).code, 2);
}

TEST_F(Verbs, ARecordedRunIsReplayedFrameByFrame) {
  client_json({"record", "tape"});
  client_json({"push", "probe", "--force", "1,2,3", "--for", "0.1s"});
  client_json({"step", "30"});
  client_json({"record", "--stop"});
  std::string log;
  const auto directory = std::filesystem::path(data_.path()).parent_path();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory))
    if (entry.path().filename() == "tape.log") log = entry.path().string();
  ASSERT_NE(log, "");
  const Ended replayed = run_client_alone({"replay", log});
  EXPECT_EQ(replayed.code, 0) << replayed.out << replayed.errors;
}

TEST_F(Verbs, FilteredPosesAreThoseAskedFor) {
  Watcher watcher({"-n", "1", "--match", "by*"});
  const Json bodies = watcher.next()["bodies"];
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0]["name"], "bystander");
}

TEST_F(Verbs, MeasureTheStreams) {
  client_json({"resume"});
  const Json rate = client_json({"hz", "poses", "-n", "1"});
  EXPECT_GT(rate["samples"], 0);
  EXPECT_EQ(rate["lost"], 0);
  const Json delay = client_json({"delay", "-n", "20"});
  EXPECT_EQ(delay["frames"], 20);
  EXPECT_GT(delay["age"]["p50"], 0.0);
  const Json seen = client_json({"delay", "--push", "probe", "-n", "3"});
  EXPECT_EQ(seen["pushes"], 3);
  EXPECT_GE(seen["frames"]["p50"], 1.0);
}

TEST_F(Verbs, ADoctorFindsADaemonAndAMeeting) {
  const Json report = Json::parse(
      client({"doctor", "--json"}).out);  // a machine may have faults: they are no faults of ours
  bool met = false, found = false;
  for (const Json& finding : report["findings"]) {
    met |= finding["topic"] == "meeting" && finding["health"] == "ok";
    found |= finding["topic"] == "world" &&
             finding["text"].get<std::string>().starts_with("free: paused");
  }
  EXPECT_TRUE(met) << report;
  EXPECT_TRUE(found) << report;
}

TEST_F(Verbs, AShutdownEndsTheDaemon) {
  client_json({"shutdown"});
  EXPECT_EQ(daemon_.wait(), 0);
}

using Files = std::set<std::string>;

Files shared_files() {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    files.insert(entry.path().string());
  return files;
}

// What a process has mapped of these.
Files mapped_of(const Files& files, pid_t process) {
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  Files mapped;
  for (std::string line; std::getline(maps, line);)
    if (const auto at = line.find("/dev/shm/"); at != std::string::npos)
      if (files.contains(line.substr(at))) mapped.insert(line.substr(at));
  return mapped;
}

// Those that it has made itself: they were not there before it began.
Files made_by(pid_t process, const Files& before) {
  Files made;
  for (const std::string& file : mapped_of(shared_files(), process))
    if (!before.contains(file)) made.insert(file);
  return made;
}

TEST(Interrupt, LeavesNothingInSharedMemory) {
  const Daemon daemon("push_me", {"--paused"});
  // Those that go through shared memory: who only asks does not.
  const std::vector<Words> verbs = {{"watch"}, {"events"}, {"contacts"}, {"hz"}, {"delay"}};
  client({"status"});
  for (Words verb : verbs) {
    verb.insert(verb.end(), {"--domain", std::to_string(test_domain()), "--timeout", "60s"});
    const Files before = shared_files();
    ChildProcess process(POINSOT_CLIENT, verb);
    ASSERT_TRUE(eventually([&] { return !made_by(process.id(), before).empty(); })) << verb[0];
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // it has begun to wait
    const Files made = made_by(process.id(), before);
    process.signal(SIGINT);
    EXPECT_EQ(process.wait(), 0) << verb[0] << process.errors();
    // Not its receive queue: the library keeps that as long as the daemon, which wrote to it,
    // lives.
    for (const std::string& file : made) {
      if (file.find("fastrtps_port") != std::string::npos) continue;
      EXPECT_FALSE(std::filesystem::exists(file)) << verb[0] << " left " << file;
    }
  }
}

TEST(Contacts, CarryTheWeightOfWhatRests) {
  const Daemon daemon("push_me");
  const Json frame = client_json({"contacts", "-n", "1", "--body", "crate"});
  double force = 0;
  for (const Json& contact : frame["contacts"]) {
    EXPECT_EQ(contact["a"] == "crate" ? contact["b"] : contact["a"], "floor");
    force += std::abs(contact["force"][2].get<double>());
  }
  const double weight = 200 * 0.4 * 0.4 * 0.4 * 9.81;
  EXPECT_NEAR(force, weight, 1e-6 * weight);
}

}  // namespace
}  // namespace poinsot
