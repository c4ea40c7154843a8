#include "poinsot/simulation/dynamics.h"

#include "poinsot/math/rotation.h"

namespace poinsot {

Wrench acting_wrench(const Dynamics& dynamics, Eigen::Index i, const Mat3& R) {
  const auto k = static_cast<std::size_t>(i);
  const World& world = dynamics.world;
  Wrench w = dynamics.contact[k];
  w.force += world.mass[k] * world.gravity;
  if (!world.held[k].is_zero()) w += world.held[k].at(R);
  return w;
}

void Dynamics::derivative(const StateArray& y, StateArray& dy) const {
  for (Eigen::Index i = 0; i < y.cols(); ++i) {
    if (!world.moves(i)) {
      dy.col(i).setZero();
      continue;
    }
    const auto k = static_cast<std::size_t>(i);
    const Quat q = orientation(y, i);
    const Mat3 R = q.normalized().toRotationMatrix();
    const Vec3 omega = R * (world.inv_J_B[k] * (R.transpose() * angular_momentum(y, i)));
    const Wrench w = acting_wrench(*this, i, R);
    position(dy, i) = world.inv_mass[k] * momentum(y, i);
    orientation(dy, i).coeffs() = quaternion_rate(q, omega);
    momentum(dy, i) = w.force;
    angular_momentum(dy, i) = w.torque;
  }
}

}  // namespace poinsot
