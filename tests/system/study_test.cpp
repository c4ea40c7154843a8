// poinsotd study as a process: what it prints, which files it leaves, how it ends.

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "system/programs.h"

namespace poinsot {
namespace {

TEST(Study, PrintsATableWithinItsBudget) {
  const Ended ended = run_daemon({"study", "tennis_racket", "--time", "2", "--budget", "5"});
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "") << "no progress bar where there is no terminal";
  for (const char* word : {"tennis_racket: 1 moving body", "Reference: ", "up to t = 2 s",
                           "orientation", "exact", "rk4", "1/240 s", "Pareto"})
    EXPECT_NE(ended.out.find(word), std::string::npos) << word << " in:\n" << ended.out;
}

TEST(Study, IsOneJsonObjectWithTheCheapestSetting) {
  const Ended ended = run_daemon(
      {"study", "tennis_racket", "--frames", "60", "--budget", "5s", "--json", "--error", "1e-3"});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  const Json json = Json::parse(ended.out);
  EXPECT_EQ(json["scene"], "tennis_racket");
  EXPECT_EQ(json["frames"], 60);
  EXPECT_EQ(json["horizon"], 1.0);
  EXPECT_GE(json["rows"].size(), 7u);
  EXPECT_TRUE(json["cheapest"].is_object()) << json["cheapest"];
  for (const Json& row : json["rows"]) EXPECT_GE(row["cpu_us_per_s"]["simulation"], 0) << row;
}

TEST(Study, LeavesATableAndAPicture) {
  const TemporaryFile csv("study.csv"), svg("study.svg");
  const Ended ended = run_daemon({"study", "tennis_racket", "--time", "500ms", "--budget", "5",
                                  "--csv", csv.path(), "--svg", svg.path()});
  ASSERT_EQ(ended.code, 0) << ended.errors;
  EXPECT_EQ(csv.text().rfind("integrator,setting,step,tolerance,", 0), 0u);
  EXPECT_NE(csv.text().find("\nrk4,"), std::string::npos);
  EXPECT_NE(svg.text().find("</svg>"), std::string::npos);
}

// A die that bounces on its corners: each bounce multiplies what two runs differ by.
TEST(Study, NamesTheHorizonOfAChaoticScene) {
  const TemporaryFile dice("dice.yaml", R"(
collision: {contact_step: 0.005}
bodies:
  - {name: floor, static: true, shape: {half_space: {normal: [0, 0, 1]}}, material: &m {restitution: 0.9, friction: 0.3}}
  - {name: die, shape: {box: [1, 1.2, 0.8]}, density: 1000, position: [0, 0, 3], orientation: {rpy: [0.3, 0.5, 0.1]}, angular_velocity: [1, 2, 3], material: *m}
)");
  const Words study = {"study", dice.path(), "--time", "60s", "--budget", "20"};
  const Ended ended = run_daemon(study);
  EXPECT_EQ(ended.code, 0) << ended.errors;
  EXPECT_NE(ended.out.find("A reference exists up to t = "), std::string::npos) << ended.out;

  Words in_json = study;
  in_json.push_back("--json");
  const Json json = Json::parse(run_daemon(in_json).out);
  EXPECT_EQ(json["reference"]["ends_by"], "disagreement");
  EXPECT_GT(json["horizon"], 0.5) << "before the first bounce";
  EXPECT_LT(json["horizon"], 60);
  EXPECT_LE(json["reference"]["certificate"]["orientation"], 1e-6);
}

TEST(Study, FailsWithoutAReference) {
  const Ended ended = run_daemon({"study", "tennis_racket", "--frames", "60", "--error", "1e-18"});
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.errors.find("No reference exists"), std::string::npos) << ended.errors;
}

TEST(Study, RefusesWhatItDoesNotUnderstand) {
  for (const Words& bad : {Words{"--error", "0"}, Words{"--error", "small"},
                           Words{"--frames", "-1"}, Words{"--time", "soon"}, Words{"--time", "0"},
                           Words{"--budget", "0"}, Words{"--frames", "3", "--time", "1"},
                           Words{"--cvs", "x.csv"}, Words{"--csv", "/nonexistent/x.csv"}}) {
    Words arguments = {"study", "tennis_racket"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    const Ended ended = run_daemon(arguments);
    EXPECT_EQ(ended.code, 2) << bad.front() << ": " << ended.out;
    EXPECT_NE(ended.errors, "") << bad.front();
  }
  EXPECT_EQ(run_daemon({"study"}).code, 2) << "which scene?";
}

TEST(Study, LeavesWithinTwoSecondsWhenInterrupted) {
  ChildProcess study(POINSOT_DAEMON, {"study", "pile", "--budget", "1h"});
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  const auto asked = std::chrono::steady_clock::now();
  study.signal(SIGINT);
  const std::string text = study.read_rest();
  EXPECT_EQ(study.wait(), 0) << study.errors();
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(2));
  EXPECT_NE(text.find("Interrupted"), std::string::npos) << text;
}

}  // namespace
}  // namespace poinsot
