// Principal axes of inertia, in extended precision: J = R diag(I) Rᵀ.
//
// The exact flight of a needle depends on its smallest moment to full precision, and near the
// separatrix on differences of moments: double is not enough for either once axes are oblique.
// Source: Golub, Van Loan, Matrix Computations, 8.5 (Jacobi rotations).

#pragma once

#include <array>

#include "poinsot/math/types.h"

namespace poinsot {

struct PrincipalAxes {
  std::array<long double, 3> moments = {};  // [kg·m²] ascending: I₁ ≤ I₂ ≤ I₃
  // Column k is the axis of moment k, in B; a proper rotation, principal frame → B. Exact if J is
  // diagonal.
  std::array<std::array<long double, 3>, 3> axes = {};  // [row][column]
};

// J symmetric, in B [kg·m²].
PrincipalAxes principal_axes(const Mat3& J);

// J⁻¹ in B, each entry right to rounding of the largest; for oblique needles J.inverse() is not.
Mat3 inverse_inertia(const PrincipalAxes& body);

}  // namespace poinsot
