// The gap of two shapes along an axis, bounded from below for times to come.
//
// For a unit n, from b to a, the slab between the supports along n is never wider than the distance
// of the shapes; n may turn with a constant angular velocity Ω ⟂ n, or be fixed. With x the time
// from now and d = c_A − c_B,
//
//   g(x) = n·d − ρ_A − ρ_B − h_A(−n) − h_B(n)                     at x
//        ≥ L(x) = z + v x + ½ c x² − h_A(−n + x m_A) − h_B(n + x m_B)
//
// h: supports of the cores about the centres of mass, at the orientation of now. Their directions
// turn, seen from the bodies, at m_A = (ω_A − Ω) × n and m_B = (Ω − ω_B) × n. c is what the motion
// gives for sure, less what is left out: slack of driven bodies, r |m″| of each core
// (motion_bound.h), and what Ω does to n·d. h is convex, so L is concave if c ≤ 0, and a positive c
// is left out: then L is above 0 all the way between two times at which it is. Bodies that have
// nothing about their centre of mass but a ball need no such term, and L is g itself but for slack.
//
// Source: conservative advancement, Mirtich 1996; with second-order terms, README.md.

#pragma once

#include "poinsot/collision/collider.h"

namespace poinsot {

// First x ≥ 0 at which z + v x + ½ c x², z ≥ 0, is 0 and falling; infinite if there is none.
double first_root(double z, double v, double c);

// A core about the centre of mass of its body, now. Null collider: no core there.
struct TurningCore {
  const Collider* collider = nullptr;
  Mat3 R;                         // S → W
  Vec3 offset = Vec3::Zero();     // [m] of S from the centre of mass, in W
  Vec3 d, d_rate = Vec3::Zero();  // direction [-] and its rate [1/s], in W

  Vec3 direction(double x) const { return d + x * d_rate; }
  Vec3 support_at(double x) const;  // [m] from the centre of mass, in W
};

struct AxisBound {
  double z, v, c;  // [m] [m/s] [m/s²]
  TurningCore a, b;
  double central_z;  // [m] the same for the balls that hold the shapes, which do not turn:
  double central_c;  // [m/s²] central_z + v x + ½ central_c x²

  double at(double x) const;
  double slope() const;  // [m/s] of L at x = 0, to the right

  // Longest proven x ≤ most [s] for which the gap stays positive; at(0) > 0.
  double clear_until(double most) const;
  // Longest found x ≤ most for which L stays above `floor` [m] ≤ at(0).
  double above_until(double floor, double most) const;
  // Some x ≤ most with at(x) > gap [m], within a factor of two of where L is largest; 0: none.
  double leaves(double gap, double most) const;

 private:
  struct Facet {  // L with the points held that are the supports at x: never below L
    double z, v;
  };
  Facet facet_at(double x) const;
  bool turns() const { return a.collider || b.collider; }
};

}  // namespace poinsot
