#include "poinsot/presentation/frame_clock.h"

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr std::int64_t kTick = 1000;  // [ns] that one reading takes

// A clock that moves only when it is read (a little) or slept on (too long by `overshoot`).
struct FakeTime {
  struct State {
    std::int64_t now = 1'000'000'007;
    std::int64_t overshoot = 60'000;
    bool stopped = false;
    std::vector<std::int64_t> sleeps;  // the times slept until
  };
  State* state;

  std::int64_t now() { return state->now += kTick; }
  bool sleep_until(std::int64_t t) {
    state->sleeps.push_back(t);
    if (!state->stopped) state->now = std::max(state->now, t + state->overshoot);
    return !state->stopped;
  }
};

TEST(FrameClock, DoesNotDriftWhenThePeriodIsNoWholeNumberOfNanoseconds) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 60.0);
  const std::int64_t start = state.now;
  for (std::int64_t n = 1; n <= 300'000; ++n) {
    ASSERT_TRUE(clock.wait());
    const double due = static_cast<double>(n) * 1e9 / 60.0;
    const double late = static_cast<double>(state.now - start) - due;
    ASSERT_GE(late, -0.5) << n;                              // the deadline is rounded to 1 ns
    ASSERT_LE(late, static_cast<double>(kTick) + 0.5) << n;  // one turn of the spin
  }
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(FrameClock, SleepsUntilShortlyBeforeTheDeadlineAndSpinsTheRest) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  const std::int64_t due = state.now + 10'000'000;
  clock.wait();
  ASSERT_EQ(state.sleeps.size(), 1u);
  EXPECT_EQ(state.sleeps[0], due - FrameClock<FakeTime>::kSpin);
  EXPECT_GE(state.now, due);
}

TEST(FrameClock, EndsTheWaitWhenTheSleepIsCutShort) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 0.01);
  state.stopped = true;
  const std::int64_t before = state.now;
  EXPECT_TRUE(clock.wait());
  EXPECT_LE(state.now, before + 2 * kTick);  // no spin through the rest of a hundred seconds
}

TEST(FrameClock, DoesNotSleepWhenTheDeadlineIsNear) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  state.now += 10'000'000 - 100'000;
  EXPECT_TRUE(clock.wait());
  EXPECT_TRUE(state.sleeps.empty());
}

TEST(FrameClock, CatchesUpAfterAFrameThatIsLateByLessThanAPeriod) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  const std::int64_t start = state.now;
  state.now = start + 15'000'000;  // the first frame is half a period late
  EXPECT_FALSE(clock.wait());
  EXPECT_EQ(clock.overruns(), 1u);
  EXPECT_TRUE(clock.wait());  // the second is due where it always was
  EXPECT_NEAR(static_cast<double>(state.now - start), 20e6, 2.0 * kTick);
}

TEST(FrameClock, StartsAfreshAfterALongStallInsteadOfRushing) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  state.now += 1'000'000'000;  // a hundred frames missed
  EXPECT_FALSE(clock.wait());
  const std::int64_t again = state.now;
  for (int n = 1; n <= 5; ++n) {
    EXPECT_TRUE(clock.wait());
    EXPECT_NEAR(static_cast<double>(state.now - again), n * 10e6, 2.0 * kTick);
  }
  EXPECT_EQ(clock.overruns(), 1u);
}

TEST(FrameClock, CountsEveryFrameOfALastingOverload) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  std::uint64_t late = 0;
  for (int n = 0; n < 100; ++n) {
    state.now += 25'000'000;  // each frame takes two and a half periods
    late += clock.wait() ? 0 : 1;
  }
  EXPECT_EQ(late, 100u);
  EXPECT_EQ(clock.overruns(), 100u);
}

TEST(FrameClock, IsNotLateAfterARestart) {
  FakeTime::State state;
  FrameClock clock(FakeTime{&state}, 100.0);
  state.now += 60'000'000'000;  // a pause of a minute
  clock.restart();
  EXPECT_TRUE(clock.wait());
  EXPECT_EQ(clock.overruns(), 0u);
}

}  // namespace
}  // namespace poinsot
