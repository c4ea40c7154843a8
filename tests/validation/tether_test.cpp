// Tethers against nature: damped oscillators, energy, contacts with what is in the way.

#include <algorithm>
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

using test::run_until;

constexpr double kGravity = 9.81;

Tether tether(Eigen::Index column, const Vec3& p_B, const Vec3& target, double stiffness,
              double damping) {
  return {column, p_B, target, stiffness, damping};
}

void set(CollisionLayer& layer, const std::vector<Tether>& tethers) {
  layer.set_tethers(tethers);
}

Scene weightless(std::vector<BodyDef> bodies) {
  Scene scene = test::scene(std::move(bodies));
  scene.simulation.gravity.setZero();
  return scene;
}

// x″ = −2 a x′ − w² x from x and v after t [s]: e^{−at} times cosines or hyperbolic ones.
double oscillator(double w, double a, double x, double v, double t) {
  const std::complex<double> root = std::sqrt(std::complex<double>(w * w - a * a));
  const std::complex<double> angle = root * t;
  const std::complex<double> over = root == 0.0 ? t : std::sin(angle) / root;
  return std::exp(-a * t) * (x * std::cos(angle) + (v + a * x) * over).real();
}

struct Oscillator {
  double stiffness, damping;
};
class TetheredMass : public testing::TestWithParam<Oscillator> {};

TEST_P(TetheredMass, FollowsTheDampedOscillatorAboutItsSag) {
  const auto [k, d] = GetParam();
  constexpr double m = 2;
  BodyDef mass = test::free_body("mass", m, {1, 2, 3});
  mass.pose.c = {0.5, -0.2, 0.3};
  mass.linear_velocity = {1, 2, -3};
  CollisionLayer layer(test::scene({mass}));
  const Vec3 target(0.1, 0.2, 1), sag(0, 0, -m * kGravity / k);
  set(layer, {tether(0, {0, 0, 0}, target, k, d)});
  const double w = std::sqrt(k / m), a = d / (2 * m);
  run_until(layer, 5, [&](const CollisionLayer& now) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double rest = target[axis] + sag[axis];
      ASSERT_NEAR(
          position(now.world().y, 0)[axis],
          rest + oscillator(w, a, mass.pose.c[axis] - rest, mass.linear_velocity[axis], now.time()),
          1e-10)
          << now.time();
    }
  });
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Tether, TetheredMass,
                         testing::Values(Oscillator{50, 0},      // undamped
                                         Oscillator{50, 2},      // under-,
                                         Oscillator{50, 20},     // critically
                                         Oscillator{50, 80},     // and overdamped
                                         Oscillator{5000, 200},  // critically, as a hand does
                                         Oscillator{0.5, 0.1}));

BodyDef spinning_box() {
  BodyDef body = test::box("box", {0.3, 0.1, 0.2}, {0.6, 0.4, 0.2}, 2);
  body.pose.q = Quat(0.8, 0.2, -0.5, 0.26).normalized();
  body.linear_velocity = {0.5, -1, 0.3};
  body.angular_velocity = {2, -1, 3};
  return body;
}

TEST(Tether, AtACornerKeepsEnergyWithoutDamping) {
  CollisionLayer layer(test::scene({spinning_box()}));
  set(layer, {tether(0, {0.3, 0.2, 0.1}, {0, 0, 1}, 200, 0)});
  const double start = layer.energy();
  run_until(layer, 10);
  // Series cut at 1e-14 in each of 600 frames, and rounding.
  EXPECT_NEAR(layer.energy(), start, 600 * 1e-14 * 10 * start);
}

TEST(Tether, AtACornerLosesWhatItsDampingTakes) {
  const std::vector<Tether> tethers{tether(0, {0.3, 0.2, 0.1}, {0, 0, 1}, 200, 4)};
  CollisionLayer layer(test::scene({spinning_box()}));
  set(layer, tethers);
  const double start = layer.energy(), work_at_start = layer.simulation().work();
  // ∫ d |ẋ|² dt by Simpson's rule over pairs of frames.
  const auto power = [&] {
    const World& world = std::as_const(layer).world();
    const Vec3 arm = orientation(world.y, 0) * tethers[0].p_B;
    const Vec3 v = linear_velocity(world, 0) + angular_velocity(world, 0).cross(arm);
    return tethers[0].damping * v.squaredNorm();
  };
  constexpr int kPerSecond = 960;  // an error of h⁴ x⁗/180: the motion has 10 to 30 rad/s
  double taken = 0;
  for (int n = 0; n < kPerSecond; ++n) {
    double sum = power();
    layer.advance_to((n + 0.5) / kPerSecond);
    sum += 4 * power();
    layer.advance_to((n + 1.0) / kPerSecond);
    taken += (sum + power()) / (6 * kPerSecond);
  }
  EXPECT_GT(taken, 0.3 * start);
  EXPECT_NEAR(start - layer.energy(), taken, 1e-8 * taken);
  EXPECT_NEAR(layer.simulation().work() - work_at_start, layer.energy() - start, 1e-11 * start);
}

// A box on the ground, pulled at its middle by a tether whose end runs ahead.
BodyDef on_the_ground() {
  BodyDef box = test::box("box", {0, 0, 0.2}, {0.4, 0.4, 0.4}, 2);
  box.material = {0.5, 0};
  return box;
}

TEST(Tether, WeakerThanFrictionMovesNothing) {
  CollisionLayer layer(test::scene({test::ground(), on_the_ground()}));
  const double most = 0.5 * 2 * kGravity;  // friction [N]
  set(layer, {tether(1, {0, 0, 0}, {0.9 * most / 100, 0, 0.2}, 100, 5)});
  run_until(layer, 3);
  EXPECT_NEAR(position(layer.world().y, 1).x(), 0, 1e-4);
  EXPECT_FALSE(layer.is_asleep(1));
}

TEST(Tether, StrongerThanFrictionSlidesUntilFrictionHoldsIt) {
  // With d = 0 and μ m g < k s it stops, after half a swing, at 2 μ m g / k − s from the target.
  CollisionLayer layer(test::scene({test::ground(), on_the_ground()}));
  const double most = 0.5 * 2 * kGravity, k = 100, stretch = 1.6 * most / k;
  set(layer, {tether(1, {0, 0, 0}, {stretch, 0, 0.2}, k, 0)});
  run_until(layer, 3);
  const double moved = 2 * (stretch - most / k);
  EXPECT_NEAR(position(layer.world().y, 1).x(), moved, 1e-4);
  EXPECT_NEAR(position(layer.world().y, 1).z(), 0.2, 1e-5);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-4);
}

TEST(Tether, DraggedEvenlySlidesBehindByWhatFrictionAsksFor) {
  CollisionLayer layer(test::scene({test::ground(), on_the_ground()}));
  const double most = 0.5 * 2 * kGravity, k = 400, d = 40, speed = 0.5;
  const auto target = [&](double t) { return Vec3(speed * t, 0, 0.2); };
  while (layer.time() < 4) {
    // Where the end is in the middle of the frame: it stands still meanwhile.
    set(layer, {tether(1, {0, 0, 0}, target(layer.time() + 0.5 / test::kFrameRate), k, d)});
    run_until(layer, layer.time() + 1 / test::kFrameRate);
  }
  // k (target − x) − d v = μ m g on average; the end goes in steps.
  const double behind = (most + d * speed) / k;
  EXPECT_NEAR(position(layer.world().y, 1).x(), target(layer.time()).x() - behind, 1e-3);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-3);
}

BodyDef wall() {  // its face is the plane x = 0
  BodyDef body = test::box("wall", {0.5, 0, 0}, {1, 4, 4});
  body.is_static = true;
  body.mass_properties = {};
  body.material = {0, 0};
  return body;
}

double pull_into_the_wall(double stiffness, double damping, double until) {
  BodyDef box = test::box("box", {-1, 0, 0}, {0.4, 0.4, 0.4}, 2);
  box.material = {0, 0};
  CollisionLayer layer(weightless({wall(), box}));
  set(layer, {tether(1, {0, 0, 0}, {0.5, 0, 0}, stiffness, damping)});
  double farthest = -1;
  run_until(layer, until, [&](const CollisionLayer& now) {
    farthest = std::max(farthest, position(now.world().y, 1).x() + 0.2);
  });
  const Vec3 c = position(layer.world().y, 1);
  EXPECT_LT(farthest, 1e-4 * 0.4) << stiffness;
  EXPECT_NEAR(c.x(), -0.2, 1e-4 * 0.4) << stiffness;
  EXPECT_NEAR(c.y(), 0, 1e-6) << stiffness;
  EXPECT_NEAR(std::abs(orientation(layer.world().y, 1).w()), 1, 1e-6) << stiffness;
  std::vector<ContactForce> forces;
  layer.contact_forces(forces);
  double push = 0;
  for (const ContactForce& f : forces) push += f.force.norm();
  return push;
}

TEST(Tether, PullsIntoAWallWithTheForceOfItsStretch) {
  for (const double k : {50.0, 5000.0})
    EXPECT_NEAR(pull_into_the_wall(k, 0.1 * k, 3), 0.7 * k, 1e-3 * k) << k;
}

TEST(Tether, HugePullsIntoAWall) {
  EXPECT_NEAR(pull_into_the_wall(1e9, 1e5, 1), 0.7e9, 1e-3 * 1e9);
}

TEST(Tether, HugeStaysStable) {
  // Critical damping is at 2 √(k m) = 9e4.
  for (const double damping : {0.0, 1e4, 1e5, 1e7}) {
    CollisionLayer layer(test::scene({spinning_box()}));
    const Tether held = tether(0, {0.3, 0.2, 0.1}, {0, 0, 1}, 1e9, damping);
    set(layer, {held});
    const double start = layer.energy();
    run_until(layer, 0.1);
    EXPECT_EQ(layer.simulation().quarantined(), 0u) << damping;
    EXPECT_LE(layer.energy(), start * (1 + 1e-9)) << damping;
    EXPECT_LT(std::abs(layer.energy_error()), 1e-6) << damping;
  }
}

TEST(Tether, ThatIsTakenAwayLeavesFreeFlight) {
  CollisionLayer layer(test::scene({spinning_box()}));
  set(layer, {tether(0, {0.3, 0.2, 0.1}, {0, 0, 1}, 200, 1)});
  run_until(layer, 1);
  const Vec3 c = position(layer.world().y, 0);
  const Vec3 v = linear_velocity(std::as_const(layer).world(), 0);
  set(layer, {});
  run_until(layer, 3);
  EXPECT_EQ(layer.simulation().methods()[0], Method::flight);
  EXPECT_LT((position(layer.world().y, 0) - (c + 2 * v + Vec3(0, 0, -0.5 * kGravity * 4))).norm(),
            1e-13);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-12);
}

TEST(Tether, WakesASleeperAndKeepsItAwake) {
  CollisionLayer layer(test::scene({test::ground(), on_the_ground()}));
  run_until(layer, 2);
  ASSERT_TRUE(layer.is_asleep(1));
  set(layer, {tether(1, {0, 0, 0}, {0, 0, 0.2}, 100, 5)});
  EXPECT_FALSE(layer.is_asleep(1));
  run_until(layer, 4);
  EXPECT_FALSE(layer.is_asleep(1));
  set(layer, {tether(1, {0, 0, 0}, {0, 0, 1}, 1000, 90)});
  run_until(layer, 7);
  EXPECT_NEAR(position(layer.world().y, 1).z(), 1 - 2 * kGravity / 1000, 1e-9);
  set(layer, {});
  run_until(layer, 11);
  EXPECT_TRUE(layer.is_asleep(1));
}

TEST(Tether, MovedInEveryFrameIsTheSameAtAnyThreadCount) {
  const auto ended = [](int threads) {
    std::vector<BodyDef> bodies{test::ground()};
    for (int i = 0; i < 12; ++i) {
      const Vec3 at(0.5 * (i % 3), 0.5 * (i / 3 % 2), 0.2 + 0.45 * (i / 6));
      bodies.push_back(test::box("box" + std::to_string(i), at, {0.4, 0.4, 0.4}, 2));
    }
    Scene scene = test::scene(std::move(bodies));
    scene.collision.threads = threads;
    CollisionLayer layer(scene);
    for (int n = 0; n < 90; ++n) {
      std::vector<Tether> tethers;
      for (const Eigen::Index i : {1, 5, 8, 12})
        tethers.push_back(tether(i, {0.1, 0.2, -0.1}, {0.02 * n, 1, 1 - 0.005 * n}, 100, 10));
      if (n > 45) tethers.pop_back();
      layer.set_tethers(tethers);
      layer.advance_to((n + 1) / test::kFrameRate);
    }
    Hash64 hash;
    const World& world = std::as_const(layer).world();
    hash.add(std::span(world.y.data(), static_cast<std::size_t>(world.y.size())));
    layer.hash_into(hash);
    return hash.value();
  };
  EXPECT_EQ(ended(1), ended(2));
}

}  // namespace
}  // namespace poinsot
