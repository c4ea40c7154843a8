#include "poinsot/math/rotation.h"

#include <cmath>

#include "poinsot/math/elementary.h"

namespace poinsot {

Quat from_roll_pitch_yaw(const Vec3& rpy) {
  const auto [sr, cr] = sin_cos(0.5 * rpy.x());
  const auto [sp, cp] = sin_cos(0.5 * rpy.y());
  const auto [sy, cy] = sin_cos(0.5 * rpy.z());
  const Quat roll(cr, sr, 0, 0), pitch(cp, 0, sp, 0), yaw(cy, 0, 0, sy);
  return (yaw * pitch * roll).normalized();
}

double angle_between(const Quat& a, const Quat& b) {
  const Quat d = a.conjugate() * b;
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

}  // namespace poinsot
