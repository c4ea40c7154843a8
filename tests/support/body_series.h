// Taylor series of one rigid body's motion about the present time, in 113 bits.

#pragma once

#include <vector>

#include "support/extended_reference.h"
#include "support/quad_series.h"

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

class BodySeries {
 public:
  explicit BodySeries(const ReferenceBody& body);

  // The series about this state.
  void expand(const QuadState& state, int order);

  // Largest step [s] at which the last two terms are below `tolerance` of the largest term.
  double step(double tolerance) const;

  QuadState state_at(Quad h) const;   // q made unit
  Quad3 momentum_B_at(Quad h) const;  // m alone

  const Quad33& inv_J() const { return inv_J_; }
  const ReferenceBody& body() const { return body_; }
  void hold(const HeldWrench& held) { body_.held = held; }

 private:
  struct Spring {
    Series3 lever_rate{};  // ω × p, in B
    Series3 x{}, rate{};   // from the point of W to the point of the body, and its derivative
    Series3 along{};       // x / |x|
    Series3 force_W{};
    Series stretch_rate{};
    Length length{};
  };

  void extend(int k);  // coefficient k + 1 of the state
  void extend_rotation(int k);
  Quad3 force_W(int k);   // coefficient k, springs included
  Quad3 torque_B(int k);  // likewise
  void extend_spring(const ReferenceSpring& def, Spring& spring, int k);
  bool fits(double h, double tolerance) const;

  ReferenceBody body_;
  Quad33 inv_J_{};
  bool needs_rotation_ = false;
  int order_ = 0;
  Series3 c_{}, P_{}, v_{}, m_{}, omega_{};
  std::array<Series, 4> q_{};
  std::array<Series3, 3> R_{};
  Length speed_{};
  std::vector<Spring> springs_;
};

}  // namespace poinsot::test
