// Bounds against dense sampling of the motions that they bound.

#include "poinsot/simulation/motion_bound.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/simulation/simulation_layer.h"
#include "support/scene_builder.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

struct Free {
  Vec3 moments;
  Quat q;
  Vec3 L;  // in W
};

class Samples {
 public:
  explicit Samples(const Free& body)
      : J_(body.moments.asDiagonal()),
        L_(body.L),
        axes_(principal_axes(J_)),
        rotation_(axes_, body.q, body.L),
        bound(rotation_bound(axes_, body.q.toRotationMatrix(), body.L)) {}

  Mat3 R(double t) const { return rotation_.at(t).toRotationMatrix(); }
  Vec3 omega_B(double t) const { return omega_of(R(t).transpose() * L_); }
  // |ω′|: the same in W and in B.
  double alpha(double t) const {
    const Vec3 m = R(t).transpose() * L_;
    return omega_of(m.cross(omega_of(m))).norm();
  }

 private:
  Vec3 omega_of(const Vec3& m) const { return m.cwiseQuotient(J_.diagonal()); }

  Mat3 J_;
  Vec3 L_;
  PrincipalAxes axes_;
  TorqueFree rotation_;

 public:
  RotationBound bound;
};

// What sampling itself gets wrong: R is right to some 1e-15, and R(t)ᵀ L with it.
constexpr double kSampling = 1e-13;

class Bodies {
 public:
  Vec3 direction() {
    return Vec3(normal_(random_), normal_(random_), normal_(random_)).normalized();
  }
  Quat turn() {
    return Quat(normal_(random_), normal_(random_), normal_(random_), normal_(random_))
        .normalized();
  }
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random_);
  }

  // Generic, needles, discs, tops, spheres, near the unstable axis.
  Free next() {
    Free body;
    body.q = turn();
    const double a = between(0.1, 1), b = between(0.1, 1);
    body.moments = {a, b, std::abs(a - b) + between(0, 1) * (a + b - std::abs(a - b))};
    const int kind = count_++ % 6;
    if (kind == 1) body.moments = {std::pow(10, between(-6, -1)), 1, 1 + 1e-7};
    if (kind == 2) body.moments = {1, 1 + 1e-6, 2};
    if (kind == 3) body.moments = {1, 1, between(0.1, 2)};
    if (kind == 4) body.moments = {1, 1, 1};
    Vec3 m = between(0.1, 5) * direction();
    if (kind == 5) {
      body.moments = {1, 2, 3};
      m = {std::pow(10, between(-12, -1)), 4, std::pow(10, between(-12, -1))};
    }
    // A needle along its axis would turn 1e6 rad in a second: bounds hold whatever the scale.
    body.L = body.q * m;
    return body;
  }

 private:
  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  int count_ = 0;
};

TEST(RotationBound, IsNeverExceededByAnyFlight) {
  Bodies bodies;
  for (int i = 0; i < 300; ++i) {
    const Samples body(bodies.next());
    const RotationBound& bound = body.bound;
    const double horizon = 40 / bound.omega;
    for (int n = 0; n < 100; ++n) {
      const double t = bodies.between(0, horizon);
      const Vec3 omega = body.omega_B(t);
      EXPECT_LE(omega.norm(), bound.omega * (1 + kSampling));
      EXPECT_LE(body.alpha(t), bound.alpha + kSampling * bound.omega * bound.omega);
      const Vec3 axis = body.R(t).transpose() * bound.axis;
      EXPECT_NEAR(omega.dot(axis), bound.along, kSampling * bound.omega);
      EXPECT_LE((omega - omega.dot(axis) * axis).norm(),
                bound.perp + std::sqrt(kSampling) * 1e-3 * bound.omega);
    }
  }
}

// The polhode's end: reached twice or four times in every period. Sampling at N points misses the
// maximum by at most the square of half their distance.
TEST(RotationBound, IsReachedByGenericBodies) {
  Bodies bodies;
  double least_alpha = 1;
  int generic = 0;
  for (int i = 0; i < 60; ++i) {
    const Free free = bodies.next();
    if (i % 6 != 0) continue;
    const Samples body(free);
    double omega = 0, alpha = 0, best = 0;
    const double horizon = 60 / body.bound.omega;
    const auto look = [&](double t) {
      alpha = std::max(alpha, body.alpha(t));
      if (body.omega_B(t).norm() > omega) {
        omega = body.omega_B(t).norm();
        best = t;
      }
    };
    double width = horizon / 2000;
    for (int n = 0; n <= 2000; ++n) look(n * width);
    for (int round = 0; round < 4; ++round, width /= 16) {
      const double centre = best;
      for (int n = -16; n <= 16; ++n) look(centre + n * width / 16);
    }
    EXPECT_GE(omega, body.bound.omega * (1 - 1e-9)) << i;
    least_alpha = std::min(least_alpha, alpha / body.bound.alpha);
    ++generic;
  }
  EXPECT_EQ(generic, 10);
  // alpha takes the largest of each component at once: up to √3 too large, in fact less.
  EXPECT_GE(least_alpha, 1 / std::sqrt(3.0));
  RecordProperty("least_alpha", std::to_string(least_alpha));
}

TEST(RotationBound, IsExactForSpinAboutAnAxis) {
  const Samples body({{1, 2, 3}, Quat::Identity(), {0, 0, 6}});
  EXPECT_NEAR(body.bound.omega, 2, 1e-12);
  EXPECT_NEAR(body.bound.alpha, 0, 1e-12);
  EXPECT_NEAR(body.bound.turn_rate(Vec3::UnitZ()), 0, 1e-6);  // √ of a rounding
  EXPECT_NEAR(body.bound.turn_rate(Vec3::UnitX()), 2, 1e-6);
}

TEST(RotationBound, IsZeroWithoutSpin) {
  const Samples body({{1, 2, 3}, Quat::Identity(), Vec3::Zero()});
  EXPECT_EQ(body.bound.omega, 0);
  EXPECT_EQ(body.bound.alpha, 0);
  EXPECT_EQ(body.bound.turn_acceleration(Vec3::UnitX()), 0);
}

TEST(TurnBound, HoldsToFirstAndSecondOrderForEveryDirection) {
  Bodies bodies;
  double closest_rate = 0, closest_acceleration = 0;
  for (int i = 0; i < 300; ++i) {
    const Samples body(bodies.next());
    const RotationBound& bound = body.bound;
    for (int k = 0; k < 40; ++k) {
      const Vec3 n = k % 8 == 0 ? bound.axis : bodies.direction();
      const double t = bodies.between(0, 20 / bound.omega);
      const double x = std::pow(10, bodies.between(-3, 0.3)) / bound.omega;
      const Vec3 n_B = body.R(t).transpose() * n;
      const Vec3 rate = n_B.cross(body.omega_B(t));
      const Vec3 later = body.R(t + x).transpose() * n;
      const double first = (later - n_B).norm(), second = (later - n_B - x * rate).norm();
      const double W = bound.turn_rate(n), A = bound.turn_acceleration(n);
      EXPECT_LE(rate.norm(), W + kSampling * bound.omega);
      EXPECT_LE(first, x * W + kSampling);
      EXPECT_LE(second, 0.5 * x * x * A + kSampling);
      closest_rate = std::max(closest_rate, first / (x * W + kSampling));
      closest_acceleration = std::max(closest_acceleration, second / (0.5 * x * x * A + kSampling));
    }
  }
  EXPECT_GE(closest_rate, 0.9);  // and some body comes close to it
  EXPECT_GE(closest_acceleration, 0.5);
  RecordProperty("closest_rate", std::to_string(closest_rate));
  RecordProperty("closest_acceleration", std::to_string(closest_acceleration));
}

Scene one(const Free& free, const Vec3& velocity) {
  BodyDef def = test::free_body("body", 2, free.moments);
  def.pose.q = free.q;
  def.linear_velocity = velocity;
  const Mat3 R = free.q.toRotationMatrix();
  def.angular_velocity = R * (R.transpose() * free.L).cwiseQuotient(free.moments);
  return test::scene({def});
}

TEST(Reach, IsNeverExceededByAPointOfTheSurface) {
  Bodies bodies;
  double closest = 0, closest_along = 0;
  for (int i = 0; i < 120; ++i) {
    const Scene scene = one(bodies.next(), 3 * bodies.direction());
    const World world(scene);
    const RotationBound bound =
        rotation_bound(world.principal_axes[0], rotation(world, 0), angular_momentum(world.y, 0));
    for (int k = 0; k < 20; ++k) {
      const double r = bodies.between(0, 2), h = std::pow(10, bodies.between(-4, 1)) / bound.omega;
      const Vec3 p = r * bodies.direction(), n = bodies.direction();
      StateArray y = world.y;
      Flight(world, 0).evaluate(world, 0, h, y);
      const Vec3 before = position(world.y, 0) + orientation(world.y, 0) * p;
      const Vec3 after = position(y, 0) + orientation(y, 0) * p;
      const double far = reach(world, 0, bound, r, h),
                   along = reach_along(world, 0, bound, n, r, h);
      const double rounding = kSampling * (r + position(y, 0).norm());
      EXPECT_LE((after - before).norm(), far + rounding);
      EXPECT_LE(n.dot(after - before), along + rounding);
      EXPECT_LE(along, far * (1 + kSampling));
      closest = std::max(closest, (after - before).norm() / far);
      closest_along = std::max(closest_along, n.dot(after - before) / along);
    }
  }
  EXPECT_GE(closest, 0.9);
  EXPECT_GE(closest_along, 0.9);
}

TEST(Reach, IsExactForABodyThatOnlyFalls) {
  const World world(one({{1, 1, 1}, Quat::Identity(), Vec3::Zero()}, {0, 0, -2}));
  const RotationBound still;
  EXPECT_NEAR(reach(world, 0, still, 1, 0.5), 1 + 0.125 * 9.81, 1e-12);
  EXPECT_NEAR(reach_along(world, 0, still, Vec3::UnitZ(), 1, 0.5), -1 - 0.125 * 9.81, 1e-12);
  EXPECT_NEAR(reach_along(world, 0, still, Vec3::UnitX(), 1, 0.5), 0, 1e-12);
}

SpeedBound bound_of_first(const World& world, double h) {
  SpeedBounds bounds;
  bounds.update(world, h);
  return bounds.of(world, 0);
}

struct Closest {
  double v = 0, omega = 0;
};

// Runs on for h in small steps and holds every speed against the bound of the start.
Closest expect_speed_bounded(SimulationLayer layer, double h) {
  SpeedBounds at_start;
  at_start.update(layer.world(), h);
  std::vector<SpeedBound> bounds;
  for (Eigen::Index i = 0; i < layer.world().size(); ++i)
    bounds.push_back(at_start.of(layer.world(), i));
  Closest closest;
  const double start = layer.world().time;
  constexpr int kSteps = 40;
  constexpr double kIntegration = 1e-9;
  for (int n = 0; n <= kSteps; ++n) {
    layer.advance_to(start + h * n / kSteps);
    for (Eigen::Index i = 0; i < layer.world().size(); ++i) {
      const SpeedBound& bound = bounds[static_cast<std::size_t>(i)];
      const double v = linear_velocity(layer.world(), i).norm();
      const double omega = angular_velocity(layer.world(), i).norm();
      EXPECT_LE(v, bound.v * (1 + kIntegration));
      EXPECT_LE(omega, bound.omega * (1 + kIntegration));
      closest.v = std::max(closest.v, v / bound.v);
      closest.omega = std::max(closest.omega, omega / bound.omega);
    }
  }
  return closest;
}

TEST(SpeedBound, HoldsForDrivenBodies) {
  Bodies bodies;
  Closest closest;
  for (int i = 0; i < 120; ++i) {
    Scene scene = one(bodies.next(), bodies.between(0, 3) * bodies.direction());
    if (i % 3 == 1) scene.bodies[0].drag = {0.3, 0.2, 0.1};
    SimulationLayer layer(scene);
    HeldWrench& held = layer.world().held[0];
    const double small = layer.world().principal_axes[0].moments[0] < 0.05L ? 1e-6 : 1;
    if (i % 2 == 0) held.in_W = {3 * bodies.direction(), small * bodies.direction()};
    if (i % 3 == 0) held.in_B = {2 * bodies.direction(), small * bodies.direction()};
    if (i % 5 == 0) held.add_force_at(small * bodies.direction(), 4 * bodies.direction());
    const Closest seen = expect_speed_bounded(layer, i % 2 == 0 ? 1.0 / 60 : 0.3);
    closest.v = std::max(closest.v, seen.v);
    closest.omega = std::max(closest.omega, seen.omega);
  }
  EXPECT_GE(closest.v, 0.95);
  EXPECT_GE(closest.omega, 0.95);
}

// A push along the motion, about the axis of the smallest moment: nothing is given away.
TEST(SpeedBound, IsReachedByAPushAlongTheMotion) {
  Scene scene = one({{1, 2, 3}, Quat::Identity(), {2, 0, 0}}, {3, 0, 0});
  scene.simulation.gravity.setZero();
  SimulationLayer layer(scene);
  layer.world().held[0].in_W = {{4, 0, 0}, {1, 0, 0}};
  const SpeedBound bound = bound_of_first(layer.world(), 0.5);
  EXPECT_NEAR(bound.v, 3 + 0.5 * 4 / 2, 1e-12);
  EXPECT_NEAR(bound.omega, 2 + 0.5, 1e-12);
  layer.advance_to(0.5);
  EXPECT_NEAR(linear_velocity(layer.world(), 0).norm(), bound.v, 1e-12);
  EXPECT_NEAR(angular_velocity(layer.world(), 0).norm(), bound.omega, 1e-12);
}

TEST(SpeedBound, HoldsForBodiesOnSprings) {
  Bodies bodies;
  Closest closest;
  for (int i = 0; i < 60; ++i) {
    const auto moments = [&] { return Vec3(1, bodies.between(1, 1.5), bodies.between(1, 1.8)); };
    Scene scene = one({moments(), bodies.turn(), bodies.direction()}, 2 * bodies.direction());
    scene.bodies.push_back(test::free_body("other", 0.5, 0.2 * moments()));
    scene.bodies[1].pose.c = 2 * bodies.direction();
    scene.springs = {
        test::spring("body", 0.5 * bodies.direction(), "other", 0.2 * bodies.direction(),
                     bodies.between(1, 50), i % 2 == 0 ? 0.0 : 0.5, i % 3 == 0 ? 0.0 : 1.0),
        test::spring("other", Vec3::Zero(), "", 3 * bodies.direction(), 5, 0, std::nullopt)};
    SimulationLayer layer(scene);
    if (i % 4 == 0) layer.world().held[1].in_W.force = 3 * bodies.direction();
    const Closest seen = expect_speed_bounded(layer, i % 2 == 0 ? 1.0 / 60 : 1.0);
    closest.v = std::max(closest.v, seen.v);
  }
  EXPECT_GE(closest.v, 0.5);
}

// All energy of a spring can go into one body: reached by a body on a stretched spring to the
// world.
TEST(SpeedBound, IsReachedByABodyOnASpring) {
  Scene scene = one({{1, 2, 3}, Quat::Identity(), Vec3::Zero()}, Vec3::Zero());
  scene.simulation.gravity.setZero();
  scene.springs = {test::spring("body", Vec3::Zero(), "", Vec3(2, 0, 0), 8, 0, 0.0)};
  SimulationLayer layer(scene);
  const double quarter = 0.25 * 2 * 3.141592653589793 / 2;  // ω = √(8/2) = 2/s
  const SpeedBound bound = bound_of_first(layer.world(), quarter);
  layer.advance_to(quarter);
  const double v = linear_velocity(layer.world(), 0).norm();
  EXPECT_NEAR(v, 4, 1e-9);  // amplitude times ω
  EXPECT_GE(bound.v, v * (1 - 1e-12));
  EXPECT_LE(bound.v, v * (1 + 1e-9));
}

}  // namespace
}  // namespace poinsot
