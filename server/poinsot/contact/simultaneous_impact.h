// Points that share bodies, resolved at once.
//
// e = 1: generalized reflections. All points that approach are compressed at once (the inelastic
// impact among them), and what compression took is given back; again until no point approaches.
// e = 0: the inelastic impact of all points. In between the outcomes are blended, point by point:
//
//     p = ∫₀¹ p(points with restitution ≥ s are elastic, the others inelastic) ds,
//
// a finite sum, which for one common e is (1 − e) p_inelastic + e p_elastic. Each part neither
// approaches nor gains energy nor leaves its cones, and all three are convex, so the sum does not
// either.
//
// Source: Smith, Kaufman, Vouga, Tamstorf, Grinspun, Reflections on simultaneous impact (2012).

#pragma once

#include <span>
#include <vector>

#include "poinsot/contact/friction_impulses.h"
#include "poinsot/contact/impact_system.h"
#include "poinsot/contact/normal_impulses.h"

namespace poinsot {

class SimultaneousImpact {
 public:
  struct Result {
    bool converged = true;
    int passes = 0;
  };

  // p: 3 numbers a point, as the system has them.
  Result resolve(const ImpactSystem& system, std::span<double> p);

 private:
  // An outcome with the points elastic whose restitution reaches the threshold, into q_.
  void reflections(double threshold);
  void inelastic();

  void start();
  // Into members_: points that approach at v_, and inelastic ones that do not part, which hold
  // while the others are pressed. False: none approaches.
  bool find_approaching(double threshold);
  void gather();                   // the members' part of the system, from the velocities v_
  void compress();                 // the inelastic impact of the members, into part_p_
  void restore(double threshold);  // what the elastic members give back, into part_p_
  void add(double factor);         // part_p_ of the members to q_, v_ and scale_
  void end_approach();             // all points, inelastic, without friction
  // p·u + p·A p/2 of the members, u their velocities as gathered [J].
  double energy(const std::vector<double>& p) const;

  const ImpactSystem* system_ = nullptr;
  bool frictionless_ = true;
  Result result_;
  NormalImpulses normal_;
  FrictionImpulses friction_;
  std::vector<double> levels_;  // distinct restitutions, ascending
  std::vector<double> q_, v_;   // impulses so far and the velocities after them
  std::vector<double> scale_;   // [m/s] a point: magnitudes that cancel in its velocity
  std::vector<int> members_;
  bool faded_ = false;  // they approach, but too slowly to be worth a reflection
  std::vector<char> is_member_;
  ImpactSystem part_;  // of the members
  std::vector<double> part_A_, part_u_, part_friction_, part_N_, part_un_, part_p_, lambda_;
  double part_energy_ = 0;  // what compression added [J], ≤ 0
};

}  // namespace poinsot
