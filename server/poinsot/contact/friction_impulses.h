// An inelastic impact with Coulomb friction at many points at once: at every point either pn = 0
// and un ≥ 0, or un = 0; and ut = 0 with |pt| ≤ μ pn, or pt = −μ pn ut/|ut|. Cones are circular.
// Such an impact loses energy: ΔE = p·u − p·A p/2 ≤ 0, u after it.
//
// Method: the law as a fixed point of projections (Alart, Curnier), whose zero is sought by
// Newton's method from where damped projection steps lead; all points at once, so that their order
// does not matter. ImpactSystem's restitution is not looked at.
//
// Source: Alart, Curnier, A mixed formulation for frictional contact problems prone to Newton like
// solution methods (1991); Acary, Brogliato, Numerical methods for nonsmooth dynamical systems
// (2008).

#pragma once

#include <vector>

#include "poinsot/contact/impact_system.h"

namespace poinsot {

class FrictionImpulses {
 public:
  // Starts from the p given. False: the law is met to no better than 1e-9 of the speeds at hand; p
  // is then in its cones all the same.
  bool solve(const ImpactSystem& system, double* p);

  // The same with the normal impulses of p as they are.
  bool solve_tangential(const ImpactSystem& system, double* p);

 private:
  bool run(const ImpactSystem& system, double* p, bool normals_given);
  void project();     // one damped step of all points, and the residual before it
  bool newton();      // true: the residual is at rounding
  double evaluate();  // residual of the law at p_, relative
  void assemble();    // Newton's matrix
  void into_cones(double* p) const;

  const ImpactSystem* system_ = nullptr;
  bool normals_given_ = false;
  std::vector<double> p_, u_, residual_, kept_;
  std::vector<double> step_n_, step_t_;  // of the fixed point [kg]
  std::vector<double> damped_n_, damped_t_;
  std::vector<double> matrix_;
  std::vector<int> rows_;
};

}  // namespace poinsot
