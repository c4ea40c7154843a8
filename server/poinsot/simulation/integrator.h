// Integrators of fixed step: a closed set, each a small struct with its scratch, one file each.
//
//   name                  order  cost per step
//   rk4                   4      four evaluations of y′
//   semi_implicit_euler   1      one; P and L first, then c and q with the new ones
//
// Every step leaves unit quaternions. Sizes are set by prepare(); steps do not allocate.

#pragma once

#include <variant>

#include "poinsot/simulation/dynamics.h"

namespace poinsot {

// Source: Kutta 1901; Hairer, Nørsett, Wanner, Solving ODEs I, table 1.2.
struct RungeKutta4 {
  StateArray k1, k2, k3, k4, stage;  // 13×n

  void prepare(Eigen::Index n);
  void step(const Dynamics& dynamics, StateArray& y, double h);
};

// Symplectic in translation, explicit in rotation. Source: lesson slides; Hairer, Lubich, Wanner,
// Geometric Numerical Integration, I.1.2.
struct SemiImplicitEuler {
  void prepare(Eigen::Index) {}
  void step(const Dynamics& dynamics, StateArray& y, double h);
};

using Integrator = std::variant<RungeKutta4, SemiImplicitEuler>;

Integrator make_integrator(IntegratorKind kind, Eigen::Index n);

// Equal steps that cover `duration`, none longer than `longest` (but for rounding); at least one.
int step_count(double duration, double longest);

// Integrates y over `duration` in equal steps no longer than `longest_step`.
void integrate(Integrator& integrator, const Dynamics& dynamics, StateArray& y, double duration,
               double longest_step);

// Brings the orientations of the bodies that move back to unit length.
void normalize_orientations(const World& world, StateArray& y);

}  // namespace poinsot
