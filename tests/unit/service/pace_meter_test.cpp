#include "poinsot/service/pace_meter.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr std::int64_t kMs = 1'000'000;  // [ns]

TEST(RecentValues, TellsTheQuantilesOfTheLastValues) {
  RecentValues values;
  EXPECT_EQ(values.spread().max, 0);
  values.add(7);
  EXPECT_EQ(values.spread().p50, 7);
  EXPECT_EQ(values.spread().p99, 7);
  // 1 … 1024 in an order that is not theirs; the 7 falls out of the window.
  for (int n = 0; n < 1024; ++n) values.add((n * 381) % 1024 + 1);
  EXPECT_EQ(values.spread().p50, 512);
  EXPECT_EQ(values.spread().p99, 1014);  // the smallest of which 99 % are not larger
  EXPECT_EQ(values.spread().max, 1024);
}

TEST(PaceMeter, MeasuresOverTheInstantAndSinceTheRestart) {
  std::int64_t now = 5 * kMs;
  PaceMeter meter(100, now);
  EXPECT_EQ(meter.factor(), 0);
  EXPECT_EQ(meter.window_factor(), 0);
  for (int n = 0; n < 100; ++n) meter.frame(now += 10 * kMs);  // 100 frames of 10 ms: factor 1
  EXPECT_NEAR(meter.factor(), 1, 1e-12);
  EXPECT_NEAR(meter.window_factor(), 1, 1e-12);
  for (int n = 0; n < 45; ++n) meter.frame(now += 20 * kMs);  // half as fast
  EXPECT_NEAR(meter.factor(), 0.5, 1e-12);
  EXPECT_GT(meter.window_factor(), 0.5);
  EXPECT_LT(meter.window_factor(), 1);
  meter.restart(now);
  EXPECT_EQ(meter.factor(), 0);
  for (int n = 0; n < 45; ++n) meter.frame(now += 20 * kMs);
  EXPECT_NEAR(meter.window_factor(), 0.5, 1e-12);
}

TEST(PaceMeter, TheWindowForgetsWhatIsOlderThanTenSeconds) {
  std::int64_t now = 0;
  PaceMeter meter(100, now);
  for (int n = 0; n < 1000; ++n) meter.frame(now += 10 * kMs);
  for (int n = 0; n < 600; ++n) meter.frame(now += 20 * kMs);  // 12 s at half the pace
  EXPECT_NEAR(meter.window_factor(), 0.5, 1e-12);
}

TEST(PaceMeter, OneFrameThatTakesLongerThanTheWindowIsMeasuredNevertheless) {
  std::int64_t now = 0;
  PaceMeter meter(100, now);
  meter.frame(now += 40'000 * kMs);
  EXPECT_NEAR(meter.factor(), 10e-3 / 40, 1e-15);
  EXPECT_NEAR(meter.window_factor(), 10e-3 / 40, 1e-15);
}

TEST(PaceMeter, KeepsLatenessAndWorkInSeconds) {
  PaceMeter meter(100, 0);
  meter.paced(2 * kMs, 3 * kMs);
  EXPECT_NEAR(meter.lateness().p50, 2e-3, 1e-18);
  EXPECT_NEAR(meter.frame_time().max, 3e-3, 1e-18);
}

}  // namespace
}  // namespace poinsot
