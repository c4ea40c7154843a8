// The points of one group of touching bodies as numbers: what an impulse at one point does to the
// velocity at every other. All that the solvers of an impact need to know.

#pragma once

#include <Eigen/Core>

namespace poinsot {

using MatrixView = Eigen::Map<const Eigen::MatrixXd>;
using VectorView = Eigen::Map<const Eigen::VectorXd>;
using VectorOut = Eigen::Map<Eigen::VectorXd>;

// Three rows a point, in its own frame: two tangents, then the normal. Relative velocities are of
// a's point against b's, impulses act on a: u = u₀ + A p.
struct ImpactSystem {
  Eigen::Index points = 0;
  const double* A = nullptr;            // [1/kg], 3 points × 3 points, symmetric, every normal > 0
  const double* u = nullptr;            // [m/s], 3 points, before the impact
  const double* restitution = nullptr;  // points
  const double* friction = nullptr;     // points

  MatrixView inverse_mass() const { return {A, 3 * points, 3 * points}; }
  VectorView speed() const { return {u, 3 * points}; }
};

}  // namespace poinsot
