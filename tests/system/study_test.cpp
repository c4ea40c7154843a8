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
  for (const Json& row : json["rows"]) EXPECT_GT(row["cpu_us_per_s"]["simulation"], 0) << row;
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
