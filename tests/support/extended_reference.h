// The motion of one rigid body in extended precision: what results in double are measured against.
//
//   c′ = P/m    q′ = ½ q (0, ω)    P′ = F    m_B′ = m_B × ω + τ        ω = J⁻¹ m_B,  τ in B
//
// F, τ: gravity, a held wrench, drag, springs to points of W. Taylor series of high order in 113
// bits, steps by the decay of the coefficients: a local error of 1e-30 relative to each quantity.
// Inputs are exact doubles; outputs are rounded once, errors are formed before rounding. It costs
// some 2 ms per radian turned; kQuick is twenty times faster, with a local error of 1e-20.
//
// Near the separatrix of free rotation errors are amplified by up to 1/k'²: about 1e-32/k'² rad is
// left once the body has turned over. Quadratic drag through v = 0 and springs through zero length
// are not analytic there: steps go down to 1e-9 s, and the local error is then below 1e-24.

#pragma once

#include <memory>
#include <vector>

#include "poinsot/simulation/held_wrench.h"

namespace poinsot::test {

// As SpringDef, from a point of the body to a point of W.
struct ReferenceSpring {
  Vec3 point_B = Vec3::Zero();  // [m] from the centre of mass
  Vec3 point_W = Vec3::Zero();  // [m]
  double stiffness = 0;         // [N/m]
  double damping = 0;           // [N·s/m]
  double rest_length = 0;       // [m]
};

struct ReferenceBody {
  double mass = 1;              // [kg]
  Mat3 J_B = Mat3::Identity();  // [kg·m²] about the centre of mass
  Vec3 gravity = Vec3::Zero();  // [m/s²] in W
  HeldWrench held = {};         // constant in its frames
  double drag_linear = 0;       // [N·s/m] as DragDef
  double drag_quadratic = 0;    // [N·s²/m²]
  double drag_angular = 0;      // [N·m·s/rad]
  std::vector<ReferenceSpring> springs = {};
};

struct ReferenceOptions {
  int order = 30;            // at most kMaxOrder
  double tolerance = 1e-30;  // [-] of the last two terms of a step
  bool quad = true;          // coefficients of 113 bits, else of 64
};
inline constexpr ReferenceOptions kQuick = {.order = 20, .tolerance = 1e-20, .quad = false};

class ExtendedReference {
 public:
  // q need not be exactly unit: it is made so in extended precision. P [kg·m/s] and L [kg·m²/s],
  // about the centre of mass, in W, as in the state of the simulation layer.
  ExtendedReference(const ReferenceBody& body, const Vec3& c, const Quat& q, const Vec3& P_W,
                    const Vec3& L_W, const ReferenceOptions& options = {});
  ~ExtendedReference();
  ExtendedReference(ExtendedReference&&) noexcept;

  void advance_to(double t);  // [s] from 0, not before the present time

  // Replaces the held wrench from now on.
  void hold(const HeldWrench& held);

  Vec3 position() const;            // [m] of the centre of mass, in W
  Quat orientation() const;         // B → W
  Vec3 momentum() const;            // [kg·m/s] in W
  Vec3 angular_momentum() const;    // [kg·m²/s] about the centre of mass, in W
  Vec3 angular_momentum_B() const;  // the same in B
  Vec3 angular_velocity() const;    // [rad/s] in W
  double kinetic_energy() const;    // [J]

  // Distances, formed in extended precision [rad], [m]. The quaternion need not be exactly unit.
  double orientation_error(const Quat& q) const;
  double position_error(const Vec3& c) const;
  double orientation_error(const ExtendedReference& other) const;
  double position_error(const ExtendedReference& other) const;

  // Relative change of kinetic energy and of angular momentum (in W) since the start.
  double energy_drift() const;
  double angular_momentum_drift() const;

  // ∫ |ω| dt since the start [rad], to about 1e-6 relative.
  double spin_phase() const;

 private:
  struct Motion;
  std::unique_ptr<Motion> motion_;
};

// The reference of a body with this angular velocity [rad/s] in W; L is formed in double, as
// the simulation layer does.
ExtendedReference reference_of(const ReferenceBody& body, const Vec3& c, const Quat& q,
                               const Vec3& velocity_W, const Vec3& omega_W,
                               const ReferenceOptions& options = {});

}  // namespace poinsot::test
