// A scene as integrators see it: all its bodies as one system, and the reference of a lone body.

#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/body_system.h"
#include "support/extended_reference.h"
#include "support/scene_builder.h"

namespace poinsot::test {

class SampleSystem {
 public:
  explicit SampleSystem(const Scene& scene, const HeldWrench& held_by_first = {}) : world(scene) {
    world.held[0] = held_by_first;
    const Eigen::Index n = world.size();
    y.resize(17, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      bodies_.push_back(system_body(world, i, {}));
      gather(world.y, i, y, i);
    }
    if (!world.systems.empty()) springs_ = world.systems[0].springs;
    rates_.resize(bodies_.size());
  }
  SampleSystem(const SampleSystem&) = delete;
  SampleSystem& operator=(const SampleSystem&) = delete;

  System system() { return {bodies_, springs_, rates_}; }

  World world;
  SystemState y;  // at the start

 private:
  std::vector<SystemBody> bodies_;
  std::vector<SpringLink> springs_;
  std::vector<BodyRates> rates_;
};

inline auto c_of(const SystemState& y, Eigen::Index i = 0) {
  return y.block<3, 1>(0, i);
}
inline Quat q_of(const SystemState& y, Eigen::Index i = 0) {
  return {y(6, i), y(3, i), y(4, i), y(5, i)};
}
inline auto P_of(const SystemState& y, Eigen::Index i = 0) {
  return y.block<3, 1>(7, i);
}
inline Vec3 L_of(const SystemState& y, Eigen::Index i = 0) {
  return q_of(y, i).normalized() * Vec3(y.block<3, 1>(10, i));
}

// [J] of all bodies.
inline double kinetic_energy_of(const System& system, const SystemState& y) {
  double sum = 0;
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    const SystemBody& body = system.bodies[static_cast<std::size_t>(i)];
    const Vec3 m = y.block<3, 1>(10, i);
    sum += 0.5 * body.inv_mass * P_of(y, i).squaredNorm() + 0.5 * m.dot(body.inv_J_B * m);
  }
  return sum;
}

// A body that tumbles through all its axes, away from the origin.
inline BodyDef tumbler() {
  BodyDef def = free_body("tumbler", 2, {1, 2, 3});
  def.pose = {{0.3, -0.2, 0.5}, Quat(0.5, 0.5, -0.5, 0.5)};
  def.linear_velocity = {1, -2, 0.5};
  def.angular_velocity = {1, 3, 2};
  return def;
}

// Between point p_a of body a and p_b of body b, or of W if b is empty.
inline SpringDef spring(std::string a, const Vec3& p_a, std::string b, const Vec3& p_b,
                        double stiffness, double damping, std::optional<double> rest) {
  SpringDef def;
  def.a = std::move(a);
  def.b = std::move(b);
  def.point_a = p_a;
  def.point_b = p_b;
  def.stiffness = stiffness;
  def.damping = damping;
  def.rest_length = rest;
  return def;
}

// The first body of a world without springs between bodies, from its present state on.
inline ReferenceBody reference_body(const World& world) {
  ReferenceBody body;
  body.mass = world.mass[0];
  body.J_B = world.J_B[0];
  body.gravity = world.gravity;
  body.held = world.held[0];
  if (!world.drag.empty()) {
    body.drag_linear = world.drag[0].linear;
    body.drag_quadratic = world.drag[0].quadratic;
    body.drag_angular = world.drag[0].angular;
  }
  for (const BodySystem& system : world.systems)
    for (const SpringLink& s : system.springs)
      body.springs.push_back({s.p_a, s.p_b, s.stiffness, s.damping, s.rest});
  return body;
}

inline ExtendedReference reference_of(const World& world, const ReferenceOptions& options = {}) {
  return {reference_body(world), position(world.y, 0),         orientation(world.y, 0),
          momentum(world.y, 0),  angular_momentum(world.y, 0), options};
}

// Slope of log error over log step (or tolerance), by least squares.
inline double slope(const std::vector<double>& x, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(error[i]);
    sx += a;
    sy += b;
    sxx += a * a;
    sxy += a * b;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace poinsot::test
