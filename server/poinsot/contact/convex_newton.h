// Contacts and joints solved as one: the accurate solver, at any mass ratio.
//
// Finds velocities v and impulses λ with  M (v − v*) = Jᵀ λ  such that at every contact
//
//   vn ≥ target,  λn ≥ 0,  λn (vn − target) = 0;   |λt| ≤ μ λn,  and where the point slides,
//   λt = −μ λn vt / |vt|
//
// and at every joint the relative velocity is its target. Cones are exact circles.
//
// Method: the regularised convex problem in v has no constraints and is solved by Newton's method
// with an exact line search and a sparse block LDLᵀ factorisation; the regularisation is then taken
// back by proximal passes (λ of the last pass in place of zero), and the floating of sliding
// points, which the convex law implies, by de Saxcé passes (target − μ |vt| of the last passes,
// accelerated). Before each pass, one step with the active set that impulses and velocities suggest
// is tried: near the solution it takes the place of the pass. Where several solutions exist, the
// start decides. Some problems of much friction at odd angles have none that the passes find: then
// `converged` is false, and the best impulses found are returned, within their cones as ever.
// Sources: Castro, Permenter, Han, An Unconstrained Convex Formulation of Compliant Contact (2022);
// de Saxcé, Feng (1998); Rockafellar, Augmented Lagrangians (1976); Hintermüller, Ito, Kunisch, The
// Primal-Dual Active Set Strategy (2002).

#pragma once

#include <memory>
#include <span>

#include "poinsot/contact/contact.h"
#include "poinsot/contact/solve_residual.h"

namespace poinsot {

class ConvexNewton {
 public:
  double tolerance = 1e-10;  // [m/s] residual that ends the passes, or the rounding of the loads
  double acceptable = 0;     // [m/s] residual that ends a solve of many iterations;
                             // the more of them, the more is acceptable
  int max_passes = 60;
  int max_iterations = 200;  // all passes together

  ConvexNewton();
  ~ConvexNewton();
  ConvexNewton(ConvexNewton&&) noexcept;
  ConvexNewton& operator=(ConvexNewton&&) noexcept;

  // target[i] [m/s] per contact. Starts from the impulses of contacts and joints and leaves the new
  // ones there; bodies get their new velocities. What is not finite is left out: its impulse is
  // zero. Momentum is conserved to rounding: velocities are v* + M⁻¹Jᵀλ of the impulses that are
  // returned. The result does not depend on what was solved before, but for the start; allocates
  // only when a problem is larger than any before.
  SolveResidual solve(std::span<ContactBody> bodies, std::span<Contact> contacts,
                      std::span<const double> target, std::span<PointJoint> joints = {});

  // The same without friction, from zero, without touching the contacts' impulses: used on
  // pseudo-velocities that move bodies apart.
  SolveResidual push_out(std::span<ContactBody> bodies, std::span<const Contact> contacts,
                         std::span<const double> target);

 private:
  struct Scratch;

  SolveResidual improve(double residual, bool first);
  SolveResidual iterate();
  double acceptable_after(int iterations) const;

  std::unique_ptr<Scratch> scratch_;
};

}  // namespace poinsot
