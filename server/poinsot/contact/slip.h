// One impact followed through its normal impulse: see single_impact.h for the equations.

#pragma once

#include "poinsot/math/types.h"

namespace poinsot {

class Slip {
 public:
  using Vec2 = Eigen::Vector2d;
  enum class End { kStopped, kImpactOver, kLost };

  // Relative velocity u [m/s], approaching; A [1/kg] in the point's frame; the share of the work of
  // compression that comes back.
  Slip(const Mat3& A, const Vec3& u, double returned_share);

  // Until slip stops or the impact is over. Lost: the steps ran out or a number is not finite.
  End until_it_ends(double friction);

  // Under friction f per unit of normal impulse, for at most so much of it [N·s]. True: the impact
  // is over.
  bool straight(const Vec2& f, double limit);

  // So far, cut back to its cone.
  Vec3 impulse(double friction) const;

  Vec2 tangential;  // [m/s] velocity of slip

 private:
  // Five numbers that slip integrates: velocity of slip, impulse (tangential, normal); and the work
  // of the normal impulse since the last time the normal velocity was zero.
  using State = Eigen::Matrix<double, 6, 1>;

  State rate(const State& y, double friction) const;  // per unit of σ, dp = |ut| dσ
  State step(const State& y, double h, double friction, double* error) const;
  double normal_speed(const State& y) const;
  // > 0 once the phase at hand (compression or restitution) has ended.
  double overshoot(const State& y) const;
  void land(const State& from, State& to, double h, double friction) const;
  bool end_phase(double work);  // true: the impact is over
  bool slip_is_straight(double friction) const;

  Mat3 A_;
  Vec3 u_;  // before the impact
  double share_;
  double speed_;           // |u| [m/s], the scale of errors
  Vec3 p_ = Vec3::Zero();  // impulse so far
  double normal_;          // normal velocity [m/s]
  bool compressing_ = true;
  double compression_ = 0;  // work [J], ≥ 0
  double restitution_ = 0;
};

}  // namespace poinsot
