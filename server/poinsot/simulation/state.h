// The state of all bodies: one column per body, rows c(3) q(4) P(3) L(3).
//
//   c  [m]        centre of mass, in W            rows 0 … 2
//   q  [-]        orientation x y z w, B → W      rows 3 … 6
//   P  [kg·m/s]   momentum, in W                  rows 7 … 9
//   L  [kg·m²/s]  angular momentum about c, in W  rows 10 … 12
//
// Source: lesson "Rigid Body Dynamics", slide "Rigid Body Equation of Motion".

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

using StateArray = Eigen::Matrix<double, 13, Eigen::Dynamic>;  // 13×n

inline auto position(StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(0, i);
}
inline auto position(const StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(0, i);
}

inline Eigen::Map<Quat> orientation(StateArray& y, Eigen::Index i) {
  return Eigen::Map<Quat>(y.col(i).data() + 3);
}
inline Eigen::Map<const Quat> orientation(const StateArray& y, Eigen::Index i) {
  return Eigen::Map<const Quat>(y.col(i).data() + 3);
}

inline auto momentum(StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(7, i);
}
inline auto momentum(const StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(7, i);
}

inline auto angular_momentum(StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(10, i);
}
inline auto angular_momentum(const StateArray& y, Eigen::Index i) {
  return y.block<3, 1>(10, i);
}

}  // namespace poinsot
