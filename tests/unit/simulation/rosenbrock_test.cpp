#include "poinsot/simulation/rosenbrock.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

using test::SampleSystem;

HeldWrench pushes() {
  HeldWrench held;
  held.in_W.torque = {0.3, -0.5, 0.4};
  held.add_force_at({0.3, -0.2, 0.4}, {2, 1, -3});
  return held;
}

double error_of(const test::ExtendedReference& exact, const SystemState& y) {
  return exact.orientation_error(test::q_of(y)) + exact.position_error(test::c_of(y));
}

Scene tumbling_on_a_spring() {
  Scene scene = test::scene({test::tumbler()});
  scene.springs = {test::spring("tumbler", Vec3(0.3, -0.1, 0.2), "", Vec3(0.5, 1, 3), 25, 2, 1.0)};
  return scene;
}

TEST(Rosenbrock, HasOrderFour) {
  SampleSystem start(tumbling_on_a_spring(), pushes());
  test::ExtendedReference exact = test::reference_of(start.world, test::kQuick);
  exact.advance_to(1);
  std::vector<double> h, error;
  for (int i = 0; i < 5; ++i) {
    const int steps = static_cast<int>(std::lround(60 * std::pow(1.3, i)));
    SampleSystem sample(tumbling_on_a_spring(), pushes());
    Rosenbrock method;
    method.prepare(1);
    for (int n = 0; n < steps; ++n) {
      method.step(sample.system(), sample.y, 1.0 / steps);
      sample.y = method.end();
      sample.y.block<4, 1>(3, 0).normalize();
    }
    h.push_back(1.0 / steps);
    error.push_back(error_of(exact, sample.y));
  }
  EXPECT_NEAR(test::slope(h, error), 4, 0.2);
  RecordProperty("order", std::to_string(test::slope(h, error)));
  RecordProperty("log_errors",
                 std::to_string(std::log10(error[0])) + " " + std::to_string(std::log10(error[4])));
}

// x″ + c x′ + k x = 0 with k = c: a slow mode of rate 1 and one of rate c.
struct Overdamped {
  double c;
  double slow = (c - std::sqrt(c * c - 4 * c)) / 2;
  double fast = c - slow;

  Scene scene() const {
    Scene scene = test::scene({test::free_body("body", 1, {1, 1, 1})});
    scene.simulation.gravity.setZero();
    scene.bodies[0].pose.c = {2, 0, 0};
    scene.springs = {test::spring("body", Vec3::Zero(), "", Vec3::Zero(), c, c, 1.0)};
    return scene;
  }
  // From x = 1 at rest.
  double exact(double t) const {
    return (fast * std::exp(-slow * t) - slow * std::exp(-fast * t)) / (fast - slow);
  }
};

// Steps of 1/20 s while the fast mode decays in 1e-3 … 1e-6 s. L-stable: a step multiplies it by
// some 10/(c h), so that it dies out instead of ringing; its amplitude is 1/c. The slow mode has
// the method's own error, (h γ)⁴ with γ = ¼. Differences that miss the damper's rate fail here.
TEST(Rosenbrock, DampsTheStiffModeInLargeSteps) {
  for (const double c : {1e3, 1e4, 1e6}) {
    const Overdamped spring{c};
    SampleSystem sample(spring.scene());
    Rosenbrock method;
    method.prepare(1);
    const double h = 0.05;
    double worst = 0;
    for (int n = 1; n <= 40; ++n) {
      method.step(sample.system(), sample.y, h);
      sample.y = method.end();
      const double error = std::abs(test::c_of(sample.y).x() - 1 - spring.exact(n * h));
      EXPECT_LE(error, std::pow(10 / (c * h), n) / c + std::pow(h / 4, 4)) << c << " " << n;
      if (n > 10) worst = std::max(worst, error);
    }
    RecordProperty("log_error_1e" + std::to_string(std::lround(std::log10(c))),
                   std::to_string(std::log10(worst)));
  }
}

TEST(Rosenbrock, KeepsItsToleranceOnAStiffSpring) {
  const Overdamped spring{1e5};
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    SampleSystem sample(spring.scene());
    Rosenbrock method;
    method.prepare(1);
    StepMemory memory;
    LocalError error;
    double done = 0;
    ASSERT_TRUE(method.advance(sample.system(), sample.y, 2, tolerance, 3000, memory, error, done));
    EXPECT_EQ(done, 2);
    const double measured = std::abs(test::c_of(sample.y).x() - 1 - spring.exact(2));
    EXPECT_LE(measured, 20 * tolerance);  // a sum of local errors, while the motion forgets them
    EXPECT_LE(measured, error.position + 1e-12);
  }
}

// The embedded third order: its estimate is of order 4 in h, and above the error of the fourth.
TEST(Rosenbrock, EstimatesTheErrorOfAStepFromAbove) {
  std::vector<double> steps, estimates;
  for (const double h : {0.04, 0.02, 0.01, 0.005}) {
    SampleSystem sample(tumbling_on_a_spring(), pushes());
    test::ExtendedReference exact = test::reference_of(sample.world, test::kQuick);
    exact.advance_to(h);
    Rosenbrock method;
    method.prepare(1);
    StepMemory memory;
    LocalError estimate;
    double done = 0;
    ASSERT_TRUE(method.advance(sample.system(), sample.y, h, 1, 1, memory, estimate, done));
    EXPECT_LE(exact.orientation_error(test::q_of(sample.y)), estimate.orientation);
    EXPECT_LE(exact.position_error(test::c_of(sample.y)), estimate.position);
    steps.push_back(h);
    estimates.push_back(estimate.orientation);
  }
  EXPECT_NEAR(test::slope(steps, estimates), 4, 0.3);
  RecordProperty("order_of_estimate", std::to_string(test::slope(steps, estimates)));
}

TEST(Rosenbrock, GivesUpAfterTheMostSteps) {
  SampleSystem sample(tumbling_on_a_spring(), pushes());
  Rosenbrock method;
  method.prepare(1);
  StepMemory memory;
  LocalError error;
  double done = 0;
  EXPECT_FALSE(method.advance(sample.system(), sample.y, 100, 1e-8, 10, memory, error, done));
  EXPECT_LT(done, 100);
}

}  // namespace
}  // namespace poinsot
