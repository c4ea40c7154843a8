#include "poinsot/simulation/body_system.h"

namespace poinsot {

SystemBody system_body(const World& world, Eigen::Index i, const Wrench& contact) {
  const auto k = static_cast<std::size_t>(i);
  SystemBody body{world.mass[k],
                  world.inv_mass[k],
                  world.J_B[k],
                  world.inv_J_B[k],
                  world.mass[k] * world.gravity,
                  world.held[k],
                  world.drag.empty() ? DragDef{} : world.drag[k],
                  false,
                  false,
                  false,
                  false,
                  false};
  const HeldWrench& push = body.push;
  body.push.in_W += contact;
  body.couple_in_W = !push.in_W.torque.isZero(0);
  body.force_in_B = !push.in_B.force.isZero(0);
  body.torque_in_B = !push.in_B.torque.isZero(0);
  body.at_points = !push.moment.isZero(0);
  body.dragged = body.drag.linear > 0 || body.drag.quadratic > 0 || body.drag.angular > 0;
  return body;
}

namespace {

// Forces in W at c and torques in B add to P′ and m′; their power to W′, in W to H′.
void apply(SystemState& dy, Eigen::Index i, const BodyRates& body, const Vec3& force,
           const Vec3& torque_B) {
  dy.block<3, 1>(7, i) += force;
  dy.block<3, 1>(10, i) += torque_B;
  dy.block<3, 1>(14, i) += body.R * torque_B;
}

}  // namespace

void System::derivative(const SystemState& y, SystemState& dy) const {
  for (Eigen::Index i = 0; i < size(); ++i) {
    const SystemBody& body = bodies[static_cast<std::size_t>(i)];
    BodyRates& t = scratch[static_cast<std::size_t>(i)];
    const Quat q(y(6, i), y(3, i), y(4, i), y(5, i));
    const Vec3 m = y.block<3, 1>(10, i);
    t.v = body.inv_mass * y.block<3, 1>(7, i);
    t.omega_B = body.inv_J_B * m;
    // Without a torque nothing asks for R.
    const bool turned = body.pushed_in_B() || body.drag.angular > 0;
    if (turned || !springs.empty()) t.R = q.normalized().toRotationMatrix();

    Vec3 force = body.push.in_W.force;
    Vec3 torque = Vec3::Zero();
    if (body.pushed_in_B()) {
      const Wrench w = body.push.at(t.R);
      force = w.force;
      torque = t.R.transpose() * w.torque;
    }
    if (body.dragged) {
      force += drag_force(body.drag, t.v);
      torque -= body.drag.angular * t.omega_B;
    }
    dy.block<3, 1>(0, i) = t.v;
    dy.block<4, 1>(3, i) =
        0.5 * (q * Quat(0, t.omega_B.x(), t.omega_B.y(), t.omega_B.z())).coeffs();
    dy.block<3, 1>(7, i) = body.weight + force;
    dy.block<3, 1>(10, i) = m.cross(t.omega_B) + torque;
    dy(13, i) = force.dot(t.v) + torque.dot(t.omega_B);
    if (turned)
      dy.block<3, 1>(14, i) = t.R * torque;
    else
      dy.block<3, 1>(14, i).setZero();
  }
  for (const SpringLink& spring : springs) {
    const auto point = [&](int index, const Vec3& p, Vec3& x, Vec3& v) {
      const BodyRates& t = scratch[static_cast<std::size_t>(index)];
      x = y.block<3, 1>(0, index) + t.R * p;
      v = t.v + t.R * t.omega_B.cross(p);
    };
    Vec3 x_a, v_a, x_b = spring.p_b, v_b = Vec3::Zero();
    point(spring.a, spring.p_a, x_a, v_a);
    if (spring.b != SpringLink::kWorld) point(spring.b, spring.p_b, x_b, v_b);
    const SpringForce f = spring_force(spring, x_a, x_b, v_a, v_b);
    const Vec3 total = f.elastic + f.damping;
    const auto act = [&](int index, const Vec3& p, const Vec3& force) {
      const BodyRates& t = scratch[static_cast<std::size_t>(index)];
      apply(dy, index, t, force, p.cross(t.R.transpose() * force));
    };
    act(spring.a, spring.p_a, total);
    if (spring.b != SpringLink::kWorld) act(spring.b, spring.p_b, -total);
    dy(13, spring.a) += f.damping.dot(v_a - v_b);
  }
}

void normalize_orientations(SystemState& y) {
  for (Eigen::Index i = 0; i < y.cols(); ++i) y.block<4, 1>(3, i).normalize();
}

void gather(const StateArray& y, Eigen::Index i, SystemState& s, Eigen::Index j) {
  s.block<10, 1>(0, j) = y.block<10, 1>(0, i);
  s.block<3, 1>(10, j) = orientation(y, i).conjugate() * Vec3(angular_momentum(y, i));
  s.block<4, 1>(13, j).setZero();
}

Eigen::Matrix<double, 13, 1> world_column(const SystemState& s, Eigen::Index j) {
  Eigen::Matrix<double, 13, 1> column;
  column.head<10>() = s.block<10, 1>(0, j);
  const Quat q(column[6], column[3], column[4], column[5]);
  column.tail<3>() = q * Vec3(s.block<3, 1>(10, j));
  return column;
}

void scatter(const SystemState& s, Eigen::Index j, StateArray& y, Eigen::Index i) {
  y.col(i) = world_column(s, j);
}

}  // namespace poinsot
