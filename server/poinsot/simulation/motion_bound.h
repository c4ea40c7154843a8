// Motion bounds: how fast and how far any point of a body can move. Rigorous: never smaller than
// what the body does, whatever the time.
//
// Free rotation (rotation_bound), closed form from the polhode, for all times:
//   omega   |ω| ≤     its square is linear in sn² u, so one end of the polhode has the largest
//   alpha   |α| ≤     from |mᵢ| ≤ Mᵢ in each of Euler's equations
//   along   ω·L̂       constant, 2T/|L|
//   perp    |ω − along L̂| ≤ sqrt(omega² − along²)
//
// For a direction n fixed in W and n_B = Rᵀ n:
//   |n_B′| ≤ W(n) = along sin(L̂, n) + perp        |n_B″| ≤ W(n) omega + alpha
// so the gap to a plane, seen by a support function h of n_B, obeys for x ≥ 0
//   h(n_B(t + x)) ≤ h(n_B + x n_B′) + ½ r x² (W omega + alpha),
// which is what a second-order conservative advancement needs.
//
// Driven bodies (speed_bound): with S = sqrt(2 (T + U)) of bodies coupled by springs,
//   S(t + h) ≤ S(t) + h sqrt(Σ |F|²/m + |τ|²/J₁),   |v| ≤ S/√m,   |ω| ≤ S/√J₁;
// drag and damping only lower S. The point p of a tether is never farther than S/√k from its end,
// so that c moves no farther than S/√k + |x_p − target| + 2 |p|. Source: README.md, section
// "Bounds".

#pragma once

#include <limits>
#include <span>
#include <vector>

#include "poinsot/math/principal_axes.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

struct RotationBound {
  double omega = 0;           // [rad/s]
  double alpha = 0;           // [rad/s²]
  double along = 0;           // [rad/s]
  double perp = 0;            // [rad/s]
  Vec3 axis = Vec3::UnitZ();  // L̂ in W

  double turn_rate(const Vec3& n) const;           // W(n) [rad/s]; n unit, in W
  double turn_acceleration(const Vec3& n) const {  // of n_B [rad/s²]
    return turn_rate(n) * omega + alpha;
  }

  template <class Archive>
  void archive(Archive& with) {
    with(omega, alpha, along, perp, axis);
  }
};

// Of a body that rotates freely with angular momentum L [kg·m²/s] in W at orientation R (B → W).
RotationBound rotation_bound(const PrincipalAxes& body, const Mat3& R, const Vec3& L);

// Largest distance [m] that a point within r of the centre of mass covers in h [s] of free flight.
double reach(const World& world, Eigen::Index i, const RotationBound& bound, double r, double h);

// The same along a unit direction n in W: upper bound of n·(x(t + h) − x(t)) [m].
double reach_along(const World& world, Eigen::Index i, const RotationBound& bound, const Vec3& n,
                   double r, double h);

// Largest speeds of a body.
struct SpeedBound {
  double v = 0;      // [m/s] of the centre of mass
  double omega = 0;  // [rad/s]
};

// Bounds for a body on which something acts, for the next h. `contacts` [N, N·m] per body, constant
// in W about c; empty: none act.
struct DrivenBound {
  SpeedBound speed;
  double path = std::numeric_limits<double>::infinity();  // [m] c moves no farther: tethers hold it
  Vec3 acceleration = Vec3::Zero();                       // [m/s²] the part that is constant
  double slack = 0;                                       // [m/s²] of the rest
  RotationBound rotation;
};
DrivenBound driven_bound(const World& world, Eigen::Index i, std::span<const Wrench> contacts,
                         double h);

// Speed bounds of all bodies for the next h, unless a contact acts. They hold for the motion
// itself: an integrator that gains energy (explicit_euler on a stiff spring) may leave them.
class SpeedBounds {
 public:
  // From the present state. Allocates in the first call only.
  void update(const World& world, double h);

  SpeedBound of(const World& world, Eigen::Index i) const;

 private:
  double h_ = 0;                  // [s]
  std::vector<double> energies_;  // per system: S at the end [√J]
};

}  // namespace poinsot
