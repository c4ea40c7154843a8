// Taylor series of one rigid body's motion about the present time, its coefficients in 113 or in 64
// bits. States are in 113 bits in any case: what is added to them in a step is rounded, they are
// not.

#pragma once

#include <vector>

#include "support/extended_reference.h"
#include "support/power_series.h"

namespace poinsot::test {

using Quad3 = std::array<Quad, 3>;
using Quad33 = std::array<Quad3, 3>;

// c [m], q (x y z w), P [kg·m/s] in W, m [kg·m²/s] the angular momentum in B.
struct QuadState {
  Quad3 c, P, m;
  std::array<Quad, 4> q;
};

Quad33 rotation(const std::array<Quad, 4>& q);
std::array<Quad, 4> normalized(std::array<Quad, 4> q);
Quad33 inverse(const Mat3& J);

template <typename Real>
class BodySeries {
 public:
  explicit BodySeries(const ReferenceBody& body);

  // The series about this state.
  void expand(const QuadState& state, int order);

  // Largest step [s] at which the last two terms are below `tolerance` of the largest term.
  double step(double tolerance) const;

  QuadState state_at(Quad h) const;   // q made unit
  Quad3 momentum_B_at(Quad h) const;  // m alone

  void hold(const HeldWrench& held) { body_.held = held; }

 private:
  using Real3 = std::array<Real, 3>;

  struct Spring {
    Series3<Real> lever_rate{};  // ω × p, in B
    Series3<Real> x{}, rate{};   // from the point of W to the point of the body, and its derivative
    Series3<Real> along{};       // x / |x|
    Series3<Real> force_W{};
    Series<Real> stretch_rate{};
    Length<Real> length{};
  };

  void extend(int k);  // coefficient k + 1 of the state
  void extend_rotation(int k);
  Real3 force_W(int k);   // coefficient k, springs included
  Real3 torque_B(int k);  // likewise
  void extend_spring(const ReferenceSpring& def, Spring& spring, int k);

  ReferenceBody body_;
  std::array<Real3, 3> inv_J_{};
  QuadState origin_{};
  bool needs_rotation_ = false;
  int order_ = 0;
  Series3<Real> c_{}, P_{}, v_{}, m_{}, omega_{};
  std::array<Series<Real>, 4> q_{};
  std::array<Series3<Real>, 3> R_{};
  Length<Real> speed_{};
  std::vector<Spring> springs_;
};

}  // namespace poinsot::test
