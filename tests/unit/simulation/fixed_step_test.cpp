// Orders of the methods of fixed step, what they keep, and their estimate of the error.

#include "poinsot/simulation/fixed_step.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/closed_forms.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

using test::SampleSystem;

struct Kind {
  IntegratorKind kind;
  int order;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  *out << name_of<IntegratorKind>(kIntegratorNames, kind.kind);
}

class FixedSteps : public testing::TestWithParam<Kind> {
 protected:
  IntegratorKind kind() const { return GetParam().kind; }

  void run(SampleSystem& sample, double duration, int steps) const {
    const System system = sample.system();
    FixedStep method;
    method.prepare(system.size());
    for (int n = 0; n < steps; ++n) method.step(kind(), system, sample.y, duration / steps);
  }

  // Observed order between steps of 1/n and shorter ones.
  template <class Error>
  double order(const Scene& scene, const HeldWrench& held, int n, Error&& error_of) const {
    std::vector<double> h, error;
    for (const int steps : {n, 2 * n, 4 * n}) {
      SampleSystem sample(scene, held);
      run(sample, 1, steps);
      h.push_back(1.0 / steps);
      error.push_back(error_of(sample));
    }
    return test::slope(h, error);
  }
};

HeldWrench pushes() {
  HeldWrench held;
  held.in_W.torque = {0.3, -0.5, 0.4};
  held.in_B = {{3, -1, 2}, {0.2, 0.1, -0.3}};
  held.add_force_at({0.3, -0.2, 0.4}, {2, 1, -3});
  return held;
}

TEST_P(FixedSteps, TurnASymmetricTopWithTheirOrder) {
  BodyDef top = test::free_body("top", 1, {2, 2, 1});
  top.angular_velocity = {1, 0.5, 3};
  const Quat exact = test::symmetric_top(Quat::Identity(), 2, 1, {1, 0.5, 3}, 1);
  const double measured = order(test::scene({top}), {}, 512, [&](const SampleSystem& sample) {
    return angle_between(test::q_of(sample.y), exact);
  });
  EXPECT_NEAR(measured, GetParam().order, 0.1);
  RecordProperty("order", std::to_string(measured));
}

TEST_P(FixedSteps, FollowEveryPushWithTheirOrder) {
  const Scene scene = test::scene({test::tumbler()});
  test::ExtendedReference exact =
      test::reference_of(SampleSystem(scene, pushes()).world, test::kQuick);
  exact.advance_to(1);
  const double measured = order(scene, pushes(), 512, [&](const SampleSystem& sample) {
    return exact.orientation_error(test::q_of(sample.y)) +
           exact.position_error(test::c_of(sample.y));
  });
  EXPECT_NEAR(measured, GetParam().order, 0.1);
  RecordProperty("order", std::to_string(measured));
}

// Work against the change of energy, with an error of the method's order: the root of the mean
// square over a few spins, because the difference of a single one may pass through zero.
TEST_P(FixedSteps, MeasureWorkWithTheirOrder) {
  std::vector<double> h, error;
  for (const int steps : {64, 128, 256}) {
    double squares = 0;
    for (const double faster : {0.5, 0.7, 0.9, 1.1, 1.3, 1.5}) {
      Scene scene = test::scene({test::tumbler()});
      scene.simulation.gravity.setZero();
      scene.bodies[0].angular_velocity *= faster;
      SampleSystem sample(scene, pushes());
      const double before = test::kinetic_energy_of(sample.system(), sample.y);
      run(sample, 1, steps);
      const double after = test::kinetic_energy_of(sample.system(), sample.y);
      squares += std::pow(after - before - sample.y(13, 0), 2);
    }
    h.push_back(1.0 / steps);
    error.push_back(std::sqrt(squares));
  }
  EXPECT_NEAR(test::slope(h, error), GetParam().order, 0.2);
  RecordProperty("order", std::to_string(test::slope(h, error)));
}

TEST_P(FixedSteps, GainMomentumByForceTimesTime) {
  Scene scene = test::scene({test::free_body("free", 4, {1, 2, 2.5})});
  scene.simulation.gravity.setZero();
  HeldWrench held;
  held.add_force_at({0.1, 0.2, 0.3}, {5, -6, 7});
  SampleSystem sample(scene, held);
  run(sample, 0.7, 100);
  EXPECT_LE((test::P_of(sample.y) - 0.7 * Vec3(5, -6, 7)).norm(), 1e-13);  // 100 sums
}

TEST_P(FixedSteps, KeepOrientationsUnit) {
  Scene scene = test::scene({test::tumbler()});
  SampleSystem sample(scene);
  run(sample, 10, 1000);
  EXPECT_NEAR(test::q_of(sample.y).norm(), 1, 4e-16);
}

// |once − twice| is (1 − 2⁻ᵖ) of the error of the longer step: a half, or fifteen sixteenths.
TEST_P(FixedSteps, EstimateTheErrorOfAStepWithinAFactorThree) {
  for (const double h : {1.0 / 60, 1.0 / 240}) {
    SampleSystem sample(test::scene({test::tumbler()}), pushes());
    test::ExtendedReference exact = test::reference_of(sample.world, test::kQuick);
    exact.advance_to(h);
    FixedStep method;
    method.prepare(1);
    const SystemState before = sample.y;
    const LocalError estimate = method.compare(kind(), sample.system(), sample.y, h);
    EXPECT_EQ(sample.y, before);
    method.step(kind(), sample.system(), sample.y, h);
    const double turned = exact.orientation_error(test::q_of(sample.y));
    EXPECT_GE(estimate.orientation, turned / 3);
    EXPECT_LE(estimate.orientation, turned * 3);
    const double moved = exact.position_error(test::c_of(sample.y));
    EXPECT_GE(estimate.position, moved / 3);
    EXPECT_LE(estimate.position, moved * 3);
    RecordProperty("estimate_over_error", std::to_string(estimate.orientation / turned));
  }
}

std::string name_of_kind(const testing::TestParamInfo<Kind>& info) {
  return std::string(name_of<IntegratorKind>(kIntegratorNames, info.param.kind));
}
INSTANTIATE_TEST_SUITE_P(All, FixedSteps,
                         testing::Values(Kind{IntegratorKind::rk4, 4},
                                         Kind{IntegratorKind::semi_implicit_euler, 1},
                                         Kind{IntegratorKind::explicit_euler, 1}),
                         name_of_kind);

TEST(FixedStepTable, IsCoveredByThisSuite) {
  int fixed = 0;
  for (const auto& row : kIntegratorNames) fixed += is_adaptive(row.value) ? 0 : 1;
  EXPECT_EQ(fixed, 3);
}

// L in W is what it carries over a step: 1000 turnings to B and back round a little each.
TEST(SemiImplicitEuler, KeepsTheAngularMomentumOfAFreeBody) {
  SampleSystem sample(test::scene({test::tumbler()}));
  const Vec3 L = test::L_of(sample.y);
  FixedStep method;
  method.prepare(1);
  for (int n = 0; n < 1000; ++n)
    method.step(IntegratorKind::semi_implicit_euler, sample.system(), sample.y, 1e-2);
  EXPECT_LE((test::L_of(sample.y) - L).norm(), 1000 * 2e-16 * L.norm());
}

TEST(StepCount, IsTheLeastThatKeepsStepsShortEnough) {
  EXPECT_EQ(step_count(1.0 / 60, 1.0 / 240), 4);
  EXPECT_EQ(step_count(1.0 / 60, 1.0), 1);
  EXPECT_EQ(step_count(0, 1.0), 1);
  EXPECT_EQ(step_count(1.0, 0.3), 4);
  EXPECT_EQ(step_count(7.0 / 60 - 6.0 / 60, 1.0 / 240), 4);  // whole but for rounding
}

}  // namespace
}  // namespace poinsot
