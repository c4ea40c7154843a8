// How far velocities and impulses are from the law of contact.
//
// With M (v − v*) = Jᵀ λ, at every contact
//
//   vn ≥ target,  λn ≥ 0,  λn (vn − target) = 0;   |λt| ≤ μ λn,  and where the point slides,
//   λt = −μ λn vt / |vt|
//
// and at every joint the relative velocity is its target. All residuals are velocities: impulses
// are weighed by what a unit of them changes at the point itself, beside the others.

#pragma once

#include <span>

#include "poinsot/contact/contact.h"

namespace poinsot {

struct SolveResidual {
  double normal = 0;  // [m/s] largest |min(λn w, vn − target)|, w: inverse effective mass
  double friction = 0;  // [m/s] largest distance of w λt from the point of the disc |·| ≤ w μ λn
                        // that is nearest to w λt − vt
  double joint = 0;  // [m/s] largest relative velocity of a joint beside its target
  double balance = 0;  // [m/s] largest |v − v* − M⁻¹Jᵀλ|, at a body's centre or its contacts
  int iterations = 0;  // of Newton's method, all passes together
  int passes = 0;      // proximal and de Saxcé
  int factorisations = 0;
  bool converged = false;

  double worst() const;  // [m/s] of the four
};

// Of velocities `after` and the impulses of contacts and joints, from the velocities `before`.
// Contacts of a body or with values that are not finite are passed over. Allocates.
SolveResidual measure_residual(std::span<const ContactBody> before,
                               std::span<const ContactBody> after,
                               std::span<const Contact> contacts, std::span<const double> target,
                               std::span<const PointJoint> joints = {});

}  // namespace poinsot
