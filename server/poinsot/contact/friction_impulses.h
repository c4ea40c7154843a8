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
  struct Point {
    double t[2], n;        // impulse
    double limit, length;  // of friction: μ n; before it was cut
    bool slips;
  };

  bool run(const ImpactSystem& system, double* p, bool normals_given);
  void prepare(const ImpactSystem& system, const double* p);
  double evaluate();  // velocities and residual at p_; the largest, relative
  Point project(Eigen::Index i, double step_n, double step_t) const;
  void descend();   // one damped step of all points
  void assemble();  // Newton's matrix
  bool newton();    // true: found

  // All scaled, see prepare().
  Eigen::Index n_ = 0;
  bool normals_given_ = false;
  double best_ = 0;  // residual at p_
  const double* friction_ = nullptr;
  std::vector<double> scale_, A_, start_;
  std::vector<double> p_, u_, residual_, kept_, matrix_;
  std::vector<double> damped_n_, damped_t_, step_t_;
};

}  // namespace poinsot
