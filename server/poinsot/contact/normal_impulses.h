// The inelastic impact without friction, exactly: λ ≥ 0, w = N λ + u ≥ 0, λ·w = 0.
//
// In the metric of the masses this is the projection of the velocities onto those that do not
// approach, so w is unique and energy only goes. Where N is singular (four corners of a brick) the
// λ of least norm, relative to each point's effective mass, is taken to some 1e-7.
//
// Method: block principal pivoting on N + ε D, whose solution is unique, then proximal steps that
// take ε out again. Each ends after finitely many exchanges (Murty's rule when blocks do not help).
//
// Source: Júdice, Pires (1994); Kim, Park, Fast nonnegative matrix factorization (2011).

#pragma once

#include <vector>

#include "poinsot/contact/impact_system.h"

namespace poinsot {

class NormalImpulses {
 public:
  // N: n × n, symmetric, positive semi-definite, positive diagonal. False: exchanges ran out, λ is
  // then what was reached, never negative.
  bool solve(Eigen::Index n, const double* N, const double* u, double* lambda);

 private:
  void factor();         // of N + ε D among the pushing points
  void solve_pushing();  // λ there, 0 elsewhere; w elsewhere
  bool exchange();       // true: nothing left to exchange
  bool pivot();          // until nothing is left to exchange
  bool settled() const;  // the last proximal step changed nothing

  Eigen::Index n_ = 0;
  std::vector<double> scale_;   // 1/√N_ii
  std::vector<double> N_, u_;   // scaled: unit diagonal
  std::vector<double> target_;  // right-hand side of the proximal step
  std::vector<double> lambda_, previous_, w_;
  std::vector<char> pushes_;
  std::vector<int> pushing_;    // indices, ascending
  std::vector<double> factor_;  // Cholesky, lower
  std::vector<double> column_;
  bool factored_ = false;
  double shift_ = 0;  // ε
  Eigen::Index fewest_ = 0;
  int patience_ = 0;
};

}  // namespace poinsot
