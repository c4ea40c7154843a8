// What clients do to one body for the length of a frame: any number of pushes in constant size.
//
// A force F constant in W at a body-fixed point p_B (from the centre of mass) has the torque
// (R p_B) × F about it. That is linear in the matrix p_B Fᵀ, so the sum over all such forces is the
// axial vector of R M with M = Σ p_B Fᵀ, exact for every orientation the body takes.

#pragma once

#include "poinsot/math/wrench.h"

namespace poinsot {

// Σ pₖ × Fₖ of M = Σ pₖ Fₖᵀ.
inline Vec3 axial(const Mat3& m) {
  return {m(1, 2) - m(2, 1), m(2, 0) - m(0, 2), m(0, 1) - m(1, 0)};
}

struct HeldWrench {
  Wrench in_W;                 // sum constant in W: all forces in W, and couples in W, about c
  Wrench in_B;                 // sum constant in B, about c
  Mat3 moment = Mat3::Zero();  // [N·m] Σ p_B F_Wᵀ of the forces in W that act off c

  // A force F_W [N], constant in W, at the body-fixed point p_B [m] from the centre of mass.
  void add_force_at(const Vec3& p_B, const Vec3& F_W) {
    in_W.force += F_W;
    moment += p_B * F_W.transpose();
  }

  bool is_zero() const {
    return in_W.force.isZero(0) && in_W.torque.isZero(0) && in_B.force.isZero(0) &&
           in_B.torque.isZero(0) && moment.isZero(0);
  }

  // The part that depends on the orientation R (B → W) and is linear in it, about c in W.
  Wrench turning(const Mat3& R) const {
    const Mat3 m = R * moment;
    return {R * in_B.force, R * in_B.torque + axial(m)};
  }

  // The wrench about c in W at orientation R (B → W).
  Wrench at(const Mat3& R) const {
    Wrench w = turning(R);
    w += in_W;
    return w;
  }

  template <class Archive>
  void archive(Archive& with) {
    with(in_W, in_B, moment);
  }
};

}  // namespace poinsot
