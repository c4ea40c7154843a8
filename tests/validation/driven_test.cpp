// Driven bodies against nature: pushes constant over frames, drag, springs.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/extended_reference.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

BodyDef tumbling() {
  BodyDef body = test::free_body("body", 1, {1, 2, 3});
  body.angular_velocity = {1, 3, 2};
  return body;
}

Scene weightless(std::vector<BodyDef> bodies) {
  Scene scene = test::scene(std::move(bodies));
  scene.simulation.gravity.setZero();
  return scene;
}

struct Errors {
  double position = 0;     // [m]
  double orientation = 0;  // [rad]
};

// The largest errors over 20 s of frames of 1/60 s under a wrench that is held for all of it.
Errors pushed(const HeldWrench& held) {
  const BodyDef body = tumbling();
  SimulationLayer layer(weightless({body}));
  layer.world().held[0] = held;
  test::ExtendedReference reference =
      test::reference_of({.mass = 1, .J_B = body.mass_properties.J, .held = held}, Vec3::Zero(),
                         Quat::Identity(), Vec3::Zero(), body.angular_velocity);
  Errors worst;
  for (int n = 1; n <= 1200; ++n) {
    layer.advance_to(n / 60.0);
    if (n % 60 != 0) continue;
    reference.advance_to(n / 60.0);
    worst.orientation =
        std::max(worst.orientation, reference.orientation_error(orientation(layer.world().y, 0)));
    worst.position =
        std::max(worst.position, reference.position_error(position(layer.world().y, 0)));
  }
  return worst;
}

// What the layer promises for 20 s. It is not more than the method allows: series cut at 1e-14 in
// each of 1200 frames, and neighbouring motions that part by up to a thousand, could give 1e-8.
constexpr double kPromised = 1e-10;  // [rad], [m]

TEST(Pushed, ByACoupleInTheWorldAndAForceInTheBodyIsExact) {
  HeldWrench held;
  held.in_W.torque = {0.3, -0.2, 0.1};
  held.in_B.force = {0.5, 0, 0.2};
  const Errors errors = pushed(held);
  EXPECT_LT(errors.orientation, kPromised);
  EXPECT_LT(errors.position, kPromised);
}

TEST(Pushed, ByAForceConstantInTheWorldAtABodyPointIsExact) {
  HeldWrench held;
  held.add_force_at({0.1, 0.2, 0.3}, {0.5, -0.3, 0.2});
  const Errors errors = pushed(held);
  EXPECT_LT(errors.orientation, kPromised);
  EXPECT_LT(errors.position, kPromised);
}

TEST(Pushed, ByACoupleInTheBodyIsExact) {
  HeldWrench held;
  held.in_B.torque = {0.2, 0.1, -0.3};
  EXPECT_LT(pushed(held).orientation, kPromised);
}

SimulationLayer run(const Scene& scene, double seconds) {
  SimulationLayer layer(scene);
  for (int n = 1; n <= std::lround(seconds * 60); ++n) layer.advance_to(n / 60.0);
  return layer;
}

TEST(Drag, LinearFollowsTheExponential) {
  BodyDef body = test::free_body("body", 2, {1, 2, 3});
  body.linear_velocity = {3, 0, 0};
  body.drag = {.linear = 0.4};
  const SimulationLayer layer = run(test::scene({body}), 10);
  const double k = 0.4 / 2, t = 10, g = 9.81, decayed = 1 - std::exp(-k * t);
  const Vec3 c = position(layer.world().y, 0);
  EXPECT_NEAR(c.x(), 3 / k * decayed, 1e-10);
  EXPECT_NEAR(c.z(), -g / k * (t - decayed / k), 1e-10);
  EXPECT_NEAR(momentum(layer.world().y, 0).z() / 2, -g / k * decayed, 1e-10);
}

TEST(Drag, QuadraticFromRestReachesTerminalVelocity) {
  BodyDef body = test::free_body("body", 2, {1, 2, 3});
  body.drag = {.quadratic = 0.3};
  const SimulationLayer layer = run(test::scene({body}), 5);
  const double g = 9.81, terminal = std::sqrt(2 * g / 0.3), x = g * 5 / terminal;
  EXPECT_NEAR(momentum(layer.world().y, 0).z() / 2, -terminal * std::tanh(x), 1e-10);
  EXPECT_NEAR(position(layer.world().y, 0).z(), -terminal * terminal / g * std::log(std::cosh(x)),
              1e-10);
}

TEST(Drag, QuadraticThrownUpwardsPassesTheTop) {
  // Up: v′ = −g (1 + v²/w²), down: v′ = −g (1 − v²/w²), with terminal speed w.
  BodyDef body = test::free_body("body", 2, {1, 2, 3});
  body.drag = {.quadratic = 0.3};
  body.linear_velocity = {0, 0, 10};
  const SimulationLayer layer = run(test::scene({body}), 3);
  const double g = 9.81, w = std::sqrt(2 * g / 0.3);
  const double t_top = w / g * std::atan(10 / w);
  const double height = w * w / (2 * g) * std::log(1 + 100 / (w * w));
  const double x = g * (3 - t_top) / w;
  EXPECT_NEAR(momentum(layer.world().y, 0).z() / 2, -w * std::tanh(x), 1e-10);
  EXPECT_NEAR(position(layer.world().y, 0).z(), height - w * w / g * std::log(std::cosh(x)), 1e-10);
}

TEST(Drag, AngularSlowsATopExponentially) {
  BodyDef body = test::free_body("body", 1, {2, 2, 3});
  body.angular_velocity = {0, 0, 5};
  body.drag = {.angular = 0.5};
  const SimulationLayer layer = run(weightless({body}), 4);
  EXPECT_NEAR(angular_momentum(layer.world().y, 0).z(), 15 * std::exp(-0.5 / 3 * 4), 1e-12);
}

SpringDef spring(double stiffness, double damping, double rest) {
  SpringDef def;
  def.a = "body";
  def.stiffness = stiffness;
  def.damping = damping;
  def.rest_length = rest;
  return def;
}

TEST(Spring, OscillatesAsTheCosine) {
  BodyDef body = test::free_body("body", 2, {1, 2, 3});
  body.pose.c = {1.5, 0, 0};
  Scene scene = weightless({body});
  scene.springs = {spring(50, 0, 1)};
  const SimulationLayer layer = run(scene, 10);
  EXPECT_NEAR(position(layer.world().y, 0).x(), 1 + 0.5 * std::cos(5 * 10.0), 1e-10);
}

TEST(Spring, DampedDecaysAsItShould) {
  BodyDef body = test::free_body("body", 2, {1, 2, 3});
  body.pose.c = {1.5, 0, 0};
  Scene scene = weightless({body});
  scene.springs = {spring(50, 2, 1)};
  const SimulationLayer layer = run(scene, 10);
  const double decay = 2.0 / (2 * 2), omega = std::sqrt(25 - decay * decay), t = 10;
  EXPECT_NEAR(
      position(layer.world().y, 0).x(),
      1 + 0.5 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t)),
      1e-10);
}

TEST(Spring, StiffAndOverdampedIsFollowedImplicitly) {
  // x″ = −2000 x′ − 1000 x about the rest length: rates 0.50013 and 1999.5 1/s.
  BodyDef body = test::free_body("body", 1, {1, 2, 3});
  body.pose.c = {1.5, 0, 0};
  Scene scene = weightless({body});
  scene.springs = {spring(1e6, 2e6, 1)};
  const SimulationLayer layer = run(scene, 2);
  const double half = 1e6, root = std::sqrt(half * half - 1e6);
  const double slow = 1e6 / (half + root), fast = half + root;
  const double x = 0.5 * (fast * std::exp(-slow * 2) - slow * std::exp(-fast * 2)) / (fast - slow);
  EXPECT_EQ(layer.methods()[0], Method::rosenbrock);
  EXPECT_TRUE(layer.is_stiff());
  EXPECT_NEAR(position(layer.world().y, 0).x(), 1 + x, 1e-8);
}

TEST(Spring, APairOfBodiesKeepsEnergyAndBothMomenta) {
  BodyDef a = tumbling();
  BodyDef b = test::free_body("other", 2, {3, 1, 2.5});
  b.angular_velocity = {-1, 2, 0.5};
  b.pose.c = {2, 0, 0};
  Scene scene = weightless({a, b});
  SpringDef def = spring(30, 0, 1);
  def.b = "other";
  def.point_a = {0.3, 0.1, 0};
  def.point_b = {-0.2, 0.3, 0.1};
  scene.springs = {def};
  const auto totals = [](const World& world) {
    Vec3 P = Vec3::Zero(), L = Vec3::Zero();
    for (Eigen::Index i = 0; i < world.size(); ++i) {
      const Vec3 c = position(world.y, i), p = momentum(world.y, i);
      P += p;
      L += angular_momentum(world.y, i) + c.cross(p);
    }
    return std::pair(P, L);
  };
  const SimulationLayer start(scene);
  const auto [P0, L0] = totals(start.world());
  const double E0 = kinetic_energy(start.world()) + potential_energy(start.world());
  const SimulationLayer layer = run(scene, 10);
  const auto [P, L] = totals(layer.world());
  const double E = kinetic_energy(layer.world()) + potential_energy(layer.world());
  const double rounding = 600 * 1e-14;  // one frame's series and rounding, times frames
  EXPECT_LT((P - P0).norm(), rounding * 10);
  EXPECT_LT((L - L0).norm(), rounding * 10);
  EXPECT_NEAR(E, E0, rounding * E0);
}

}  // namespace
}  // namespace poinsot
