#include "poinsot/simulation/fixed_step.h"

#include <cmath>

namespace poinsot {

int step_count(double duration, double longest) {
  // A ratio that is whole but for rounding must not cost one more step.
  constexpr double kRounding = 1e-9;
  return static_cast<int>(std::fmax(1.0, std::ceil(duration / longest * (1 - kRounding))));
}

void FixedStep::prepare(Eigen::Index n) {
  for (SystemState* s : {&k1_, &k2_, &k3_, &k4_, &stage_, &once_, &twice_}) s->resize(17, n);
}

void FixedStep::step(IntegratorKind kind, const System& system, SystemState& y, double h) {
  switch (kind) {
    case IntegratorKind::semi_implicit_euler:
      semi_implicit_euler(system, y, h);
      break;
    case IntegratorKind::explicit_euler:
      explicit_euler(system, y, h);
      break;
    default:
      rk4(system, y, h);
  }
  normalize_orientations(y);
}

void FixedStep::rk4(const System& system, SystemState& y, double h) {
  system.derivative(y, k1_);
  stage_ = y + (0.5 * h) * k1_;
  system.derivative(stage_, k2_);
  stage_ = y + (0.5 * h) * k2_;
  system.derivative(stage_, k3_);
  stage_ = y + h * k3_;
  system.derivative(stage_, k4_);
  y += (h / 6) * (k1_ + 2 * k2_ + 2 * k3_ + k4_);
}

void FixedStep::explicit_euler(const System& system, SystemState& y, double h) {
  system.derivative(y, k1_);
  y += h * k1_;
}

// P and L first, then c and q with the new ones. L is kept in W over the step, so that a free body
// keeps it.
void FixedStep::semi_implicit_euler(const System& system, SystemState& y, double h) {
  system.derivative(y, k1_);
  for (Eigen::Index i = 0; i < y.cols(); ++i) {
    const SystemBody& body = system.bodies[static_cast<std::size_t>(i)];
    Eigen::Map<Quat> q(y.col(i).data() + 3);
    const Vec3 force = k1_.block<3, 1>(7, i), torque = k1_.block<3, 1>(14, i);
    const Vec3 L = q * Vec3(y.block<3, 1>(10, i)) + h * torque;
    y.block<3, 1>(7, i) += h * force;
    const Vec3 v = body.inv_mass * y.block<3, 1>(7, i);
    const Vec3 omega_B = body.inv_J_B * (q.conjugate() * L);
    // Work along the path that is taken; with springs by the power at its start.
    y(13, i) += system.springs.empty()
                    ? h * ((force - body.weight).dot(v) + (q.conjugate() * torque).dot(omega_B))
                    : h * k1_(13, i);
    y.block<3, 1>(14, i) += h * torque;
    y.block<3, 1>(0, i) += h * v;
    q.coeffs() += (0.5 * h) * (q * Quat(0, omega_B.x(), omega_B.y(), omega_B.z())).coeffs();
    q.normalize();
    y.block<3, 1>(10, i) = q.conjugate() * L;
  }
}

LocalError FixedStep::compare(IntegratorKind kind, const System& system, const SystemState& y,
                              double h) {
  once_ = y;
  twice_ = y;
  step(kind, system, once_, h);
  step(kind, system, twice_, 0.5 * h);
  step(kind, system, twice_, 0.5 * h);
  LocalError error;
  for (Eigen::Index i = 0; i < y.cols(); ++i)
    error.raise_to({(once_.block<3, 1>(0, i) - twice_.block<3, 1>(0, i)).norm(),
                    2 * (once_.block<4, 1>(3, i) - twice_.block<4, 1>(3, i)).norm()});
  return error;
}

}  // namespace poinsot
