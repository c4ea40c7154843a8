#include "poinsot/simulation/motion_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// Rounding of the few operations below, with room.
constexpr double kRounding = 1 + 1e-13;

// Principal frame rows: x_P = Aᵀ x_B.
Mat3 principal_rotation(const PrincipalAxes& body) {
  Mat3 A;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      A(static_cast<int>(i), static_cast<int>(k)) = static_cast<double>(body.axes[i][k]);
  return A;
}

}  // namespace

double RotationBound::turn_rate(const Vec3& n) const {
  const double sine = std::min(1.0, n.cross(axis).norm() * kRounding);
  return std::min(omega, along * sine + perp) * kRounding;
}

RotationBound rotation_bound(const PrincipalAxes& body, const Mat3& R, const Vec3& L) {
  RotationBound bound;
  const double G = L.stableNorm();
  if (G == 0) return bound;
  const Vec3 m = principal_rotation(body).transpose() * (R.transpose() * (L / G));  // in units of G
  const Vec3 I(static_cast<double>(body.moments[0]), static_cast<double>(body.moments[1]),
               static_cast<double>(body.moments[2]));
  const Vec3 square = m.cwiseAbs2();
  // |aᵢ| of mᵢ′ = aᵢ mⱼ mₖ, from differences of moments.
  const Vec3 a((I[2] - I[1]) / (I[1] * I[2]), (I[2] - I[0]) / (I[2] * I[0]),
               (I[1] - I[0]) / (I[0] * I[1]));
  // Along the polhode a₂ m₁² + a₁ m₂² and a₂ m₃² + a₃ m₂² keep their values; the largest of each
  // square lies where another is zero, or smallest.
  Vec3 largest = square;
  if (a[1] > 0) {
    const double first = square[0] + a[0] / a[1] * square[1];  // m₁² where m₂ = 0
    const double third = square[2] + a[2] / a[1] * square[1];  // m₃² where m₂ = 0
    double second = 1;
    if (a[0] > 0) second = std::min(second, first * a[1] / a[0]);
    if (a[2] > 0) second = std::min(second, third * a[1] / a[2]);
    largest = Vec3(first, std::max(second, square[1]), third);
  }
  const Vec3 M = (largest.cwiseSqrt() * kRounding).cwiseMin(1.0);
  const Vec3 inverse = I.cwiseInverse();
  const double energy = square.dot(inverse);  // 2T/G²
  // |ω|² = Σ mᵢ²/Iᵢ² is linear in m₂² along the polhode: largest at m₂ = 0 or at the largest m₂.
  const double now = square.cwiseProduct(inverse.cwiseAbs2()).sum();
  double slope = 0;  // d|ω|²/d(m₂²)
  if (a[1] > 0)
    slope = inverse[1] * inverse[1] - a[0] / a[1] * inverse[0] * inverse[0] -
            a[2] / a[1] * inverse[2] * inverse[2];
  const double at_zero = now - slope * square[1];
  const double at_most = now + slope * (M[1] * M[1] - square[1]);
  bound.omega = G * std::sqrt(std::max({now, at_zero, at_most})) * kRounding;
  const Vec3 alpha(inverse[0] * a[0] * M[1] * M[2], inverse[1] * a[1] * M[2] * M[0],
                   inverse[2] * a[2] * M[0] * M[1]);
  bound.alpha = G * alpha.norm() * G * kRounding;
  bound.along = G * energy;
  const double perp_squared = bound.omega * bound.omega - bound.along * bound.along;
  // The difference of two close squares: its rounding is added, not hoped away.
  bound.perp = std::sqrt(std::max(0.0, perp_squared) + 1e-14 * bound.omega * bound.omega);
  bound.axis = L / G;
  return bound;
}

double reach(const World& world, Eigen::Index i, const RotationBound& bound, double r, double h) {
  const double straight = h * (linear_velocity(world, i).norm() + 0.5 * h * world.gravity.norm());
  return (straight + std::min(2.0, bound.omega * h) * r) * kRounding;
}

double reach_along(const World& world, Eigen::Index i, const RotationBound& bound, const Vec3& n,
                   double r, double h) {
  const double centre = h * n.dot(linear_velocity(world, i) + (0.5 * h) * world.gravity);
  const double slack = 1e-15 * h * (linear_velocity(world, i).norm() + h * world.gravity.norm());
  return centre + slack + std::min(2.0, bound.turn_rate(n) * h) * r * kRounding;
}

namespace {

struct Push {
  double force = 0, torque = 0;  // [N] [N·m] at any orientation
};

Push largest_push(const World& world, Eigen::Index i, std::span<const Wrench> contacts) {
  const auto k = static_cast<std::size_t>(i);
  const HeldWrench& held = world.held[k];
  Push push{world.mass[k] * world.gravity.norm(), 0};
  if (!contacts.empty()) {
    push.force += contacts[k].force.norm();
    push.torque += contacts[k].torque.norm();
  }
  if (held.is_zero()) return push;
  push.force += held.in_W.force.norm() + held.in_B.force.norm();
  // The axial vector of a matrix is at most √2 times as long as the matrix.
  push.torque +=
      held.in_W.torque.norm() + held.in_B.torque.norm() + std::sqrt(2.0) * held.moment.norm();
  return push;
}

double smallest_moment(const World& world, Eigen::Index i) {
  return static_cast<double>(world.principal_axes[static_cast<std::size_t>(i)].moments[0]);
}

double rotational_energy(const World& world, Eigen::Index i) {
  return 0.5 * angular_velocity(world, i).dot(angular_momentum(world.y, i));
}

// S of a system, and what can be added to it in h.
double coupled_energy(const World& world, const BodySystem& system, double h,
                      std::span<const Wrench> contacts) {
  double energy = spring_energy(world, system), growth = 0;
  for (const Eigen::Index j : system.columns) {
    const double inv_mass = world.inv_mass[static_cast<std::size_t>(j)];
    if (!world.moves(j)) continue;
    const Push push = largest_push(world, j, contacts);
    energy += rotational_energy(world, j) + 0.5 * inv_mass * momentum(world.y, j).squaredNorm();
    growth +=
        push.force * push.force * inv_mass + push.torque * push.torque / smallest_moment(world, j);
  }
  return (std::sqrt(2 * std::max(energy, 0.0)) + h * std::sqrt(growth)) * kRounding;
}

SpeedBound lone_bound(const World& world, Eigen::Index i, double h,
                      std::span<const Wrench> contacts) {
  const auto k = static_cast<std::size_t>(i);
  const Push push = largest_push(world, i, contacts);
  const double v = linear_velocity(world, i).norm() + h * push.force * world.inv_mass[k];
  const Vec3 L = angular_momentum(world.y, i);
  if (push.torque == 0 && world.drag.empty())
    return {v * kRounding, rotation_bound(world.principal_axes[k], rotation(world, i), L).omega};
  const double smallest = smallest_moment(world, i);
  const double by_energy = std::sqrt(2 * rotational_energy(world, i) / smallest);
  return {v * kRounding,
          (std::min(by_energy, L.norm() / smallest) + h * push.torque / smallest) * kRounding};
}

// Force and torque that springs can exert on a body of a system with energy S²/2 [N] [N·m]:
// k s² ≤ S² for each, and a damper closes no faster than its ends move.
Push largest_pull(const World& world, const BodySystem& system, int place, double s) {
  Push pull;
  const auto end_speed = [&](int index, const Vec3& p) {
    if (index == SpringLink::kWorld) return 0.0;
    const Eigen::Index j = system.columns[static_cast<std::size_t>(index)];
    if (!world.moves(j)) return 0.0;
    return s * (std::sqrt(world.inv_mass[static_cast<std::size_t>(j)]) +
                p.norm() / std::sqrt(smallest_moment(world, j)));
  };
  for (const int index : system.springs_of[static_cast<std::size_t>(place)]) {
    const SpringLink& spring = system.springs[static_cast<std::size_t>(index)];
    const double closing = end_speed(spring.a, spring.p_a) + end_speed(spring.b, spring.p_b);
    const double force = std::sqrt(spring.stiffness) * s + spring.damping * closing;
    pull.force += force;
    pull.torque += force * (spring.a == place ? spring.p_a : spring.p_b).norm();
  }
  return pull;
}

// How far tethers let the centre of mass of a body of such a system go [m].
double longest_path(const World& world, Eigen::Index i, const BodySystem& system, int place,
                    double s) {
  double path = std::numeric_limits<double>::infinity();
  for (const int index : system.springs_of[static_cast<std::size_t>(place)]) {
    const SpringLink& spring = system.springs[static_cast<std::size_t>(index)];
    if (!spring.isotropic || !(spring.stiffness > 0)) continue;
    const Vec3 x = position(world.y, i) + orientation(world.y, i) * spring.p_a;
    path = std::min(
        path, (x - spring.p_b).norm() + s / std::sqrt(spring.stiffness) + 2 * spring.p_a.norm());
  }
  return path * kRounding;
}

}  // namespace

DrivenBound driven_bound(const World& world, Eigen::Index i, std::span<const Wrench> contacts,
                         double h) {
  const auto k = static_cast<std::size_t>(i);
  const HeldWrench& held = world.held[k];
  const double inv_mass = world.inv_mass[k];
  DrivenBound bound;
  Push pull;
  if (world.systems.empty() || world.system_of[k] == World::kLone) {
    bound.speed = lone_bound(world, i, h, contacts);
  } else {
    const BodySystem& system = world.systems[static_cast<std::size_t>(world.system_of[k])];
    const double s = coupled_energy(world, system, h, contacts);
    bound.speed = {s * std::sqrt(inv_mass), s / std::sqrt(smallest_moment(world, i))};
    pull = largest_pull(world, system, world.place_of[k], s);
    bound.path = longest_path(world, i, system, world.place_of[k], s);
  }
  Vec3 force = held.in_W.force;
  if (!contacts.empty()) force += contacts[k].force;
  bound.acceleration = world.gravity + inv_mass * force;
  double rest = held.in_B.force.norm() + pull.force, torque = pull.torque;
  torque += largest_push(world, i, contacts).torque;
  if (!world.drag.empty()) {
    const DragDef& drag = world.drag[k];
    rest += (drag.linear + drag.quadratic * bound.speed.v) * bound.speed.v;
    torque += drag.angular * bound.speed.omega;
  }
  bound.slack = inv_mass * rest * kRounding;
  // Euler's equations, with |ω × J ω| ≤ (J₃ − J₁) ω².
  const PrincipalAxes& body = world.principal_axes[k];
  const auto smallest = static_cast<double>(body.moments[0]);
  const auto largest = static_cast<double>(body.moments[2]);
  const double omega = bound.speed.omega;
  bound.rotation.omega = bound.rotation.perp = omega;
  bound.rotation.alpha = (torque + (largest - smallest) * omega * omega) / smallest * kRounding;
  return bound;
}

void SpeedBounds::update(const World& world, double h) {
  h_ = h;
  energies_.clear();
  for (const BodySystem& system : world.systems)
    energies_.push_back(coupled_energy(world, system, h, {}));
}

SpeedBound SpeedBounds::of(const World& world, Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  if (world.systems.empty() || world.system_of[k] == World::kLone)
    return lone_bound(world, i, h_, {});
  const double s = energies_[static_cast<std::size_t>(world.system_of[k])];
  return {s * std::sqrt(world.inv_mass[k]), s / std::sqrt(smallest_moment(world, i))};
}

}  // namespace poinsot
