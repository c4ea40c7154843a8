#include "poinsot/simulation/integrator.h"

namespace poinsot {

void RungeKutta4::prepare(Eigen::Index n) {
  for (StateArray* a : {&k1, &k2, &k3, &k4, &stage}) a->resize(13, n);
}

void RungeKutta4::step(const Dynamics& dynamics, StateArray& y, double h) {
  dynamics.derivative(y, k1);
  stage = y + (0.5 * h) * k1;
  dynamics.derivative(stage, k2);
  stage = y + (0.5 * h) * k2;
  dynamics.derivative(stage, k3);
  stage = y + h * k3;
  dynamics.derivative(stage, k4);
  y += (h / 6) * (k1 + 2 * k2 + 2 * k3 + k4);
  normalize_orientations(dynamics.world, y);
}

}  // namespace poinsot
