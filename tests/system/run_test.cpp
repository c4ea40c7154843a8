// poinsotd as a process: what it prints, how it ends, what it leaves behind.

#include <chrono>
#include <csignal>
#include <sstream>

#include <gtest/gtest.h>

#include "support/test_domain.h"
#include "system/programs.h"

namespace poinsot {
namespace {

using Clock = std::chrono::steady_clock;

// What the daemon is allowed to take after SIGTERM.
constexpr std::chrono::seconds kLeave{2};

void expect_summary(const Json& summary) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : summary.items()) keys.push_back(key);
  EXPECT_EQ(keys, (Words{"frames",          "sim_time",         "wall_s",
                         "cpu_s",           "bodies",           "energy_error",
                         "momentum_error",  "position_error",   "orientation_error",
                         "impacts",         "islands",          "restarts",
                         "impact_searches", "asleep",           "crowded",
                         "soft_bodies",     "direct_bodies",    "solver_iterations",
                         "unconverged",     "contact_residual", "max_penetration",
                         "methods",         "state_hash"}));
  std::vector<std::string> layers;
  for (const auto& [layer, seconds] : summary["cpu_s"].items()) {
    layers.push_back(layer);
    EXPECT_GE(seconds.get<double>(), 0) << layer;
  }
  EXPECT_EQ(layers, (Words{"presentation", "collision", "contact", "simulation", "publishing"}));
  EXPECT_EQ(summary["state_hash"].get<std::string>().size(), 16u);
}

TEST(Run, InvitesClientsAndPrintsAStatusLineASecond) {
  Daemon daemon("push_me");
  EXPECT_EQ(daemon.welcome[0], "In another terminal:");
  EXPECT_NE(daemon.welcome[1].find("poinsot watch --domain"), std::string::npos);
  EXPECT_NE(daemon.welcome[2].find("poinsot push "), std::string::npos);
  for (int i = 0; i < 2; ++i) {
    const std::string line = daemon.read_line();
    for (const char* word : {"frame ", "time ", "real-time factor ", "bodies ", "contacts ",
                             "energy error ", "local error ", "momentum error "})
      EXPECT_NE(line.find(word), std::string::npos) << word << " in: " << line;
  }
}

class EndedBy : public testing::TestWithParam<int> {};

TEST_P(EndedBy, LeavesWithASummaryWithinTwoSeconds) {
  Daemon daemon("push_me");
  ASSERT_NE(daemon.read_line(), "");
  const auto asked = Clock::now();
  daemon.signal(GetParam());
  const std::string rest = daemon.read_rest();
  EXPECT_EQ(daemon.wait(), 0) << daemon.errors();
  EXPECT_LT(Clock::now() - asked, kLeave);
  for (const char* word : {"frames  ", "simulated  ", "wall  ", "cpu  ", "state hash  "})
    EXPECT_NE(rest.find(word), std::string::npos) << word << " in: " << rest;
}

INSTANTIATE_TEST_SUITE_P(Run, EndedBy, testing::Values(SIGTERM, SIGINT), [](const auto& row) {
  return std::string(row.param == SIGTERM ? "Terminate" : "Interrupt");
});

TEST(Run, EndsAfterSoManyFramesWithASummaryInJson) {
  const Ended ended = run_daemon({"run", "tower", "--fast", "--frames", "45", "--json", "--domain",
                                  std::to_string(test_domain())});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  const Json summary = Json::parse(ended.out);
  expect_summary(summary);
  EXPECT_EQ(summary["frames"], 45);
  EXPECT_EQ(summary["sim_time"], 0.75);
}

TEST(Run, OfflineAndOnTheBusAreTheSameRun) {
  const Words run = {"run", "push_me", "--fast", "--frames", "90", "--json"};
  Words offline = run, on_bus = run;
  offline.push_back("--offline");
  on_bus.insert(on_bus.end(), {"--domain", std::to_string(test_domain())});
  const Json a = Json::parse(run_daemon(offline).out);
  const Json b = Json::parse(run_daemon(on_bus).out);
  expect_summary(a);
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
  EXPECT_EQ(a["bodies"], b["bodies"]);
}

TEST(Run, WritesARowPerFrameAndBodyOfTheTrajectory) {
  constexpr std::size_t kFrames = 20;
  for (const Words& where :
       {Words{"--offline"}, Words{"--domain", std::to_string(test_domain())}}) {
    const TemporaryFile csv("out.csv");
    Words arguments = {"run",    "bouncing_balls", "--fast",  "--frames", std::to_string(kFrames),
                       "--json", "--trajectory",   csv.path()};
    arguments.insert(arguments.end(), where.begin(), where.end());
    const Ended ended = run_daemon(arguments);
    ASSERT_EQ(ended.code, 0) << ended.errors;
    const auto bodies = Json::parse(ended.out)["bodies"].get<std::size_t>();

    std::istringstream text(csv.text());
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(line, "frame,time,body,px,py,pz,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz");
    std::size_t rows = 0, statics = 0;
    std::string last;
    while (std::getline(text, line)) {
      ++rows;
      last = line;
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), 15);
    }
    ASSERT_EQ(rows % (kFrames + 1), 0u);
    statics = rows / (kFrames + 1) - bodies;
    EXPECT_LE(statics, 1u);  // the floor
    EXPECT_EQ(last.substr(0, 3), "20,");
  }
}

TEST(Run, NamesItsExitCodesAndRefusesWhatItDoesNotKnow) {
  const Ended help = run_daemon({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("bad input"), std::string::npos);
  EXPECT_EQ(run_daemon({}).code, 2);
  EXPECT_EQ(run_daemon({"run", "push_me", "--frame", "3"}).code, 2);
  EXPECT_EQ(run_daemon({"run", "push_me", "--frames", "-3"}).code, 2);
  EXPECT_EQ(run_daemon({"run", "push_me", "--domain", "900"}).code, 2);
  const Ended unknown = run_daemon({"run", "push_mee", "--offline"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.errors.find("push_me"), std::string::npos) << unknown.errors;
}

}  // namespace
}  // namespace poinsot
