#include "poinsot/cli/pace.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

using namespace std::chrono_literals;

const Pace::Time kStart{1h};

int passed(double rate, std::chrono::nanoseconds frame, int frames) {
  Pace pace(rate);
  int count = 0;
  for (int i = 0; i < frames; ++i)
    if (pace.is_due(kStart + i * frame)) ++count;
  return count;
}

TEST(Pace, LetsEveryFrameThroughByDefault) {
  EXPECT_EQ(passed(0, 16'666'667ns, 600), 600);
}

TEST(Pace, ThinsEvenlyToItsRate) {
  EXPECT_EQ(passed(10, 16'666'667ns, 600), 100);  // 10 s
  EXPECT_EQ(passed(30, 16'666'667ns, 600), 300);
}

TEST(Pace, LetsAllThroughWhenFramesAreSlower) {
  EXPECT_EQ(passed(100, 50ms, 20), 20);
}

TEST(Pace, DoesNotMakeUpForAGap) {
  Pace pace(10);
  EXPECT_TRUE(pace.is_due(kStart));
  EXPECT_TRUE(pace.is_due(kStart + 10s));
  EXPECT_FALSE(pace.is_due(kStart + 10s + 10ms));
}

TEST(FrameMeter, MeasuresTheRateOfArrival) {
  FrameMeter meter;
  EXPECT_EQ(meter.rate(kStart), 0);
  for (int i = 0; i < 600; ++i) meter.add(kStart + i * 20ms);
  EXPECT_NEAR(meter.rate(kStart + 600 * 20ms), 50, 1e-9);
}

TEST(FrameMeter, FallsToZeroWhenNothingComes) {
  FrameMeter meter;
  for (int i = 0; i < 10; ++i) meter.add(kStart + i * 20ms);
  EXPECT_EQ(meter.rate(kStart + 1min), 0);
}

}  // namespace
}  // namespace poinsot
