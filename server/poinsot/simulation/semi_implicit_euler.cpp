#include "poinsot/math/rotation.h"
#include "poinsot/simulation/integrator.h"

namespace poinsot {

void SemiImplicitEuler::step(const Dynamics& dynamics, StateArray& y, double h) {
  const World& world = dynamics.world;
  for (Eigen::Index i = 0; i < y.cols(); ++i) {
    if (!world.moves(i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const Mat3 R = orientation(y, i).toRotationMatrix();
    const Wrench w = acting_wrench(dynamics, i, R);
    momentum(y, i) += h * w.force;
    angular_momentum(y, i) += h * w.torque;
    const Vec3 omega = R * (world.inv_J_B[k] * (R.transpose() * angular_momentum(y, i)));
    position(y, i) += (h * world.inv_mass[k]) * momentum(y, i);
    const Quat q = orientation(y, i);
    orientation(y, i).coeffs() += h * quaternion_rate(q, omega);
    orientation(y, i).normalize();
  }
}

}  // namespace poinsot
