// Elliptic integrals of the first kind, in extended precision: what the set-up of an exact
// torque-free rotation needs. k is the modulus, k′ the complementary one, k² + k′² = 1; both are
// taken as arguments wherever one of them may be too close to 1 to give the other.
// Sources: Abramowitz, Stegun 17.6 (arithmetic-geometric mean); Carlson, Numerical computation of
// real or complex elliptic integrals, 1995.

#pragma once

namespace poinsot {

// K(k) from k′ = sqrt(1 − k²) > 0, relative error below 1e-18.
long double complete_elliptic_k(long double k_complement);

// Carlson's R_F(x, y, 1), for x, y ≥ 0 of which at most one is zero. Relative error below 1e-18.
long double carlson_rf(long double x, long double y);

// F(φ, k) for |φ| ≤ π/2, given sin φ, cos φ ≥ 0 and dn² = 1 − k² sin² φ > 0.
inline long double incomplete_elliptic_f(long double sin_phi, long double cos_phi,
                                         long double dn_squared) {
  return sin_phi * carlson_rf(cos_phi * cos_phi, dn_squared);
}

}  // namespace poinsot
