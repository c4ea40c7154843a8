#include "poinsot/service/steady_time.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using namespace std::chrono_literals;

TEST(SteadyTime, SleepsUntilTheDeadlineAndNotLess) {
  const SteadyTime time;
  const std::int64_t deadline = SteadyTime::now() + 120'000'000;  // more than two slices
  EXPECT_TRUE(time.sleep_until(deadline));
  EXPECT_GE(SteadyTime::now(), deadline);
}

TEST(SteadyTime, AStopEndsALongSleepSoon) {
  std::stop_source stop;
  const SteadyTime time{stop.get_token()};
  std::jthread stopper([&] {
    std::this_thread::sleep_for(30ms);
    stop.request_stop();
  });
  const std::int64_t start = SteadyTime::now();
  EXPECT_FALSE(time.sleep_until(start + 3'600'000'000'000));
  EXPECT_LT(SteadyTime::now() - start, 2'000'000'000);
}

}  // namespace
}  // namespace poinsot
