#include "poinsot/simulation/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {

double kinetic_energy(const World& world) {
  double sum = 0;
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    if (!world.moves(i)) continue;
    const auto k = static_cast<std::size_t>(i);
    sum += 0.5 * world.inv_mass[k] * momentum(world.y, i).squaredNorm();
    sum += 0.5 * angular_velocity(world, i).dot(angular_momentum(world.y, i));
  }
  return sum;
}

double potential_energy(const World& world) {
  double sum = 0;
  for (Eigen::Index i = 0; i < world.size(); ++i)
    if (world.moves(i))
      sum -= world.mass[static_cast<std::size_t>(i)] * world.gravity.dot(position(world.y, i));
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

}  // namespace poinsot
