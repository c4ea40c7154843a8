// A system: bodies that must be integrated together, because springs join them. A body without a
// spring to another is a system of one.
//
// Integrators see a system as the ODE y′ = f(y) of 17 rows per body:
//
//   c  [m]        rows 0 … 2    centre of mass, in W
//   q  [-]        rows 3 … 6    orientation x y z w, B → W
//   P  [kg·m/s]   rows 7 … 9    momentum, in W
//   m  [kg·m²/s]  rows 10 … 12  angular momentum about c, in B
//   W  [J]        row 13        work done on the body by all but gravity and elastic springs
//   H  [N·m·s]    rows 14 … 16  angular impulse about c, in W
//
//   c′ = P/M    q′ = ½ Q(q) ω_B    P′ = F    m′ = m × ω + τ    W′, H′: power and torque
//
// Angular momentum is integrated in body axes: in W it would inherit the error of q when it is
// turned back, which near the separatrix costs four digits. What acts is constant over an advance,
// each part in its own axes. Source: README.md, "Equations".

#pragma once

#include <span>
#include <vector>

#include "poinsot/scene/scene.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

using SystemState = Eigen::Matrix<double, 17, Eigen::Dynamic>;  // 17×n

// A body as integrators see it.
struct SystemBody {
  double mass;        // [kg]
  double inv_mass;    // [1/kg]
  Mat3 J_B, inv_J_B;  // [kg·m²] [1/(kg·m²)]
  Vec3 weight;        // [N] in W
  HeldWrench push;    // held and contact wrenches
  DragDef drag;
  // Which parts the push has.
  bool couple_in_W, force_in_B, torque_in_B, at_points;
  bool dragged;

  bool pushed_in_B() const { return couple_in_W || force_in_B || torque_in_B || at_points; }
};

// Body i with what acts on it from now on; `contact` about c in W.
SystemBody system_body(const World& world, Eigen::Index i, const Wrench& contact);

// What a derivative needs of each body on the way.
struct BodyRates {
  Mat3 R;        // B → W
  Vec3 v;        // [m/s] in W
  Vec3 omega_B;  // [rad/s] in B
};

struct System {
  std::span<const SystemBody> bodies;
  std::span<const SpringLink> springs;
  std::span<BodyRates> scratch;  // as many as bodies

  Eigen::Index size() const { return static_cast<Eigen::Index>(bodies.size()); }

  // dy = f(y). q need not be exactly unit. Pure.
  void derivative(const SystemState& y, SystemState& dy) const;
};

// Brings all orientations back to unit length.
void normalize_orientations(SystemState& y);

// Between column i of the world and column j of a system: m = Rᵀ L, W = 0, H = 0, and back.
void gather(const StateArray& y, Eigen::Index i, SystemState& s, Eigen::Index j);
void scatter(const SystemState& s, Eigen::Index j, StateArray& y, Eigen::Index i);
Eigen::Matrix<double, 13, 1> world_column(const SystemState& s, Eigen::Index j);

}  // namespace poinsot
