// All integrators over one table: their order, their conserved quantities, their end time.

#include "poinsot/simulation/integrator.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/scene/strategies.h"
#include "support/closed_forms.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

struct Method {
  IntegratorKind kind;
  double order;
};

class Integrators : public testing::TestWithParam<Method> {
 protected:
  // State after `duration` of steps h, under the world's own held wrench.
  StateArray run(const World& world, double duration, double h) const {
    const std::vector<Wrench> no_contacts(static_cast<std::size_t>(world.size()));
    Integrator integrator = make_integrator(GetParam().kind, world.size());
    StateArray y = world.y;
    integrate(integrator, {world, no_contacts}, y, duration, h);
    return y;
  }

  // Observed order of the orientation's error when h is halved.
  double order(const World& world, const Quat& exact, double duration, double h) const {
    const double coarse = angle_between(Quat(orientation(run(world, duration, h), 0)), exact);
    const double fine = angle_between(Quat(orientation(run(world, duration, h / 2), 0)), exact);
    return std::log2(coarse / fine);
  }
};

TEST_P(Integrators, TurnASymmetricTopWithTheirOrder) {
  BodyDef top = test::free_body("top", 1, {2, 2, 1});
  const Vec3 omega_B(1, 0.5, 3);
  top.angular_velocity = omega_B;
  const World world(test::scene({top}));
  const Quat exact = test::symmetric_top(Quat::Identity(), 2, 1, omega_B, 1.0);
  EXPECT_NEAR(order(world, exact, 1.0, 1.0 / 256), GetParam().order, 0.1);
}

TEST_P(Integrators, TurnUnderABodyTorqueWithTheirOrder) {
  // A torque about a principal axis at rest spins it up: angle ½ τ/J t², exact.
  World world(test::scene({test::free_body("disc", 1, {2, 2, 1})}));
  world.held[0].in_B.torque = {0, 0, 6};
  const Quat exact(Eigen::AngleAxisd(3.0, Vec3::UnitZ()));
  EXPECT_NEAR(order(world, exact, 1.0, 1.0 / 64), GetParam().order, 0.1);
}

TEST_P(Integrators, ConserveMomentumOfAFreeBodyToRounding) {
  BodyDef body = test::free_body("free", 3, {1, 2, 2.5});
  body.linear_velocity = {1, 2, 3};
  body.angular_velocity = {3, -1, 2};
  Scene scene = test::scene({body});
  scene.simulation.gravity.setZero();
  const World world(scene);
  const StateArray y = run(world, 10, 1e-2);
  EXPECT_NEAR((momentum(y, 0) - momentum(world.y, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((angular_momentum(y, 0) - angular_momentum(world.y, 0)).norm(), 0, 1e-14);
}

TEST_P(Integrators, KeepOrientationsUnit) {
  BodyDef body = test::free_body("free", 1, {1, 2, 2.5});
  body.angular_velocity = {3, -10, 20};
  const World world(test::scene({body}));
  EXPECT_NEAR(Quat(orientation(run(world, 10, 1e-2), 0)).norm(), 1, 4e-16);
}

TEST_P(Integrators, LeaveStaticBodiesUntouchedBitForBit) {
  BodyDef still = test::body("still", Box{{1, 2, 3}}, {0.1, 0.2, 0.3});
  still.is_static = true;
  still.pose.q = Quat(0.1, 0.2, 0.3, 0.4).normalized();
  const World world(test::scene({still, test::body("falls", Sphere{1}, {0, 0, 9})}));
  EXPECT_EQ(run(world, 1, 1e-2).col(0), world.y.col(0));
}

TEST_P(Integrators, GainMomentumByForceTimesTime) {
  // F t exactly, whatever the method and the step; relative rounding of 100 sums.
  Scene scene = test::scene({test::free_body("free", 4, {1, 2, 2.5})});
  scene.simulation.gravity.setZero();
  World world(scene);
  world.held[0].add_force_at({0.1, 0.2, 0.3}, {5, -6, 7});
  const StateArray y = run(world, 0.7, 7e-3);
  EXPECT_NEAR((momentum(y, 0) - 0.7 * Vec3(5, -6, 7)).norm(), 0, 1e-13);
}

std::string method_name(const testing::TestParamInfo<Method>& info) {
  return std::string(name_of<IntegratorKind>(kIntegratorNames, info.param.kind));
}

INSTANTIATE_TEST_SUITE_P(All, Integrators,
                         testing::Values(Method{IntegratorKind::rk4, 4},
                                         Method{IntegratorKind::semi_implicit_euler, 1}),
                         method_name);

TEST(IntegratorTable, IsCoveredByThisSuite) {
  EXPECT_EQ(kIntegratorNames.size(), 2u);
}

TEST(StepCount, IsTheLeastThatKeepsStepsShortEnough) {
  EXPECT_EQ(step_count(1.0 / 60, 1.0 / 240), 4);
  EXPECT_EQ(step_count(1.0 / 60, 1.0), 1);
  EXPECT_EQ(step_count(1.0, 0.3), 4);
  EXPECT_EQ(step_count(7.0 / 60 - 6.0 / 60, 1.0 / 240), 4);  // whole but for rounding
}

}  // namespace
}  // namespace poinsot
