// Inertia tensors [kg·m²]: change of axes and of reference point, and whether one is possible.
// Source: lesson "Rigid Body Dynamics", slides "Mass and Inertia Tensor".

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

// J in the parent's axes from J in the child's: R J Rᵀ.
inline Mat3 rotate_inertia(const Mat3& R, const Mat3& J) {
  return R * J * R.transpose();
}

// What a mass m [kg] at offset r [m] from the reference point adds: m (rᵀr 1 − r rᵀ).
inline Mat3 parallel_axis(double m, const Vec3& r) {
  return m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

// The three principal moments, ascending [kg·m²].
Vec3 principal_moments(const Mat3& J);

// True for the inertia of some distribution of mass: symmetric, positive definite, and no principal
// moment greater than the sum of the other two (flat bodies reach equality; relative rounding
// `slack` is allowed there).
bool is_physical_inertia(const Mat3& J, double slack = 1e-9);

}  // namespace poinsot
