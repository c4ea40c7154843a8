// Rotation over a sub-step: turns as quaternions, and the torque-free flow of a body whose inertia
// is not isotropic.
//
// The flow is Magnus' series to fourth order in the body's frame, from derivatives of M = Rᵀ L in
// closed form; L does not change. Its error shrinks as φ⁴ per radian turned, φ the angle of a step:
// kStepAngle keeps the energy to 1e-9 of itself per radian. Source: Hairer, Lubich, Wanner,
// Geometric Numerical Integration (2006), IV.7.

#pragma once

#include <algorithm>
#include <cmath>

#include "poinsot/math/elementary.h"
#include "poinsot/math/types.h"

namespace poinsot {

// The unit quaternion of a rotation vector [rad]; one that is not finite does not turn.
inline Quat turn_by(const Vec3& angle) {
  constexpr double kSeries =
      0.0625;  // [rad²] square of half an angle, below which a series is exact
  constexpr double kCosine_5 = -1.0 / 3628800, kSine_5 = -1.0 / 39916800;
  constexpr double kFarthest = 1e10;  // [rad²] beyond, the direction has lost its meaning
  const double x = 0.25 * angle.squaredNorm();
  if (x < kSeries) {
    const double cosine =
        1 + x * (-1.0 / 2 + x * (1.0 / 24 + x * (-1.0 / 720 + x * (1.0 / 40320 + x * kCosine_5))));
    const double sine =
        1 + x * (-1.0 / 6 + x * (1.0 / 120 + x * (-1.0 / 5040 + x * (1.0 / 362880 + x * kSine_5))));
    const Vec3 u = (0.5 * sine) * angle;
    return Quat(cosine, u.x(), u.y(), u.z());
  }
  if (!(x < kFarthest)) return Quat::Identity();
  const double half = std::sqrt(x);
  const SinCos turn = sin_cos(half);
  const Vec3 u = (0.5 * turn.sin / half) * angle;
  return Quat(turn.cos, u.x(), u.y(), u.z());
}

// The rotation in B after h [s] of a body with angular momentum M [kg·m²/s] in B.
inline Quat free_turn(const Vec3& M, const Mat3& inv_J_B, double h) {
  const Vec3 w = inv_J_B * M;
  const Vec3 M1 = M.cross(w), w1 = inv_J_B * M1;
  const Vec3 M2 = M1.cross(w) + M.cross(w1), w2 = inv_J_B * M2;
  const Vec3 M3 = M2.cross(w) + 2 * M1.cross(w1) + M.cross(w2), w3 = inv_J_B * M3;
  const Vec3 rate = w + (h / 2) * (w1 + (h * (1.0 / 3)) * (w2 + (h / 4) * w3));
  const Vec3 bend = w.cross(w1 + (h / 2) * w2);
  return turn_by(h * (rate + (h * h * (1.0 / 12)) * bend));
}

// The orientation after h [s] of a body with angular momentum L in W.
inline Quat free_flow(Quat q, const Vec3& L, const Mat3& inv_J_B, double h) {
  constexpr double kStepAngle = 0.02;  // [rad]
  constexpr double kMostSteps = 1000;
  const double angle = h * (inv_J_B * (q.conjugate() * L)).norm();
  if (!(angle < kMostSteps)) return q;  // it is not finite or not a motion
  const int steps = std::max(1, static_cast<int>(std::min(kMostSteps, angle / kStepAngle)));
  for (int k = 0; k < steps; ++k) q = q * free_turn(q.conjugate() * L, inv_J_B, h / steps);
  q.normalize();
  return q;
}

}  // namespace poinsot
