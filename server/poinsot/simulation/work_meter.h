// Work of held and contact wrenches, measured along the path that the integrator took.
//
// What is a difference of positions is taken as such and is exact: F·Δc for a force constant in W
// at the centre of mass, F·Δ(c + R p) at a body-fixed point. Couples and forces constant in B are
// integrated over their power by the trapezoidal rule with end corrections (Euler and Maclaurin,
// error O(h⁵) per step). Bodies without a wrench are passed over.

#pragma once

#include <vector>

#include "poinsot/simulation/dynamics.h"

namespace poinsot {

class WorkMeter {
 public:
  explicit WorkMeter(Eigen::Index n) { open_.reserve(static_cast<std::size_t>(n)); }

  void start_step(const Dynamics& dynamics);
  void end_step(const Dynamics& dynamics, double h);  // h [s] since start_step

  double held() const { return held_; }        // [J] since the start
  double contact() const { return contact_; }  // [J]

 private:
  struct Power {
    double value = 0;  // [W]
    double rate = 0;   // [W/s]
  };
  struct Open {
    Eigen::Index i;
    Vec3 c;  // [m]
    Mat3 R;
    Power held, contact;
  };

  static Power power(const Dynamics& dynamics, Eigen::Index i, const Wrench& in_B,
                     const Vec3& couple_W);
  Open measure(const Dynamics& dynamics, Eigen::Index i) const;

  std::vector<Open> open_;
  double held_ = 0;
  double contact_ = 0;
};

}  // namespace poinsot
