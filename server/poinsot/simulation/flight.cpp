#include "poinsot/simulation/flight.h"

#include <limits>

namespace poinsot {

Flight::Flight(const World& world, Eigen::Index i, double start)
    : start_(start),
      c_(position(world.y, i)),
      P_(momentum(world.y, i)),
      v_(poinsot::linear_velocity(world, i)),
      L_(poinsot::angular_momentum(world.y, i)),
      q_(orientation(world.y, i)),
      rotation_(world.principal_axes[static_cast<std::size_t>(i)], orientation(world.y, i), L_) {}

Pose Flight::pose(const World& world, double t) const {
  const double dt = t - start_;
  return {c_ + dt * (v_ + (0.5 * dt) * world.gravity), rotation_.at(dt)};
}

void Flight::evaluate(const World& world, Eigen::Index i, double t, StateArray& y) const {
  const double dt = t - start_;
  const double mass = world.mass[static_cast<std::size_t>(i)];
  position(y, i) = c_ + dt * (v_ + (0.5 * dt) * world.gravity);
  momentum(y, i) = P_ + (mass * dt) * world.gravity;
  const Quat q = rotation_.at(dt);
  // q and −q are the same orientation: keep to the sign that is nearer, for who interpolates.
  const double sign = q.dot(orientation(y, i)) < 0 ? -1 : 1;
  orientation(y, i).coeffs() = sign * q.coeffs();
}

LocalError Flight::error(const World& world, double t) const {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double dt = t - start_;
  return {kRounding * (c_.norm() + dt * (v_.norm() + 0.5 * dt * world.gravity.norm())),
          rotation_.error(dt)};
}

void Flight::hash_into(Hash64& hash) const {
  hash.add(start_);
  hash.add(std::span(c_.data(), 3));
  hash.add(std::span(P_.data(), 3));
  hash.add(std::span(q_.coeffs().data(), 4));
}

}  // namespace poinsot
