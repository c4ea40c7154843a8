// Energy of a world and its scale. The work of wrenches is in simulation_layer.h.
// README.md, section "Energy", defines the balance.

#pragma once

#include "poinsot/simulation/world.h"

namespace poinsot {

double kinetic_energy(const World& world);    // [J] ½ P²/m + ½ ω·L over the bodies that move
double potential_energy(const World& world);  // [J] −m g·c over the bodies that move, and springs
// The parts of one body; springs are no body's.
double kinetic_energy(const World& world, Eigen::Index i);
double potential_energy(const World& world, Eigen::Index i);

// Scale for the relative energy error [J]: Σ m |g| (height above the lowest body + radius of
// gyration) at the start, plus the largest kinetic energy seen and the springs' energy at the
// start. What tethers hold when they are set counts as kinetic energy seen.
class EnergyScale {
 public:
  explicit EnergyScale(const World& world);
  void see(double kinetic) {  // or what may become kinetic: of tethers
    largest_kinetic_ = kinetic > largest_kinetic_ ? kinetic : largest_kinetic_;
  }
  // Bodies came, went or were moved: at least what the scale would be if it started now.
  void widen(const World& world);
  double value() const { return potential_ + largest_kinetic_; }
  template <class Archive>
  void archive(Archive& with) {
    with(potential_, largest_kinetic_);
  }

 private:
  double potential_ = 0;
  double largest_kinetic_ = 0;
};

}  // namespace poinsot
