#include "poinsot/simulation/work_meter.h"

namespace poinsot {
namespace {

bool is_zero(const Wrench& w) {
  return w.force.isZero(0) && w.torque.isZero(0);
}

}  // namespace

void WorkMeter::start_step(const Dynamics& dynamics) {
  open_.clear();
  const World& world = dynamics.world;
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!world.moves(i)) continue;
    if (world.held[k].is_zero() && is_zero(dynamics.contact[k])) continue;
    open_.push_back(measure(dynamics, i));
  }
}

void WorkMeter::end_step(const Dynamics& dynamics, double h) {
  const auto integral = [h](const Power& a, const Power& b) {
    return 0.5 * h * (a.value + b.value) + h * h / 12 * (a.rate - b.rate);
  };
  for (const Open& start : open_) {
    if (!dynamics.world.moves(start.i)) continue;  // frozen in this step
    const auto k = static_cast<std::size_t>(start.i);
    const HeldWrench& held = dynamics.world.held[k];
    const Open end = measure(dynamics, start.i);
    const Vec3 moved = end.c - start.c;
    held_ += held.in_W.force.dot(moved) + ((end.R - start.R) * held.moment).trace() +
             integral(start.held, end.held);
    contact_ += dynamics.contact[k].force.dot(moved) + integral(start.contact, end.contact);
  }
}

WorkMeter::Open WorkMeter::measure(const Dynamics& dynamics, Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  const HeldWrench& held = dynamics.world.held[k];
  return {i, position(dynamics.world.y, i), rotation(dynamics.world, i),
          power(dynamics, i, held.in_B, held.in_W.torque),
          power(dynamics, i, Wrench{}, dynamics.contact[k].torque)};
}

// Power of a wrench constant in B and a couple constant in W, and its rate of change.
WorkMeter::Power WorkMeter::power(const Dynamics& dynamics, Eigen::Index i, const Wrench& in_B,
                                  const Vec3& couple_W) {
  if (is_zero(in_B) && couple_W.isZero(0)) return {};
  const World& world = dynamics.world;
  const auto k = static_cast<std::size_t>(i);
  const Mat3 R = rotation(world, i);
  const Wrench acting = acting_wrench(dynamics, i, R);
  const Vec3 m_B = R.transpose() * angular_momentum(world.y, i);
  const Vec3 omega_B = world.inv_J_B[k] * m_B;
  const Vec3 alpha_B = world.inv_J_B[k] * (R.transpose() * acting.torque - omega_B.cross(m_B));
  const Vec3 v_B = world.inv_mass[k] * (R.transpose() * momentum(world.y, i));
  const Vec3 a_B = world.inv_mass[k] * (R.transpose() * acting.force) - omega_B.cross(v_B);
  const Vec3 torque_B = in_B.torque + R.transpose() * couple_W;
  const Vec3 torque_rate_B = -omega_B.cross(R.transpose() * couple_W);
  return {in_B.force.dot(v_B) + torque_B.dot(omega_B),
          in_B.force.dot(a_B) + torque_B.dot(alpha_B) + torque_rate_B.dot(omega_B)};
}

}  // namespace poinsot
