// The friction cone of a contact: the nearest impulse within it, and how that follows its argument.
//
// An impulse is (normal, two tangential) [N·s]; the cone is |tangential| ≤ μ normal, a circle. Near
// is meant in the norm of R = diag(Rn, Rt, Rt) [1/kg], so that the cone stays a circle.

#pragma once

#include <cmath>

#include "poinsot/math/types.h"

namespace poinsot {

struct ConeScale {
  double normal, tangent;                  // Rn, Rt [1/kg]
  double inverse_normal, inverse_tangent;  // [kg]

  static ConeScale of(double normal, double tangent) {
    return {normal, tangent, 1 / normal, 1 / tangent};
  }
};

struct ConeImpulse {
  enum class Region { kOpen, kStick, kSlide };

  Region region = Region::kOpen;
  Vec3 impulse = Vec3::Zero();
  // kSlide only:
  double direction[2] = {0, 0};  // of the tangential part
  double along = 0, across = 0;  // [kg] see stiffness()

  // d impulse / d (−velocity) where argument = const − R⁻¹ velocity: symmetric, ≥ 0 [kg].
  Mat3 stiffness(const ConeScale& scale, double friction) const {
    if (region == Region::kOpen) return Mat3::Zero();
    if (region == Region::kStick)
      return Vec3(scale.inverse_normal, scale.inverse_tangent, scale.inverse_tangent).asDiagonal();
    const Vec3 side(1, friction * direction[0], friction * direction[1]);
    const Vec3 turn(0, -direction[1], direction[0]);
    return along * side * side.transpose() + across * turn * turn.transpose();
  }
};

// Where the cone is asked from: an impulse times R, that is velocities [m/s].
struct ConeArgument {
  double normal;      // before the shift
  double tangent[2];  //
  double shift = 0;   // the argument is normal − μ shift
  double excess;      // |tangent| − shift; both may be large and this small
};

inline ConeImpulse nearest_in_cone(const ConeArgument& z, double friction, const ConeScale& scale) {
  ConeImpulse result;
  const double length = std::sqrt(z.tangent[0] * z.tangent[0] + z.tangent[1] * z.tangent[1]);
  const double upright = (z.normal - friction * z.shift) * scale.inverse_normal;
  if (friction > 0 && length * scale.inverse_tangent <= friction * upright) {
    result.region = ConeImpulse::Region::kStick;
    result.impulse =
        Vec3(upright, z.tangent[0] * scale.inverse_tangent, z.tangent[1] * scale.inverse_tangent);
    return result;
  }
  const double pressed = z.normal + friction * z.excess;
  if (!(pressed > 0)) return result;
  result.region = ConeImpulse::Region::kSlide;
  result.along = 1 / (scale.normal + friction * friction * scale.tangent);
  const double normal = pressed * result.along;
  result.impulse[0] = normal;
  if (!(length > 0)) return result;
  const double tangential = friction * normal;
  for (int k = 0; k < 2; ++k) {
    result.direction[k] = z.tangent[k] / length;
    result.impulse[k + 1] = tangential * result.direction[k];
  }
  result.across = tangential / length;
  return result;
}

}  // namespace poinsot
