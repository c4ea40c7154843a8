#include "poinsot/simulation/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {

double kinetic_energy(const World& world, Eigen::Index i) {
  if (!world.moves(i)) return 0;
  return 0.5 * world.inv_mass[static_cast<std::size_t>(i)] * momentum(world.y, i).squaredNorm() +
         0.5 * angular_velocity(world, i).dot(angular_momentum(world.y, i));
}

double kinetic_energy(const World& world) {
  double sum = 0;
  for (Eigen::Index i = 0; i < world.size(); ++i) sum += kinetic_energy(world, i);
  return sum;
}

double potential_energy(const World& world, Eigen::Index i) {
  if (!world.moves(i)) return 0;
  return -world.mass[static_cast<std::size_t>(i)] * world.gravity.dot(position(world.y, i));
}

double potential_energy(const World& world) {
  double sum = 0;
  for (Eigen::Index i = 0; i < world.size(); ++i) sum += potential_energy(world, i);
  return sum + spring_energy(world);
}

EnergyScale::EnergyScale(const World& world) : potential_(spring_energy(world)) {
  const double g = world.gravity.norm();
  if (g > 0) {
    const Vec3 up = -world.gravity / g;
    double lowest = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < world.size(); ++i)
      if (world.moves(i)) lowest = std::min(lowest, up.dot(position(world.y, i)));
    for (Eigen::Index i = 0; i < world.size(); ++i) {
      if (!world.moves(i)) continue;
      const auto k = static_cast<std::size_t>(i);
      const double gyration = std::sqrt(world.J_B[k].trace() / (2 * world.mass[k]));
      potential_ += world.mass[k] * g * (up.dot(position(world.y, i)) - lowest + gyration);
    }
  }
  see(kinetic_energy(world));
}

void EnergyScale::widen(const World& world) {
  const EnergyScale now(world);
  potential_ = std::max(potential_, now.potential_);
  see(now.largest_kinetic_);
}

}  // namespace poinsot
