#include "poinsot/service/supervisor.h"

#include <csignal>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "support/temp_path.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

// A shell script as the child; each run of it adds a line to a file.
class SupervisorTest : public testing::Test {
 protected:
  std::vector<std::string> script(const std::string& body) const {
    return {"/bin/sh", "-c", "echo run >> '" + runs_.string() + "'; " + body};
  }
  int runs() const {
    std::ifstream file(runs_);
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    return lines;
  }
  int supervise_both(const std::string& body) const {
    return supervise({.first = script(body), .again = script(body)}, logger_);
  }

  const test::TempDirectory directory_;
  const std::filesystem::path runs_ = directory_.path() / "runs";
  const Logger logger_ = [] {
    Logger logger = make_logger("test", spdlog::level::off, 0);
    logger->set_level(spdlog::level::off);
    return logger;
  }();
};

TEST_F(SupervisorTest, EndsWithAChildThatEndsWell) {
  EXPECT_EQ(supervise_both("exit 0"), 0);
  EXPECT_EQ(runs(), 1);
}

TEST_F(SupervisorTest, AMistakeOnTheCommandLineIsNotTriedAgain) {
  EXPECT_EQ(supervise_both("exit 2"), 2);
  EXPECT_EQ(runs(), 1);
}

TEST_F(SupervisorTest, AProgramThatIsNotThereIsNotTriedAgain) {
  EXPECT_EQ(supervise({.first = {"/nowhere/at/all"}, .again = {"/nowhere/at/all"}}, logger_), 127);
}

TEST_F(SupervisorTest, StartsAgainAfterASignalWithTheOtherCommandLine) {
  EXPECT_EQ(supervise({.first = script("kill -SEGV $$"), .again = script("exit 0")}, logger_), 0);
  EXPECT_EQ(runs(), 2);
}

TEST_F(SupervisorTest, StartsAgainWithinATenthOfASecond) {
  const auto begin = std::chrono::steady_clock::now();
  supervise({.first = script("kill -KILL $$"), .again = script("exit 0")}, logger_);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 2s);  // both runs, on a busy machine
}

TEST_F(SupervisorTest, GivesUpAfterFiveFailuresInTenSeconds) {
  EXPECT_EQ(supervise_both("exit 1"), 1);
  EXPECT_EQ(runs(), 5);
}

TEST_F(SupervisorTest, PassesTheEndOnAndReturnsWhatBecomesOfIt) {
  const pid_t supervisor = fork();
  ASSERT_GE(supervisor, 0);
  if (supervisor == 0) {
    // The shell's trap runs when its sleep, short, is over.
    const auto child = script("trap 'exit 7' TERM; while :; do sleep 0.05; done");
    _exit(supervise({.first = child, .again = child}, logger_));
  }
  const auto deadline = std::chrono::steady_clock::now() + 20s;
  while (runs() == 0 && std::chrono::steady_clock::now() < deadline) usleep(1000);
  usleep(100'000);  // the trap is set after the line is written
  kill(supervisor, SIGTERM);
  int status = 0;
  ASSERT_EQ(waitpid(supervisor, &status, 0), supervisor);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_EQ(runs(), 1);
}

TEST_F(SupervisorTest, AUsageErrorAfterACrashIsAFailureLikeAnother) {
  EXPECT_EQ(supervise({.first = script("kill -SEGV $$"), .again = script("exit 2")}, logger_), 1);
  EXPECT_EQ(runs(), 5);
}

}  // namespace
}  // namespace poinsot
