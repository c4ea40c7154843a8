// Bodies and wrenches, looked at to the bit: untouched, sound, zero. Private to this module.

#pragma once

#include <cstring>

#include "poinsot/math/wrench.h"
#include "poinsot/simulation/state.h"

namespace poinsot {

// A coordinate beyond this is no physics any more; its square is still finite.
inline constexpr double kLargestCoordinate = 1e100;

// False for NaN as well, and for a quaternion that overflowed while it was made unit.
inline bool is_sound(const StateArray& y, Eigen::Index i) {
  return (y.col(i).array().abs() < kLargestCoordinate).all() &&
         orientation(y, i).squaredNorm() > 0.5;
}

inline bool is_zero(const Wrench& wrench) {
  return wrench.force.isZero(0) && wrench.torque.isZero(0);
}

inline bool same_column(const StateArray& a, const StateArray& b, Eigen::Index i) {
  return std::memcmp(a.col(i).data(), b.col(i).data(), 13 * sizeof(double)) == 0;
}

}  // namespace poinsot
