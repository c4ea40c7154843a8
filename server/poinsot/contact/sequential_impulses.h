// Sequential impulses: one contact after the other, swept until the impulses settle.
//
// Each visit gives its contact the impulse that makes the relative velocity right, all others being
// as they are: normal impulses push (λ ≥ 0), friction stays in the circular Coulomb cone |λt| ≤ μ
// λ. Impulses come in opposite pairs, so momentum is conserved to rounding. Sweeps alternate in
// direction, and stop early when no visit changes a velocity noticeably.
//
// Source: Catto, Iterative Dynamics with Temporal Coherence (2005); projected Gauss–Seidel.

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/contact.h"

namespace poinsot {

class SequentialImpulses {
 public:
  int sweeps = 20;              // at most
  double settled_speed = 1e-7;  // [m/s] largest velocity change of a visit that ends the sweeps

  // The relative velocity of a contact's points along its normal after the solve is at least
  // target[i] [m/s] (up to the sweeps' residual). Starts from the contacts' impulses and leaves the
  // new ones there; velocities of the bodies are changed accordingly, the starting impulses
  // included. An impulse that is not finite stays out of the contacts.
  void solve(std::span<ContactBody> bodies, std::span<Contact> contacts,
             std::span<const double> target);

  // The same for normal impulses only, from zero, without touching the contacts' impulses: used on
  // pseudo-velocities that move bodies apart.
  void push_out(std::span<ContactBody> bodies, std::span<const Contact> contacts,
                std::span<const double> target);

 private:
  struct Row {
    Vec3 direction;             // of the impulse on a
    Vec3 angular_a, angular_b;  // r × direction
    Vec3 turn_a, turn_b;        // J⁻¹ (r × direction): what a unit impulse adds to ω
    double inv_effective_mass = 0;
    double effective_mass = 0;
  };
  struct Prepared {
    int a, b;
    double inv_mass_a, inv_mass_b;
    Row normal, tangent[2];
    double impulse = 0;
    double friction_impulse[2] = {0, 0};
  };

  static Row make_row(const ContactBody& a, const ContactBody& b, const Vec3& point,
                      const Vec3& direction);
  static double speed(const Prepared& p, const Row& row, std::span<const ContactBody> bodies);
  static void apply(const Prepared& p, const Row& row, double impulse,
                    std::span<ContactBody> bodies);
  void prepare(std::span<const ContactBody> bodies, std::span<const Contact> contacts,
               bool with_friction);
  double visit_normal(Prepared& p, double target, std::span<ContactBody> bodies);
  double visit_friction(Prepared& p, double friction, std::span<ContactBody> bodies);

  std::vector<Prepared> prepared_;
};

}  // namespace poinsot
