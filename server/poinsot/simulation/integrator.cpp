#include "poinsot/simulation/integrator.h"

#include <cmath>

namespace poinsot {

Integrator make_integrator(IntegratorKind kind, Eigen::Index n) {
  Integrator integrator;
  if (kind == IntegratorKind::semi_implicit_euler) integrator = SemiImplicitEuler{};
  std::visit([n](auto& method) { method.prepare(n); }, integrator);
  return integrator;
}

int step_count(double duration, double longest) {
  // A ratio that is whole but for rounding must not cost one more step.
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::fmax(1.0, std::ceil(duration / longest * (1 - kRounding))));
}

void integrate(Integrator& integrator, const Dynamics& dynamics, StateArray& y, double duration,
               double longest_step) {
  const int steps = step_count(duration, longest_step);
  const double h = duration / steps;
  std::visit(
      [&](auto& method) {
        for (int s = 0; s < steps; ++s) method.step(dynamics, y, h);
      },
      integrator);
}

void normalize_orientations(const World& world, StateArray& y) {
  for (Eigen::Index i = 0; i < y.cols(); ++i)
    if (world.moves(i)) orientation(y, i).normalize();
}

}  // namespace poinsot
