// Both pairs on a body that tumbles through all its axes: their orders, their control of the error.

#include "poinsot/simulation/embedded_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

using test::SampleSystem;

constexpr int kMostSteps = 200000;

struct Pair {
  std::string name;
  const EmbeddedPair* pair;
  int steps;  // of 2 s, the coarsest at which the leading term rules
};

void PrintTo(const Pair& pair, std::ostream* out) {
  *out << pair.name;
}

class EmbeddedPairs : public testing::TestWithParam<Pair> {
 protected:
  const EmbeddedPair& pair() const { return *GetParam().pair; }
};

Scene free_scene() {
  Scene scene = test::scene({test::tumbler()});
  scene.simulation.gravity.setZero();
  return scene;
}

HeldWrench pushes() {
  HeldWrench held;
  held.in_W.torque = {0.3, -0.5, 0.4};
  held.in_B = {{3, -1, 2}, {0.2, 0.1, -0.3}};
  held.add_force_at({0.3, -0.2, 0.4}, {2, 1, -3});
  return held;
}

double error_of(const test::ExtendedReference& exact, const SystemState& y) {
  return exact.orientation_error(test::q_of(y)) + exact.position_error(test::c_of(y));
}

TEST_P(EmbeddedPairs, HaveTheirOrderAtFixedStep) {
  for (const HeldWrench& held : {HeldWrench{}, pushes()}) {
    SampleSystem start(test::scene({test::tumbler()}), held);
    test::ExtendedReference exact = test::reference_of(start.world, test::kQuick);
    exact.advance_to(2);
    std::vector<double> h, error;
    for (int i = 0; i < 5; ++i) {
      const int steps = static_cast<int>(std::lround(GetParam().steps * std::pow(1.3, i)));
      SampleSystem sample(test::scene({test::tumbler()}), held);
      const System system = sample.system();
      EmbeddedRungeKutta method;
      method.prepare(1);
      for (int n = 0; n < steps; ++n) {
        method.step(pair(), system, sample.y, 2.0 / steps);
        sample.y = method.end();
        sample.y.block<4, 1>(3, 0).normalize();
      }
      h.push_back(2.0 / steps);
      error.push_back(error_of(exact, sample.y));
    }
    const double order = test::slope(h, error);
    EXPECT_NEAR(order, pair().order, 0.3);
    RecordProperty(held.is_zero() ? "order_free" : "order_pushed", std::to_string(order));
  }
}

// Between the ends of one step; of the pair's order less one, so that the local error has the
// order.
TEST_P(EmbeddedPairs, InterpolateWithTheOrderLessOne) {
  for (const double theta : {0.25, 0.6}) {
    std::vector<double> h, error;
    for (int i = 0; i < 5; ++i) {
      SampleSystem sample(free_scene(), pushes());
      const System system = sample.system();
      test::ExtendedReference exact = test::reference_of(sample.world);
      EmbeddedRungeKutta method;
      method.prepare(1);
      const double step = 2 * 1.5 / GetParam().steps * std::pow(1.3, -i);
      method.step(pair(), system, sample.y, step);
      SystemState at;
      method.dense(pair(), system, sample.y, step, theta, at);
      exact.advance_to(theta * step);
      h.push_back(step);
      error.push_back(error_of(exact, at));
    }
    EXPECT_NEAR(test::slope(h, error), pair().order, 0.4);
    RecordProperty("order_" + std::to_string(theta), std::to_string(test::slope(h, error)));
  }
}

TEST_P(EmbeddedPairs, InterpolateToBothEnds) {
  SampleSystem sample(free_scene(), pushes());
  const System system = sample.system();
  EmbeddedRungeKutta method;
  method.prepare(1);
  method.step(pair(), system, sample.y, 0.05);
  SystemState at, end = method.end();
  end.block<4, 1>(3, 0).normalize();
  method.dense(pair(), system, sample.y, 0.05, 0, at);
  EXPECT_LE((at - sample.y).norm(), 1e-14);
  method.dense(pair(), system, sample.y, 0.05, 1, at);
  EXPECT_LE((at - end).norm(), 1e-14);
}

// What the pair calls the error of a step, against the error of the step.
TEST_P(EmbeddedPairs, KeepTheErrorOfEachStepWithinTenTimesTheTolerance) {
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    SampleSystem sample(free_scene());
    const System system = sample.system();
    EmbeddedRungeKutta method;
    method.prepare(1);
    StepMemory memory;
    memory.h = 1e-3;
    double worst = 0, least = 1e9, t = 0;
    std::vector<double> estimates;  // over the tolerance
    for (int n = 0; t < 20 && n < 2000; ++n) {
      const SystemState from = sample.y;
      const Vec3 L = test::L_of(from);
      test::ExtendedReference exact(test::reference_body(sample.world), test::c_of(from),
                                    test::q_of(from), test::P_of(from), L, test::kQuick);
      LocalError estimate;
      double done = 0;
      const double h = memory.h;
      ASSERT_TRUE(method.advance(pair(), system, sample.y, h, tolerance, kMostSteps, memory,
                                 estimate, done));
      exact.advance_to(h);
      const double momentum =
          (Vec3(sample.y.block<3, 1>(10, 0)) - exact.angular_momentum_B()).norm();
      const double relative =
          std::max(exact.orientation_error(test::q_of(sample.y)), momentum / L.norm()) / tolerance;
      worst = std::max(worst, relative);
      if (n > 5) {  // once the step has found its size
        least = std::min(least, relative);
        // After a refusal the rest of the call is a short step, which tells nothing.
        if (memory.h >= h) estimates.push_back(memory.last_error);
      }
      t += h;
    }
    EXPECT_LE(worst, 10) << tolerance;
    // The estimate is that of the lower order, so the error may be far below the tolerance. Steps
    // may not be far shorter than they must be: most are at least half as long as they could be.
    std::nth_element(estimates.begin(), estimates.begin() + std::ssize(estimates) / 2,
                     estimates.end());
    const double median = estimates[estimates.size() / 2];
    EXPECT_GE(median, std::pow(0.5, pair().error_order + 1)) << tolerance;
    RecordProperty("median_estimate_1e" + std::to_string(std::lround(std::log10(tolerance))),
                   std::to_string(median));
    RecordProperty("local_over_tolerance_1e" + std::to_string(std::lround(std::log10(tolerance))),
                   std::to_string(least) + " .. " + std::to_string(worst));
  }
}

TEST_P(EmbeddedPairs, LoseGloballyInProportionToTheTolerance) {
  test::ExtendedReference exact = test::reference_of(SampleSystem(free_scene()).world);
  exact.advance_to(20);
  std::vector<double> tolerances, errors;
  std::string record;
  for (int e = 3; e <= 11; ++e) {
    SampleSystem sample(free_scene());
    EmbeddedRungeKutta method;
    method.prepare(1);
    StepMemory memory;
    LocalError estimate;
    double done = 0;
    tolerances.push_back(std::pow(10.0, -e));
    ASSERT_TRUE(method.advance(pair(), sample.system(), sample.y, 20, tolerances.back(), kMostSteps,
                               memory, estimate, done));
    errors.push_back(exact.orientation_error(test::q_of(sample.y)));
    record += std::to_string(std::log10(errors.back())) + " ";
  }
  const double measured = test::slope(tolerances, errors);
  EXPECT_NEAR(measured, 1, 0.2);
  RecordProperty("slope", std::to_string(measured));
  RecordProperty("log_errors", record);
}

// Called in frames, as the layer does: the step that a frame's end cuts short is not the next one.
TEST_P(EmbeddedPairs, KeepTheirStepOverCalls) {
  constexpr double kTight = 1e-12;
  const auto run = [&](int calls) {
    SampleSystem sample(free_scene());
    EmbeddedRungeKutta method;
    method.prepare(1);
    StepMemory memory;
    LocalError estimate;
    for (int n = 0; n < calls; ++n) {
      double done = 0;
      EXPECT_TRUE(method.advance(pair(), sample.system(), sample.y, 1.0 / calls, kTight, kMostSteps,
                                 memory, estimate, done));
      EXPECT_EQ(done, 1.0 / calls);
    }
    return memory;
  };
  const StepMemory once = run(1), often = run(60);
  EXPECT_GT(often.h, once.h / 2);
  EXPECT_LT(often.h, once.h * 2);
  EXPECT_NE(often.last_error, 1);  // the memory of the controller
  EXPECT_FALSE(often.stiff);
}

TEST_P(EmbeddedPairs, FindASpringStiffThatIsOverdamped) {
  Scene scene = test::scene({test::free_body("body", 1, {1, 1, 1})});
  scene.simulation.gravity.setZero();
  scene.bodies[0].pose.c = {2, 0, 0};
  // 1 m beyond its rest, it creeps back in a second while the damper's rate is 1e4/s.
  scene.springs = {test::spring("body", Vec3::Zero(), "", Vec3::Zero(), 1e4, 1e4, 1.0)};
  SampleSystem sample(scene);
  EmbeddedRungeKutta method;
  method.prepare(1);
  StepMemory memory;
  LocalError estimate;
  double done = 0;
  EXPECT_FALSE(method.advance(pair(), sample.system(), sample.y, 1, 1e-6, kMostSteps, memory,
                              estimate, done));
  EXPECT_TRUE(memory.stiff);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 0.2);
  EXPECT_NEAR(test::c_of(sample.y).x(), 1 + std::exp(-done), 1e-3);  // as far as `done` says
}

TEST_P(EmbeddedPairs, GiveUpAfterTheMostSteps) {
  SampleSystem sample(free_scene());
  EmbeddedRungeKutta method;
  method.prepare(1);
  StepMemory memory;
  memory.h = 1e-3;
  LocalError estimate;
  double done = 0;
  EXPECT_FALSE(
      method.advance(pair(), sample.system(), sample.y, 20, 1e-10, 50, memory, estimate, done));
  EXPECT_FALSE(memory.stiff);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 20);
}

// A first step of a day overflows in its stages: it is refused, and shorter ones succeed.
TEST_P(EmbeddedPairs, RecoverFromAStepThatOverflows) {
  Scene scene = free_scene();
  scene.bodies[0].angular_velocity *= 1e9;
  SampleSystem sample(scene);
  EmbeddedRungeKutta method;
  method.prepare(1);
  StepMemory memory;
  memory.h = 1e30;
  LocalError estimate;
  double done = 0;
  EXPECT_TRUE(method.advance(pair(), sample.system(), sample.y, 1e-7, 1e-9, kMostSteps, memory,
                             estimate, done));
  memory.h = 1e30;
  done = 0;
  EXPECT_FALSE(
      method.advance(pair(), sample.system(), sample.y, 1e30, 1e-9, 200, memory, estimate, done));
  EXPECT_TRUE(sample.y.allFinite());
}

std::string name_of_pair(const testing::TestParamInfo<Pair>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(All, EmbeddedPairs,
                         testing::Values(Pair{"dopri5", &kDopri5, 80},
                                         Pair{"dop853", &kDop853, 16}),
                         name_of_pair);

TEST(RelativeError, MeasuresEachQuantityAgainstItsOwnScale) {
  SampleSystem sample(free_scene());
  const System system = sample.system();
  SystemState rate(17, 1), error = SystemState::Zero(17, 1);
  system.derivative(sample.y, rate);
  const auto measure = [&] {
    return relative_error(system, sample.y, sample.y, rate, error, 1e-3, 1e-6);
  };
  EXPECT_EQ(measure(), 0);
  error(4, 0) = 1e-6;  // half the angle
  EXPECT_NEAR(measure(), 2e-6, 1e-18);
  error.setZero();
  error(11, 0) = 1e-6;
  EXPECT_NEAR(measure(), 1e-6 / test::L_of(sample.y).norm(), 1e-18);
  error.setZero();
  error(1, 0) = 1e-6;
  EXPECT_NEAR(measure(), 1e-6 / test::c_of(sample.y).norm(), 1e-18);
  error.setZero();
  error(13, 0) = error(16, 0) = 1;  // work and impulse follow from the motion
  EXPECT_EQ(measure(), 0);
}

TEST(RelativeError, IsNoNumberForAnErrorThatIsNone) {
  SampleSystem sample(free_scene());
  const System system = sample.system();
  for (const Eigen::Index row : {0, 4, 7, 11}) {
    SystemState error = SystemState::Zero(17, 1);
    error(row, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(std::isfinite(
        relative_error(system, sample.y, sample.y, SystemState::Zero(17, 1), error, 1, 1e-6)))
        << row;
  }
}

}  // namespace
}  // namespace poinsot
