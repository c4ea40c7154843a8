// The equations of motion of a system against those of mechanics: what is conserved, what is not.

#include "poinsot/simulation/body_system.h"

#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/taylor.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

using test::SampleSystem;

// Two bodies, a spring with everything between them, drag on neither.
Scene pair_scene(double damping) {
  Scene scene = test::scene({test::tumbler(), test::free_body("other", 0.7, {0.3, 0.4, 0.5})});
  scene.simulation.gravity.setZero();
  scene.bodies[1].pose = {{1, 1, 1}, Quat(0.1, -0.2, 0.3, 0.9).normalized()};
  scene.bodies[1].linear_velocity = {-1, 0.3, 0.2};
  scene.bodies[1].angular_velocity = {0.5, -2, 1};
  scene.springs = {
      test::spring("tumbler", Vec3(0.3, -0.1, 0.2), "other", Vec3(0, 0.2, 0.1), 15, damping, 0.5)};
  return scene;
}

SystemState rate_of(SampleSystem& sample) {
  SystemState rate(17, sample.y.cols());
  sample.system().derivative(sample.y, rate);
  return rate;
}

Vec3 total_momentum(const SystemState& y) {
  return test::P_of(y, 0) + test::P_of(y, 1);
}

Vec3 total_angular_momentum(const SystemState& y) {
  Vec3 sum = Vec3::Zero();
  for (const Eigen::Index i : {0, 1})
    sum += test::L_of(y, i) + Vec3(test::c_of(y, i)).cross(Vec3(test::P_of(y, i)));
  return sum;
}

double energy_of(SampleSystem& sample) {
  scatter(sample.y, 0, sample.world.y, 0);
  scatter(sample.y, 1, sample.world.y, 1);
  return kinetic_energy(sample.world) + potential_energy(sample.world);
}

TEST(BodySystem, HasForcesThatAreOppositeAndCollinear) {
  SampleSystem sample(pair_scene(2));
  const SystemState rate = rate_of(sample);
  const Vec3 on_a = rate.block<3, 1>(7, 0), on_b = rate.block<3, 1>(7, 1);
  EXPECT_EQ(on_a, -on_b);
  EXPECT_GT(on_a.norm(), 1);
  // Along the line between the points, and with the moments of a force there.
  const SpringLink& spring = sample.system().springs[0];
  const Vec3 arm_a = test::q_of(sample.y, 0) * spring.p_a;
  const Vec3 arm_b = test::q_of(sample.y, 1) * spring.p_b;
  const Vec3 d = test::c_of(sample.y, 0) + arm_a - (test::c_of(sample.y, 1) + arm_b);
  EXPECT_NEAR(on_a.cross(d).norm(), 0, 1e-14 * on_a.norm() * d.norm());
  EXPECT_NEAR((Vec3(rate.block<3, 1>(14, 0)) - arm_a.cross(on_a)).norm(), 0, 1e-14);
  EXPECT_NEAR((Vec3(rate.block<3, 1>(14, 1)) - arm_b.cross(on_b)).norm(), 0, 1e-14);
}

// Forces and torques as the world reports them, for bodies on which everything acts.
TEST(BodySystem, FeelsWhatTheWorldSaysActsOnIt) {
  Scene scene = pair_scene(2);
  scene.simulation.gravity = {0, 0, -9.81};
  scene.bodies[0].drag = {0.5, 0.3, 0.2};
  HeldWrench held;
  held.in_W = {{1, 2, 3}, {0.3, -0.5, 0.4}};
  held.in_B = {{3, -1, 2}, {0.2, 0.1, -0.3}};
  held.add_force_at({0.3, -0.2, 0.4}, {2, 1, -3});
  SampleSystem sample(scene, held);
  const SystemState rate = rate_of(sample);
  for (const Eigen::Index i : {0, 1}) {
    const Wrench acting = acting_wrench(sample.world, i);
    EXPECT_NEAR((rate.block<3, 1>(7, i) - acting.force).norm(), 0, 1e-14 * acting.force.norm());
    EXPECT_NEAR((rate.block<3, 1>(14, i) - acting.torque).norm(), 0, 4e-15 * 20);  // Σ |p| |F|
    const Vec3 m = sample.y.block<3, 1>(10, i);
    const Vec3 omega = sample.world.inv_J_B[static_cast<std::size_t>(i)] * m;
    const Vec3 torque_B = test::q_of(sample.y, i).conjugate() * acting.torque;
    EXPECT_NEAR((rate.block<3, 1>(10, i) - (m.cross(omega) + torque_B)).norm(), 0, 1e-13);
    EXPECT_NEAR((rate.block<3, 1>(0, i) - linear_velocity(sample.world, i)).norm(), 0, 1e-15);
    const Eigen::Vector4d turning =
        quaternion_rate(test::q_of(sample.y, i), angular_velocity(sample.world, i));
    EXPECT_NEAR((rate.block<4, 1>(3, i) - turning).norm(), 0, 1e-14);
  }
}

TEST(BodySystem, FeelsContactsBesidesWhatIsHeld) {
  World world(test::scene({test::tumbler()}));
  world.held[0].in_W = {{1, 0, 0}, {0, 2, 0}};
  const SystemBody body = system_body(world, 0, {{0, 4, 0}, {0, 0, 5}});
  EXPECT_EQ(body.push.in_W.force, Vec3(1, 4, 0));
  EXPECT_EQ(body.push.in_W.torque, Vec3(0, 2, 5));
  EXPECT_TRUE(body.couple_in_W);
  EXPECT_FALSE(body.force_in_B || body.torque_in_B || body.at_points || body.dragged);
}

// The length of the quaternion is no part of the motion.
TEST(BodySystem, DoesNotMindAQuaternionThatIsNotUnit) {
  SampleSystem sample(pair_scene(2));
  const SystemState unit = rate_of(sample);
  sample.y.block<4, 1>(3, 0) *= 1 + 1e-3;
  const SystemState longer = rate_of(sample);
  EXPECT_NEAR((unit.middleRows<10>(7) - longer.middleRows<10>(7)).norm(), 0, 1e-13);
}

TEST(BodySystem, ReturnsToTheWorldWhatItTook) {
  SampleSystem sample(pair_scene(0));
  StateArray back = StateArray::Zero(13, 2);
  for (const Eigen::Index i : {0, 1}) scatter(sample.y, i, back, i);
  EXPECT_EQ(back.topRows<10>(), sample.world.y.topRows<10>());
  EXPECT_NEAR((back - sample.world.y).norm(), 0, 4e-15);
  EXPECT_TRUE(sample.y.bottomRows<4>().isZero(0));
}

// 600 steps whose rounding is 2e-16 of sizes up to 10 each.
constexpr double kRounding = 600 * 2e-16 * 10;

TEST(BodySystem, KeepsMomentaAndEnergyOfAPair) {
  for (const double damping : {0.0, 0.8}) {
    SampleSystem sample(pair_scene(damping));
    const System system = sample.system();
    const Vec3 P = total_momentum(sample.y), L = total_angular_momentum(sample.y);
    const double energy = energy_of(sample);
    TaylorSeries taylor;
    taylor.prepare(2, 1);
    LocalError error;
    for (int n = 0; n < 600; ++n)
      ASSERT_TRUE(taylor.advance(system, sample.y, 1.0 / 60, 1e-15, 64, error));
    EXPECT_NEAR((total_momentum(sample.y) - P).norm(), 0, kRounding);
    EXPECT_NEAR((total_angular_momentum(sample.y) - L).norm(), 0, kRounding);
    // What is missing is what the damper says it took.
    const double work = sample.y(13, 0) + sample.y(13, 1);
    EXPECT_NEAR(energy_of(sample) - energy, work, kRounding * energy);
    if (damping > 0)
      EXPECT_LT(work, -0.1);
    else
      EXPECT_EQ(work, 0);
  }
}

}  // namespace
}  // namespace poinsot
