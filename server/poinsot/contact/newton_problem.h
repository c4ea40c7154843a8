// What the convex solver works on: moving bodies and points, contacts and joints alike.
//
// Velocities at a point are of a's point relative to b's, in the point's frame (normal, two
// tangents; W of a joint). Bodies of infinite mass are no unknowns: what they bring is `carried`.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/contact.h"
#include "poinsot/contact/contact_cone.h"
#include "poinsot/contact/solve_residual.h"

namespace poinsot {

struct NewtonBody {
  int index = 0;  // in the caller's array
  Vec3 c;
  double mass = 0, inv_mass = 0;
  Mat3 J, inv_J;
  bool turns = true;
  Vec3 v_free, omega_free;  // without impulses
  Vec3 v, omega;            // with the impulses `trial` of the points
  double reach = 0;         // [m] of its points from its centre
};

struct NewtonPoint {
  int a = 0, b = 0;  // moving bodies, kFixed if infinite
  int source = 0;    // contact or joint
  bool joint = false;
  double friction = 0;
  Vec3 arm_a, arm_b;                   // [m] from the centres, zero where the body does not turn
  Mat3 frame;                          // columns: normal, tangents
  Vec3 carried;                        // [m/s]
  double w_normal = 0, w_tangent = 0;  // [1/kg] inverse effective mass
  ConeScale scale;
  Vec3 target;          // [m/s]
  double shift = 0;     // [m/s] μ times this is what de Saxcé takes from the normal target
  Vec3 trial;           // [N·s]
  Vec3 trial_velocity;  // [m/s] that goes with `trial`
  Vec3 start;           // [N·s] of the last pass
  Vec3 velocity;        // [m/s] that goes with `start`
  double speed = 0;     // [m/s] tangential part of it
  Vec3 moved, step;     // [m/s] since, and along Newton's direction
  ConeImpulse cone;     // with `moved`
};

constexpr int kFixed = -1;

class NewtonProblem {
 public:
  // Points whose data are not finite, or that nothing can move, are left out. Impulses start from
  // those of contacts and joints if `warm`.
  void load(std::span<const ContactBody> bodies, std::span<const Contact> contacts,
            std::span<const double> target, std::span<const PointJoint> joints, bool frictional,
            bool warm);
  // Velocities v* + M⁻¹Jᵀλ of λ = trial, of bodies and points, and how far they are from the law.
  SolveResidual follow_trial();
  // The last trial is where the next pass starts.
  void accept_trial();
  // R of points [-] beside their inverse effective masses. Smaller: fewer passes; larger: smoother.
  void set_softness(double softness);
  double softness() const { return softness_; }
  // [m/s] Below, velocities at points are rounding.
  double rounding() const;

  double largest_load() const;  // [m/s] λn w of the accepted impulses

  double mass_ratio = 1;  // of the heaviest body to the lightest
  std::vector<NewtonBody> bodies;
  std::vector<NewtonPoint> points;

 private:
  void load_bodies(std::span<const ContactBody> from);
  void add(NewtonPoint& point, const Vec3& at, std::span<const ContactBody> from, int a, int b,
           Vec3 carried);

  SolveResidual measure_trial() const;

  double softness_ = 0;
  std::vector<int> moving_;  // of the caller's body, kFixed or kUnsound
  std::vector<Vec3> pushes_, moments_;
};

}  // namespace poinsot
