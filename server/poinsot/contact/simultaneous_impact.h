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
  // Points with restitution ≥ threshold are elastic, the others inelastic. Into q_.
  void resolve_at(double threshold);
  void inelastic();
  void reflections(double threshold);
  bool find_approaching();         // members_ of the velocities v_; false: none
  bool compress();                 // members_: c_, from v_
  void restore(double threshold);  // members_: r_, after c_
  void add(const std::vector<double>& part, double factor);  // to q_ and v_
  void end_approach();                                       // without friction, all points
  double tolerance(Eigen::Index point) const;
  void gather();  // the members' part of the system

  const ImpactSystem* system_ = nullptr;
  bool frictionless_ = true;
  Result result_;
  NormalImpulses normal_;
  FrictionImpulses friction_;
  std::vector<double> levels_;  // distinct restitutions, ascending
  std::vector<double> q_, v_;   // impulses so far and velocities after them
  std::vector<double> scale_;   // [m/s] speeds met at each point
  std::vector<int> members_;
  ImpactSystem part_;  // of the members
  std::vector<double> part_A_, part_u_, part_friction_, part_N_, part_un_, c_, r_, lambda_;
};

}  // namespace poinsot
