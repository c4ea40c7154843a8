// The right-hand side of the equation of motion, c′ q′ P′ L′, of all bodies that move.
//
//   c′ = P/m    q′ = ½ Q(q) ω    P′ = m g + F    L′ = τ        ω = R J⁻¹ Rᵀ L
//
// F, τ: held wrench at the present orientation plus the contact wrench. Pure: the same arguments
// give the same bits. Source: lesson "Rigid Body Dynamics", slide "Rigid Body Equation of Motion".

#pragma once

#include <span>

#include "poinsot/simulation/world.h"

namespace poinsot {

struct Dynamics {
  const World& world;               // constants and held wrenches; its state is not read
  std::span<const Wrench> contact;  // n, about c, in W

  // dy = y′(y), 13×n; zero for bodies that do not move. q need not be exactly unit.
  void derivative(const StateArray& y, StateArray& dy) const;
};

// What acts on body i at orientation R, about c, in W: gravity, held and contact wrench.
Wrench acting_wrench(const Dynamics& dynamics, Eigen::Index i, const Mat3& R);

}  // namespace poinsot
