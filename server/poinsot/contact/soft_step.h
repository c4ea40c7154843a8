// Contacts of many bodies at once, stepped fast: the solver of crowds.
//
// One set of contact points serves a whole step of several sub-steps. In each of them velocities
// take the forces, impulses of the last one are applied again, one sweep solves the contacts with
// what moves bodies apart, positions move, and one sweep without it takes back the velocity that it
// gave. Approach is stopped rigidly; only the removal of penetration is soft, its frequency tied to
// the sub-step. Points keep to their bodies meanwhile: only their gaps are followed.
//
// Contacts are coloured so that no body is twice in a colour; those of one colour are solved four
// at a time, and by several threads. The bits depend on neither. Sources: Macklin et al., Small
// Steps in Physics Simulation (2019); Catto, Solver2D (2024); facts in README.md.

#pragma once

#include <memory>
#include <span>

#include "poinsot/base/parallel.h"
#include "poinsot/contact/contact.h"

namespace poinsot {

// A body over a step. Forces are constant in W meanwhile.
struct SoftBody {
  Vec3 c;                       // [m]
  Quat q;                       // B → W
  Vec3 v;                       // [m/s]
  Vec3 L;                       // [kg·m²/s] angular momentum about c, in W
  Vec3 omega;                   // [rad/s]; of a body of infinite mass as given, else derived from L
  Vec3 acceleration;            // [m/s²] of all forces but contacts
  Vec3 torque;                  // [N·m] likewise, in W
  double inv_mass = 0;          // [1/kg] 0: nothing moves it, it moves evenly
  Mat3 inv_J_B = Mat3::Zero();  // [1/(kg·m²)]
  bool turns_evenly = false;    // J is isotropic: ω changes by torque only
};

// Where two bodies touch or may touch: a plane, up to four points, one friction at their middle.
struct SoftManifold {
  static constexpr int kMaxPoints = 4;

  int a = 0, b = 0;             // bodies; one of them may be immovable
  int count = 0;                // of points, ≥ 1
  Vec3 normal = Vec3::UnitZ();  // unit, in W, from b to a
  // The surface is round where it touches (a ball, a capsule's side): another of its points comes
  // under the normal as it turns, so that turning brings it no nearer to second order.
  bool round_a = false, round_b = false;
  double friction = 0, restitution = 0;
  double size = 0;  // [m] of the pair: what its tolerances are relative to
  // Of a sub-step on a, in W: start of the next step, and result.
  Vec3 friction_impulse = Vec3::Zero();  // [N·s] perpendicular to the normal
  double twist_impulse = 0;              // [N·m·s] about the normal
  struct Point {
    Vec3 arm_a = Vec3::Zero(),
         arm_b = Vec3::Zero();  // [m] in W from c to the point on either surface
    double gap = 0;             // [m] at the start of the step, along the normal
    double normal_impulse = 0;  // [N·s] of a sub-step: start of the next step, and result
    // [N·s] Its mean over hundreds of sub-steps, likewise: what it is not let go below. A point
    // that forgets it sags under its load.
    double usual_impulse = 0;
  } points[kMaxPoints];
};

struct SoftSettings {
  int steps = 4;                   // sub-steps
  double push_out_speed = 1;       // [m/s] upper bound of the removal of penetration
  double allowed_penetration = 0;  // [-] that is left alone, relative to the pair's size
  double rest_speed = 0.1;         // [m/s] slower approaches do not bounce
  double rolling_resistance = 0;   // [m] arm of the rolling moment; 0: none
};

struct SoftOutcome {
  double loss = 0;             // [J] kinetic energy that contact impulses took at fixed poses
  double push_out_energy = 0;  // [J] that the removal of penetration added, beside
  double force_work = 0;       // [J] of all forces but contacts, weight included
  double max_penetration = 0;  // [m] at the end
  std::uint32_t pushing = 0;   // points with an impulse in the last sub-step
  double residual = 0;  // [m/s] largest change of a relative normal velocity in the last sweep
};

class SoftStep {
 public:
  SoftStep();
  ~SoftStep();
  SoftStep(SoftStep&&) noexcept;
  SoftStep& operator=(SoftStep&&) noexcept;

  // Moves the bodies on by `duration` [s] and leaves the impulses of the last sub-step in manifolds
  // and joints. A gap at the end is the one at the start plus what its points moved along the
  // normal; it replaces the one at the start. Allocates only when a problem is larger than any
  // before.
  SoftOutcome advance(std::span<SoftBody> bodies, std::span<SoftManifold> manifolds,
                      std::span<PointJoint> joints, double duration, const SoftSettings& settings,
                      Team& team);

 private:
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};

}  // namespace poinsot
