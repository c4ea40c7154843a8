#include "poinsot/cli/spread.h"

#include <gtest/gtest.h>

#include "poinsot/cli/delay.h"
#include "poinsot/cli/hz.h"
#include "poinsot/client/loss_counter.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

TEST(SpreadOf, TakesTheNearestRanks) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Spread spread = spread_of(values);
  EXPECT_EQ(spread.p50, 100);
  EXPECT_EQ(spread.p99, 198);
  EXPECT_EQ(spread.max, 200);
  EXPECT_EQ(spread_of({3}).p99, 3);
  EXPECT_EQ(spread_of({}).max, 0);
}

TEST(ArrivalMeter, MeasuresPeriodsAcrossReports) {
  ArrivalMeter meter;
  const ArrivalMeter::Time start{};
  for (int i = 0; i <= 10; ++i) meter.add(start + i * 10ms);
  ArrivalMeter::Report report = meter.take();
  EXPECT_EQ(report.samples, 10u);
  EXPECT_NEAR(report.rate, 100, 1e-9);
  EXPECT_NEAR(report.period.max, 0.01, 1e-12);
  EXPECT_EQ(meter.take().rate, 0);
  meter.add(start + 150ms);
  EXPECT_NEAR(meter.take().period.max, 0.05, 1e-12);
}

TEST(LossCounter, CountsGapsOfOneSession) {
  LossCounter losses;
  losses.add(1, 10);  // what was before is not lost
  losses.add(1, 11);
  EXPECT_EQ(losses.lost(), 0u);
  losses.add(1, 14);
  EXPECT_EQ(losses.lost(), 2u);
  losses.add(2, 1);  // another daemon
  losses.add(2, 3);
  EXPECT_EQ(losses.lost(), 3u);
}

TEST(HzText, GivesRatePeriodsAndLosses) {
  const ArrivalMeter::Report report{60, 60, {1.0 / 60, 0.017, 0.02}};
  EXPECT_EQ(hz_text("poses", report, 3),
            "poses: 60.00 Hz, period p50 16.667, p99 17.000, max 20.000 ms, 3 lost\n");
  EXPECT_EQ(hz_text("report", {}, std::nullopt), "report: nothing came\n");
}

TEST(DelayText, SummarizesAges) {
  EXPECT_EQ(age_text({0.001, 0.002, 0.003}),
            "3 frames, published to received: p50 2, p99 3, max 3 ms\n");
  EXPECT_EQ(seen_text({{2, 0.03}, {3, 0.05}}),
            "2 pushes, sent to seen: p50 2, p99 3, max 3 frames; p50 30, p99 50, max 50 ms\n");
}

}  // namespace
}  // namespace poinsot
