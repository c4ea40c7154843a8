// The series against a reference of 113 bits: order, accuracy, what it refuses.

#include "poinsot/simulation/taylor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "unit/simulation/sample_system.h"

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
  scene.springs = {
      test::spring("tumbler", Vec3(0.3, -0.1, 0.2), "", Vec3(0.5, 1, 3), 25, damping, rest)};
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

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class TaylorCases : public testing::TestWithParam<Case> {};

double error_of(const test::ExtendedReference& exact, const SystemState& y) {
  return exact.orientation_error(test::q_of(y)) + exact.position_error(test::c_of(y));
}

void move(TaylorSeries& taylor, const System& system, SystemState& y, int order, double h) {
  taylor.expand(system, y, order);
  taylor.evaluate(system, h, y);
}

struct Errors {
  std::vector<double> h, error;
};

// Steps ever shorter, down to where rounding begins to show.
template <class ErrorOf>
Errors errors_above_rounding(double longest, ErrorOf&& error_of_step) {
  Errors seen;
  for (double h = longest; seen.h.size() < 60; h /= 1.08) {
    const double error = error_of_step(h);
    if (error < 3e-13) break;
    if (!(error < 1e-5)) continue;
    seen.h.push_back(h);
    seen.error.push_back(error);
  }
  EXPECT_GE(seen.h.size(), 8u);
  return seen;
}

// error = C hⁿ (1 + a h + b h² …): steps that tell orders of 16 from rounding are not short, so the
// next two terms are fitted too.
double leading_power(const Errors& seen) {
  const auto rows = static_cast<Eigen::Index>(seen.h.size());
  Eigen::MatrixXd A(rows, 4);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double x = seen.h[static_cast<std::size_t>(i)] / seen.h[0];
    A.row(i) << 1, std::log(x), x, x * x;
    b(i) = std::log(seen.error[static_cast<std::size_t>(i)]);
  }
  return A.colPivHouseholderQr().solve(b)(1);
}

TEST_P(TaylorCases, HaveTheOrderTheyAreAskedForInEachStep) {
  for (const int order : {6, 10, 16}) {
    const double measured = leading_power(errors_above_rounding(1, [&](double h) {
      SampleSystem sample(GetParam().scene, GetParam().held);
      test::ExtendedReference exact = test::reference_of(sample.world, test::kQuick);
      exact.advance_to(h);
      TaylorSeries taylor;
      taylor.prepare(1, 1);
      move(taylor, sample.system(), sample.y, order, h);
      return error_of(exact, sample.y);
    }));
    EXPECT_NEAR(measured, order + 1, 0.3);
    RecordProperty("local_order_" + std::to_string(order), std::to_string(measured));
  }
}

TEST_P(TaylorCases, HaveTheOrderTheyAreAskedForOverManySteps) {
  constexpr double kDuration = 2;
  constexpr int kOrder = 6;
  SampleSystem start(GetParam().scene, GetParam().held);
  test::ExtendedReference exact = test::reference_of(start.world, test::kQuick);
  exact.advance_to(kDuration);
  Errors seen;
  for (int steps = 40; steps <= 320; steps *= 2) {
    SampleSystem sample(GetParam().scene, GetParam().held);
    TaylorSeries taylor;
    taylor.prepare(1, 1);
    for (int n = 0; n < steps; ++n)
      move(taylor, sample.system(), sample.y, kOrder, kDuration / steps);
    seen.h.push_back(kDuration / steps);
    seen.error.push_back(error_of(exact, sample.y));
  }
  EXPECT_NEAR(test::slope(seen.h, seen.error), kOrder, 0.3);
  RecordProperty("global_order_6", std::to_string(test::slope(seen.h, seen.error)));
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
  scene.springs = {
      test::spring("tumbler", Vec3(0.3, -0.1, 0.2), "other", Vec3(0, 0.2, 0.1), 15, 0.5, 0.5)};
  const auto run = [&](int order, double duration, int steps) {
    SampleSystem sample(scene);
    TaylorSeries taylor;
    taylor.prepare(2, 1);
    for (int n = 0; n < steps; ++n)
      move(taylor, sample.system(), sample.y, order, duration / steps);
    return SystemState(sample.y);
  };
  for (const int order : {6, 10, 16}) {
    const double measured = leading_power(errors_above_rounding(
        0.5, [&](double h) { return (run(order, h, 1) - run(18, h, 10)).topRows<13>().norm(); }));
    EXPECT_NEAR(measured, order + 1, 0.3);
    RecordProperty("local_order_" + std::to_string(order), std::to_string(measured));
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

// Thrown up, it stands still after some 0.09 s: the series of |v| would go on to negative speeds.
TEST(Taylor, RefusesQuadraticDragThroughStandstill) {
  Scene scene = with_drag({0, 0.2, 0});
  scene.bodies[0].linear_velocity = {0, 0, 0.9};
  TaylorSeries taylor;
  taylor.prepare(1, 0);
  LocalError error;
  SampleSystem before(scene), through(scene);
  EXPECT_TRUE(taylor.advance(before.system(), before.y, 0.05, kTolerance, kMostSteps, error));
  EXPECT_FALSE(taylor.advance(through.system(), through.y, 0.2, kTolerance, kMostSteps, error));
}

TEST(Taylor, RefusesASpringWithoutLengthThatHasADirection) {
  Scene scene = test::scene({test::free_body("body", 2, {1, 2, 3})});
  scene.springs = {test::spring("body", Vec3::Zero(), "", Vec3::Zero(), 10, 0, 1.0)};
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
