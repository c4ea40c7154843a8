#include "poinsot/study/measure.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/scene_builder.h"
#include "unit/study/study_samples.h"

namespace poinsot {
namespace {

using enum IntegratorKind;
using Clock = std::chrono::steady_clock;

Scene tumbling() {
  BodyDef body = test::free_body("body", 2, Vec3(1, 2, 3));
  body.angular_velocity = Vec3(1, 3, 2);
  Scene scene = test::scene({body});
  scene.collision.contact_step = 1;  // `step` alone sets the error
  return scene;
}

RunLimit patient() {
  return {Clock::now() + std::chrono::minutes(10), {}};
}

Reference reference_of(const Scene& scene) {
  return make_reference(scene, {test::setting(rk4, 1. / 3840), test::setting(rk4, 1. / 1920)},
                        {.frames = 120, .limit = {1, 1}, .deadline = patient().deadline}, {});
}

double orientation_error(IntegratorKind kind, double step) {
  const Scene scene = tumbling();
  const auto m = measure(scene, test::setting(kind, step), reference_of(scene), patient());
  return m->row.measured.orientation;
}

// The order of the method is what halving the step twice shows, once the step is small enough: the
// next term of the error is smaller by h |ω|, here 1/60 · 4 and less.
TEST(Measure, ErrorsFallWithTheOrderOfTheMethod) {
  const double rk4_order =
      std::log2(orientation_error(rk4, 1. / 120) / orientation_error(rk4, 1. / 480)) / 2;
  const double euler_order = std::log2(orientation_error(semi_implicit_euler, 1. / 960) /
                                       orientation_error(semi_implicit_euler, 1. / 3840)) /
                             2;
  EXPECT_NEAR(rk4_order, 4, 0.3);
  EXPECT_NEAR(euler_order, 1, 0.1);
}

TEST(Measure, OfTheReferenceItselfFindsNoError) {
  const Scene scene = tumbling();
  const auto m = measure(scene, test::setting(rk4, 1. / 3840), reference_of(scene), patient());
  ASSERT_TRUE(m);
  EXPECT_EQ(m->row.measured, PoseError{});
  EXPECT_EQ(m->row.runs, 1u);
  EXPECT_GT(m->row.cost.simulation, 0);
}

TEST(Measure, GivesUpWhenItIsLateOrStopped) {
  const Scene scene = tumbling();
  const Reference reference = reference_of(scene);
  const RunLimit late{Clock::now() - std::chrono::seconds(1), {}};
  EXPECT_FALSE(measure(scene, test::setting(rk4, 0.01), reference, late));
  std::stop_source stop;
  stop.request_stop();
  const RunLimit stopped{patient().deadline, stop.get_token()};
  EXPECT_FALSE(measure(scene, test::setting(rk4, 0.01), reference, stopped));
}

// A hundred frames of almost a million steps each take half a minute or more: that is known after
// the first.
TEST(Measure, GivesUpWhenItIsBoundToBeLate) {
  const Scene scene = tumbling();
  const Reference reference = reference_of(scene);
  const auto start = Clock::now();
  const RunLimit limit{start + std::chrono::seconds(5), {}};
  EXPECT_FALSE(measure(scene, test::setting(rk4, 2e-8), reference, limit));
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(4));
}

TEST(MeasureCost, TakesTheMedianOfSeveralRuns) {
  Row row = test::row(test::setting(rk4, 0.01), {}, 0);
  measure_cost(row, tumbling(), 120, patient());
  EXPECT_GE(row.runs, 3u);
  EXPECT_GT(row.cost.simulation, 0);
}

TEST(MeasureCost, KeepsWhatThereIsIfThereIsNoTime) {
  Row row = test::row(test::setting(rk4, 0.01), {}, 7);
  row.runs = 1;
  measure_cost(row, tumbling(), 120, {Clock::now() - std::chrono::seconds(1), {}});
  EXPECT_EQ(row.runs, 1u);
  EXPECT_EQ(row.cost.simulation, 7e-6);
}

TEST(CostOf, IsWithoutTheClockInProportion) {
  LayerTimes times;
  times.simulation.cpu_s = 6;
  times.collision.cpu_s = 3;
  times.contact.cpu_s = 1;
  const Cost cost = cost_of(times, 2, 50, 0.1);  // half of the time was the clock's
  EXPECT_NEAR(cost.simulation, 1.5, 1e-12);
  EXPECT_NEAR(cost.collision, 0.75, 1e-12);
  EXPECT_NEAR(cost.contact, 0.25, 1e-12);
  EXPECT_EQ(cost_of(times, 2, 50, 1).simulation, 0);
  EXPECT_EQ(cost_of({}, 2, 50, 0.1).simulation, 0);
}

TEST(ClockCost, IsSmallerThanAFrameOfAnythingAndNotNothing) {
  EXPECT_GT(clock_cost(), 1e-9);
  EXPECT_LT(clock_cost(), 1e-4);
}

TEST(Median, IsTheRunInTheMiddle) {
  std::array<Cost, 5> costs = {Cost{5, 1, 0}, {1, 2, 0}, {3, 3, 0}, {100, 4, 0}, {2, 5, 0}};
  const Cost middle = median(costs);
  EXPECT_EQ(middle.simulation, 3);
  EXPECT_EQ(middle.collision, 3);
}

}  // namespace
}  // namespace poinsot
