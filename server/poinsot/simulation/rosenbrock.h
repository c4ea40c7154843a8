// RODAS: a linearly implicit Runge–Kutta method of order 4 with an embedded third, L-stable. For
// systems whose springs and dampers are so stiff that an explicit step would be bounded by
// stability rather than by accuracy. The Jacobian is taken by differences.
// Source: Hairer, Wanner, Solving ODEs II, IV.7 and the code RODAS.

#pragma once

#include <vector>

#include <Eigen/LU>

#include "poinsot/simulation/embedded_pair.h"

namespace poinsot {

class Rosenbrock {
 public:
  // For systems of n bodies; again costs nothing.
  void prepare(Eigen::Index n);

  // As EmbeddedRungeKutta::advance, from `done` on; false after `most_steps`.
  bool advance(const System& system, SystemState& y, double duration, double tolerance,
               int most_steps, StepMemory& memory, LocalError& error, double& done);

  // One step of h: the end and the estimate of its error.
  void step(const System& system, const SystemState& y, double h);
  const SystemState& end() const { return end_; }

 private:
  void differentiate(const System& system, const SystemState& y, double h);
  void solve(SystemState& stage);

  Eigen::MatrixXd jacobian_, matrix_;
  Eigen::VectorXd solution_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  std::vector<SystemState> g_;
  SystemState rate_, probe_, end_, error_;
};

}  // namespace poinsot
