#include "poinsot/program/signals.h"

#include <cerrno>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using namespace std::chrono_literals;

TEST(StopSignals, TurnASignalIntoAnEvent) {
  StopSignals signals;
  kill(getpid(), SIGTERM);
  ASSERT_TRUE(signals.wait_for(10s));
  EXPECT_EQ(signals.signal(), SIGTERM);
  EXPECT_TRUE(signals.wait_for(0s));  // remembered
}

TEST(StopSignals, TimeOutWhenNothingHappens) {
  StopSignals signals;
  EXPECT_FALSE(signals.wait_for(0s));
  EXPECT_FALSE(signals.wait_for(20ms));
  EXPECT_EQ(signals.signal(), 0);
}

TEST(StopSignals, EndTheWaitWhenAnotherThreadAsks) {
  StopSignals signals;
  std::jthread other([&] { signals.request_stop(); });
  signals.wait();
  EXPECT_EQ(signals.signal(), 0);
}

TEST(StopSignals, AreBlockedInThreadsStartedLater) {
  StopSignals signals;
  std::jthread other([] {
    pthread_kill(pthread_self(), SIGINT);  // would end the process if it were not blocked
  });
  other.join();
  SUCCEED();
}

TEST(StopSignals, MakeAClosedPipeAnErrorOfTheWrite) {
  StopSignals signals;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  EXPECT_EQ(write(ends[1], "x", 1), -1);
  EXPECT_EQ(errno, EPIPE);
  close(ends[1]);
}

TEST(StopSignals, RestoreTheMaskOfTheThread) {
  { StopSignals signals; }
  sigset_t mask;
  pthread_sigmask(SIG_BLOCK, nullptr, &mask);
  EXPECT_EQ(sigismember(&mask, SIGTERM), 0);
}

}  // namespace
}  // namespace poinsot
