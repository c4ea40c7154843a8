// Integrators of fixed step.
//
//   name                  order  evaluations of f per step
//   rk4                   4      4
//   semi_implicit_euler   1      1   P and m first, then c and q with the new ones
//   explicit_euler        1      1
//
// Every step leaves unit quaternions. Sources: Kutta 1901; Hairer, Lubich, Wanner, Geometric
// Numerical Integration, I.1.2; lesson slides.

#pragma once

#include "poinsot/scene/strategies.h"
#include "poinsot/simulation/body_system.h"
#include "poinsot/simulation/local_error.h"

namespace poinsot {

class FixedStep {
 public:
  // For systems of up to n bodies.
  void prepare(Eigen::Index n);

  // One step of a fixed-step kind.
  void step(IntegratorKind kind, const System& system, SystemState& y, double h);

  // The difference between one step of h and two of h/2: an estimate of the error of either.
  LocalError compare(IntegratorKind kind, const System& system, const SystemState& y, double h);

 private:
  void rk4(const System& system, SystemState& y, double h);
  void semi_implicit_euler(const System& system, SystemState& y, double h);
  void explicit_euler(const System& system, SystemState& y, double h);

  SystemState k1_, k2_, k3_, k4_, stage_, once_, twice_;
};

// Equal steps that cover `duration`, none longer than `longest` (but for rounding); at least one.
int step_count(double duration, double longest);

}  // namespace poinsot
