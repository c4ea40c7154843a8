// One advance of bodies that have to be integrated, by the method that the scene names.
//
//   exact, taylor   Taylor series; DOP853 where the series does not exist, implicitly (RODAS) where
//                   the springs are stiff
//   dop853, dopri5  by tolerance, implicitly where stiff
//   others          fixed steps

#pragma once

#include "poinsot/simulation/embedded_pair.h"
#include "poinsot/simulation/fixed_step.h"
#include "poinsot/simulation/rosenbrock.h"
#include "poinsot/simulation/taylor.h"

namespace poinsot {

// Scratch of one system at work.
struct Workspace {
  explicit Workspace(std::size_t bodies);

  SystemState state, before;  // 17×n
  std::vector<SystemBody> bodies;
  std::vector<BodyRates> rates;
  EmbeddedRungeKutta embedded;
  FixedStep fixed;
  Rosenbrock rosenbrock;  // prepared when it is first needed
};

class Integration {
 public:
  explicit Integration(const Scene& scene);

  IntegratorKind kind() const { return kind_; }
  double longest_step() const { return longest_step_; }  // [s] of the fixed methods

  // Moves work.state by `duration`; returns what moved it, and its local error. A state that
  // nothing can follow becomes NaN.
  Method advance(const System& system, Workspace& work, TaylorSeries& taylor, StepMemory& memory,
                 double duration, LocalError& error) const;

 private:
  Method by_tolerance(const EmbeddedPair& pair, Method method, double tolerance,
                      const System& system, Workspace& work, StepMemory& memory, double duration,
                      LocalError& error) const;
  Method by_fixed_steps(const System& system, Workspace& work, StepMemory& memory, double duration,
                        LocalError& error) const;

  IntegratorKind kind_;
  double longest_step_;  // [s]
  double tolerance_;     // of the series, or of the pair
};

}  // namespace poinsot
