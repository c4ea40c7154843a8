// The arithmetic that nearly all the time of a Taylor step goes into, on raw blocks of whole vector
// registers. Compiled for more than one width and chosen once by what the processor has; every
// width gives the same bits, because lanes never mix and nothing is fused.

#pragma once

#include <array>

namespace poinsot {

// Coefficients of one order of one body.
struct SeriesBlock {
  // R by columns, and m as a fourth row: all of them are n′ = n × ω + …
  std::array<double, 12> rows;
  std::array<double, 4> v;      // in W, 0
  std::array<double, 4> omega;  // in B, 0
  std::array<double, 4> c_W;    // c and the work
  std::array<double, 4> H;      // angular impulse in W, 0
};

// Pushes and drag of one order: force in W, 0, torque in B, 0.
struct EffortBlock {
  std::array<double, 4> force, torque;
};

// What acts on the body, as SystemBody says it.
struct SeriesBody {
  std::array<double, 12> inv_J;  // columns, padded
  double inv_mass;
  std::array<double, 4> steady;  // [N] in W: all constant forces, weight included
  std::array<double, 4> push;    // [N] in W: those that do work
  std::array<double, 4> couple_W, force_B, torque_B;
  std::array<double, 12> moment;  // columns of Σ p Fᵀ, padded
  bool couple_in_W, force_in_B, torque_in_B, at_points;
  bool works;  // effort is not zero for all orders
};

// |R|², |v|², |m|² of one order.
struct SeriesSquares {
  double R, v, m;
};

struct SeriesKernels {
  // From rows of order k: ω of order k, effort of order k, H of order k+1.
  void (*push)(const SeriesBody& body, SeriesBlock* series, EffortBlock* effort, int k);
  // From all that to c, v, rows and W of order k+1, and their squares.
  SeriesSquares (*integrate)(const SeriesBody& body, SeriesBlock* series, const EffortBlock* effort,
                             int k);
  // Both, for bodies without drag.
  SeriesSquares (*step)(const SeriesBody& body, SeriesBlock* series, EffortBlock* effort, int k);
  SeriesSquares (*squares)(const SeriesBlock& block);
  // The series at h, by Horner's rule.
  void (*evaluate)(const SeriesBlock* series, int order, double h, SeriesBlock& sum);
};

SeriesKernels series_kernels();

}  // namespace poinsot
