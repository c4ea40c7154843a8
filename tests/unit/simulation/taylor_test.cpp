// The series against a reference of 113 bits: order, accuracy, what it refuses.

#include "poinsot/simulation/taylor.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "simulation/sample_system.h"

namespace poinsot {
namespace {

using test::SampleSystem;

constexpr double kTolerance = 1e-15;  // what the simulation layer asks for
constexpr int kMostSteps = 64;

HeldWrench couple_in_W() {
  HeldWrench held;
  held.in_W.torque = {0.3, -0.5, 0.4};
  return held;
}
HeldWrench push_in_B() {
  HeldWrench held;
  held.in_B = {{3, -1, 2}, {0.2, 0.1, -0.3}};
  return held;
}
HeldWrench force_at_point() {
  HeldWrench held;
  held.add_force_at({0.3, -0.2, 0.4}, {2, 1, -3});
  return held;
}
HeldWrench everything() {
  HeldWrench held = force_at_point();
  held.in_W.torque = couple_in_W().in_W.torque;
  held.in_B = push_in_B().in_B;
  return held;
}

struct Case {
  std::string name;
  Scene scene;
  HeldWrench held;
};

Scene with_drag(const DragDef& drag) {
  Scene scene = test::scene({test::tumbler()});
  scene.bodies[0].drag = drag;
  return scene;
}

Scene on_spring(double rest, double damping) {
  Scene scene = test::scene({test::tumbler()});
  scene.springs = {{.a = "tumbler",
                    .point_a = {0.3, -0.1, 0.2},
                    .point_b = {0.5, 1, 3},
                    .stiffness = 25,
                    .damping = damping,
                    .rest_length = rest}};
  return scene;
}

std::vector<Case> cases() {
  const Scene plain = test::scene({test::tumbler()});
  return {{"free", plain, {}},
          {"couple_in_W", plain, couple_in_W()},
          {"push_in_B", plain, push_in_B()},
          {"force_at_point", plain, force_at_point()},
          {"linear_drag", with_drag({0.5, 0, 0.3}), {}},
          {"quadratic_drag", with_drag({0.1, 0.2, 0.3}), everything()},
          {"linear_spring", on_spring(0, 0), {}},
          {"damped_spring", on_spring(1, 2), everything()}};
}

class TaylorCases : public testing::TestWithParam<Case> {};

// Error of the orientation after `steps` equal steps over `duration` at a fixed order.
double fixed_error(const Case& c, int order, double duration, int steps,
                   const test::ExtendedReference& exact) {
  SampleSystem sample(c.scene, c.held);
  const System system = sample.system();
  TaylorSeries taylor;
  taylor.prepare(system.bodies.size(), system.springs.size());
  for (int n = 0; n < steps; ++n) {
    taylor.expand(system, sample.y, order);
    taylor.evaluate(system, duration / steps, sample.y);
  }
  return exact.orientation_error(test::q_of(sample.y)) +
         exact.position_error(test::c_of(sample.y));
}

TEST_P(TaylorCases, HaveTheOrderTheyAreAskedFor) {
  SampleSystem start(GetParam().scene, GetParam().held);
  test::ExtendedReference exact = test::reference_of(start.world, test::kQuick);
  constexpr double kDuration = 2;
  exact.advance_to(kDuration);
  // Steps that are short enough for the leading term and long enough to stay above rounding.
  struct Range {
    int order, first, count;
  };
  for (const Range& range : {Range{6, 64, 4}, Range{10, 32, 4}, Range{16, 22, 4}}) {
    std::vector<double> h, error;
    for (int i = 0; i < range.count; ++i) {
      const int steps = static_cast<int>(std::lround(range.first * std::pow(1.3, i)));
      h.push_back(kDuration / steps);
      error.push_back(fixed_error(GetParam(), range.order, kDuration, steps, exact));
    }
    const double order = test::slope(h, error);
    EXPECT_NEAR(order, range.order, 0.3);
    RecordProperty("order_" + std::to_string(range.order), std::to_string(order));
    RecordProperty("error_" + std::to_string(range.order),
                   std::to_string(std::log10(error.front())) + " " + std::to_string(std::log10(error.back())));
  }
}

// In frames, as the simulation layer does: 1200 sums of states of size 20 m and 1 rad round to
// 1200 · 2e-16 at most, errors grow with time besides.
TEST_P(TaylorCases, AreExactButForRounding) {
  SampleSystem sample(GetParam().scene, GetParam().held);
  const System system = sample.system();
  test::ExtendedReference exact = test::reference_of(sample.world, test::kQuick);
  const double before = test::kinetic_energy_of(system, sample.y);
  const Vec3 L = test::L_of(sample.y), c = test::c_of(sample.y);
  double elastic = 0;
  for (const BodySystem& s : sample.world.systems) elastic = spring_energy(sample.world, s);
  TaylorSeries taylor;
  taylor.prepare(1, 1);
  LocalError error;
  constexpr double kDuration = 2;
  for (int n = 0; n < 120; ++n)
    ASSERT_TRUE(taylor.advance(system, sample.y, 1.0 / 60, kTolerance, kMostSteps, error));
  exact.advance_to(kDuration);
  constexpr double kRounding = 120 * 2.2e-16;
  EXPECT_LE(exact.orientation_error(test::q_of(sample.y)), 10 * kRounding);
  EXPECT_LE(exact.position_error(test::c_of(sample.y)), 20 * kRounding);
  EXPECT_LE(error.orientation, 120 * 100 * kTolerance);  // a sum of last terms

  // Work, and what gravity and the springs gave, is the change of kinetic energy.
  scatter(sample.y, 0, sample.world.y, 0);
  for (const BodySystem& s : sample.world.systems) elastic -= spring_energy(sample.world, s);
  const double gained = test::kinetic_energy_of(system, sample.y) - before;
  const double fallen = sample.world.mass[0] * sample.world.gravity.dot(test::c_of(sample.y) - c);
  EXPECT_NEAR(sample.y(13, 0) + fallen + elastic, gained, 4 * kRounding * (200 + std::abs(gained)));
  const Vec3 impulse = sample.y.block<3, 1>(14, 0);
  EXPECT_LE((impulse - (test::L_of(sample.y) - L)).norm(), 20 * kRounding * (10 + L.norm()));
}

std::string name_of_case(const testing::TestParamInfo<Case>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(All, TaylorCases, testing::ValuesIn(cases()), name_of_case);

// Springs between bodies: no reference of one body, so the series of order 18 in small steps is it.
TEST(Taylor, HasItsOrderForTwoBodiesOnASpring) {
  Scene scene = test::scene({test::tumbler(), test::free_body("other", 0.7, {0.3, 0.4, 0.5})});
  scene.bodies[1].pose.c = {1, 1, 1};
  scene.springs = {{.a = "tumbler",
                    .b = "other",
                    .point_a = {0.3, -0.1, 0.2},
                    .point_b = {0, 0.2, 0.1},
                    .stiffness = 15,
                    .damping = 0.5,
                    .rest_length = 0.5}};
  const auto run = [&](int order, int steps) {
    SampleSystem sample(scene);
    const System system = sample.system();
    TaylorSeries taylor;
    taylor.prepare(2, 1);
    for (int n = 0; n < steps; ++n) {
      taylor.expand(system, sample.y, order);
      taylor.evaluate(system, 1.0 / steps, sample.y);
    }
    return SystemState(sample.y);
  };
  const SystemState exact = run(18, 200);
  for (const auto& [order, first] : {std::pair{6, 64}, std::pair{10, 40}}) {
    std::vector<double> h, error;
    for (int i = 0; i < 4; ++i) {
      const int steps = static_cast<int>(std::lround(first * std::pow(1.3, i)));
      h.push_back(1.0 / steps);
      error.push_back((run(order, steps) - exact).topRows<13>().norm());
    }
    const double measured = test::slope(h, error);
    EXPECT_NEAR(measured, order, 0.3);
    RecordProperty("order_" + std::to_string(order), std::to_string(measured));
  }
}

TEST(Taylor, DividesALongStepByTheDecay) {
  SampleSystem sample(test::scene({test::tumbler()}), everything());
  const System system = sample.system();
  test::ExtendedReference exact = test::reference_of(sample.world, test::kQuick);
  exact.advance_to(3);
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  LocalError error;
  ASSERT_TRUE(taylor.advance(system, sample.y, 3, kTolerance, kMostSteps, error));
  EXPECT_LE(exact.orientation_error(test::q_of(sample.y)), 1e-12);
  EXPECT_LE(exact.position_error(test::c_of(sample.y)), 1e-12);
}

TEST(Taylor, RefusesWhatWouldNeedTooManySteps) {
  Scene scene = test::scene({test::tumbler()});
  scene.bodies[0].angular_velocity *= 1e4;
  SampleSystem sample(scene, everything());
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  LocalError error;
  EXPECT_FALSE(taylor.advance(sample.system(), sample.y, 1, kTolerance, kMostSteps, error));
}

TEST(Taylor, RefusesQuadraticDragAtRest) {
  Scene scene = with_drag({0, 0.2, 0});
  scene.bodies[0].linear_velocity.setZero();
  SampleSystem sample(scene);
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  LocalError error;
  EXPECT_FALSE(taylor.advance(sample.system(), sample.y, 0.01, kTolerance, kMostSteps, error));
  scene.bodies[0].drag = {0.2, 0, 0};  // linear drag has no kink
  SampleSystem linear(scene);
  EXPECT_TRUE(taylor.advance(linear.system(), linear.y, 0.01, kTolerance, kMostSteps, error));
}

TEST(Taylor, RefusesASpringWithoutLengthThatHasADirection) {
  Scene scene = test::scene({test::free_body("body", 2, {1, 2, 3})});
  scene.springs = {{.a = "body", .stiffness = 10, .rest_length = 1.0}};
  TaylorSeries taylor;
  taylor.prepare(1, 1);
  LocalError error;
  SampleSystem stretched(scene);
  EXPECT_FALSE(
      taylor.advance(stretched.system(), stretched.y, 0.01, kTolerance, kMostSteps, error));
  scene.springs[0].rest_length = 0;  // linear: no direction is needed
  SampleSystem slack(scene);
  EXPECT_TRUE(taylor.advance(slack.system(), slack.y, 0.01, kTolerance, kMostSteps, error));
}

TEST(Taylor, ChangesNothingInNoTime) {
  SampleSystem sample(test::scene({test::tumbler()}), everything());
  const SystemState before = sample.y;
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  LocalError error;
  EXPECT_TRUE(taylor.advance(sample.system(), sample.y, 0, kTolerance, kMostSteps, error));
  EXPECT_EQ(sample.y, before);
}

// Its last term, at the order it stopped at, is the error of a series one order shorter.
TEST(Taylor, EstimatesItsErrorByTheLastTerms) {
  SampleSystem sample(test::scene({test::tumbler()}), everything());
  const System system = sample.system();
  test::ExtendedReference exact = test::reference_of(sample.world);
  constexpr double kStep = 0.1;
  exact.advance_to(kStep);
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  for (const int order : {4, 6, 8}) {
    taylor.expand(system, sample.y, order);
    const LocalError estimate = taylor.last_terms(system, kStep);
    SystemState shorter = sample.y;
    taylor.expand(system, sample.y, order - 1);
    taylor.evaluate(system, kStep, shorter);
    // |R| of a matrix is √2 of the angle; the next term adds its ratio, about a third here.
    EXPECT_LE(exact.orientation_error(test::q_of(shorter)), 2 * estimate.orientation);
    EXPECT_GE(exact.orientation_error(test::q_of(shorter)), estimate.orientation / 8);
    EXPECT_LE(exact.position_error(test::c_of(shorter)), 2 * estimate.position);
  }
}

}  // namespace
}  // namespace poinsot
