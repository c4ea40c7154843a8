// Contacts four at a time: what the soft step spends its time on.
//
// All points of a manifold lie in one plane, so its impulses are a wrench at its centre and what
// they change is the relative twist there: six numbers in the frame (n, t1, t2). With the 6×6
// matrix between the two, points and friction are solved without touching the bodies; these are
// read once before and written once after. A point at x t1 + y t2 from the centre moves apart at
// v_n + y ω_1 − x ω_2. Contacts of one block share no movable body.
//
// Compiled for more than one width and chosen by what the processor has; the bits are the same.

#pragma once

#include <array>
#include <cstdint>

#include "poinsot/contact/soft_lanes.h"

namespace poinsot {

// What the sweeps read and write of a body.
struct alignas(64) HotBody {
  Lanes v = {}, omega = {};        // [m/s], [rad/s] in W
  Lanes shift = {};                // [m] since the start of the step
  Lanes turn = Lanes{0, 0, 0, 1};  // x y z w, likewise
};

// What contacts read of a body when they are made ready.
struct SoftMass {
  std::array<double, 6> inv_J_W;  // xx xy xz yy yz zz
  double inv_mass;
};

struct SoftPointLanes {
  Lanes x, y;          // [m] from the centre along t1, t2
  Lanes radius;        // [m] from the centre
  Lanes gap;           // [m]
  Lanes start_gap;     // [m] at the start of the step
  Lanes impulse;       // [N·s]
  Lanes load;          // [N·s] its mean for long
  Lanes inv_response;  // [kg]
  Lanes heave;         // [1/kg] change of its velocity by one impulse on every point
  Lanes approach;      // [m/s] relative normal velocity at the start of the step
  Lanes peak;          // [N·s] largest impulse so far
};

struct alignas(64) SoftBlock {
  static constexpr int kPoints = 4;

  std::array<int, kLanes> a, b;    // bodies
  std::array<int, kLanes> source;  // manifolds; −1: none, a lane that does nothing
  std::array<bool, kLanes> move_a, move_b;
  int count = 0;         // of points, the most of all lanes
  bool bounces = false;  // a lane has restitution
  bool turns = false;    // a body's inverse inertia changes as it turns

  Vec3Lanes n, t1, t2, arm_a, arm_b;
  Lanes inv_mass_a, inv_mass_b;
  Sym3Lanes inv_J_a, inv_J_b;
  // Response of the twist to a wrench, by blocks: push = (v_n, ω_1, ω_2), drag = (v_1, v_2, ω_n).
  Sym3Lanes push_push, drag_drag;
  Lanes push_drag[3][3];                        // of push to a wrench of drag
  Lanes point_point[6];                         // 01 02 03 12 13 23
  Lanes inv_drag_11, inv_drag_12, inv_drag_22;  // [kg]
  Lanes inv_heave;                              // [kg]
  Lanes slip_gain, inv_twist;                   // [kg], [kg·m²]
  Lanes friction, restitution;
  Lanes bend_a, bend_b;  // [-] 0: the surface is round, 1: its points turn with it
  Lanes slop, near;      // [m]
  Lanes overshoot;  // [-] of the impulse that would stop a resting point; below 0: it is softer
  Lanes drag_1 = {}, drag_2 = {}, twist = {};  // [N·s], [N·s], [N·m·s]
  Lanes roll_1 = {}, roll_2 = {};              // [N·m·s] resistance to rolling
  std::array<SoftPointLanes, kPoints> points;

  Lanes push_work = {};  // [J]
  Lanes residual = {};   // [m/s]
};

struct SoftRates {
  double h, inv_h;        // [s], [1/s]
  double push_out_rate;   // [1/s]
  double push_out_speed;  // [m/s]
  double rest_speed;      // [m/s]
  double rolling_arm;     // [m]
  double fade, learn;     // [-] see soft_blocks.cpp
};

struct SoftKernels {
  // From arms, axes and masses to responses; again after a body's inertia has turned.
  void (*respond)(SoftBlock& block, const SoftMass* masses);
  // Relative normal velocities before the step.
  void (*note_approach)(SoftBlock& block, const HotBody* bodies);
  void (*warm_start)(SoftBlock& block, HotBody* bodies);
  // One sweep with the removal of penetration, before bodies move …
  void (*push)(SoftBlock& block, HotBody* bodies, const SoftRates& rates);
  // … and one without it, with friction, after they have.
  void (*relax)(SoftBlock& block, HotBody* bodies, const SoftRates& rates);
  void (*bounce)(SoftBlock& block, HotBody* bodies, const SoftRates& rates);
};

SoftKernels soft_kernels();           // for this processor
SoftKernels baseline_soft_kernels();  // for any: the same bits

}  // namespace poinsot
