#include "poinsot/contact/soft_bodies.h"

#include <algorithm>

#include <Eigen/LU>

#include "poinsot/contact/soft_rotation.h"

namespace poinsot {
namespace {

// [rad] Turns smaller than this bend the axis by less than rounding of a velocity that matters.
constexpr double kStill = 1e-7;

Lanes lanes_of(const Vec3& a) {
  return Lanes{a.x(), a.y(), a.z(), 0};
}
Vec3 vector_of(const Lanes& a) {
  return Vec3(a[0], a[1], a[2]);
}

bool is_zero(const Lanes& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

std::array<double, 6> symmetric(const Mat3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

Vec3 times(const std::array<double, 6>& m, const Vec3& a) {
  return Vec3(m[0] * a.x() + m[1] * a.y() + m[2] * a.z(),
              m[1] * a.x() + m[3] * a.y() + m[4] * a.z(),
              m[2] * a.x() + m[4] * a.y() + m[5] * a.z());
}

Quat quat_of(const Lanes& turn) {
  return Quat(turn[3], turn[0], turn[1], turn[2]);
}

}  // namespace

void SoftBodies::start(std::span<const SoftBody> bodies, double h) {
  h_ = h;
  count_ = bodies.size();
  hot_.resize(count_ + 1);
  masses_.resize(count_ + 1);
  course_.resize(count_ + 1);
  energy_.resize(count_);
  torque_work_.resize(count_);
  hot_[count_] = HotBody{};
  masses_[count_] = SoftMass{};
  course_[count_] = Course{};
  int turning = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const SoftBody& body = bodies[k];
    Kind kind = Kind::kTurning;
    if (!(body.inv_mass > 0))
      kind = body.v.isZero(0) && body.omega.isZero(0) ? Kind::kFixed : Kind::kEven;
    else if (body.turns_evenly || !(body.inv_J_B.determinant() > 0))  // or an axis is held
      kind = Kind::kRound;
    course_[k].kind = kind;
    course_[k].turning = kind == Kind::kTurning ? turning++ : -1;
  }
  turning_.resize(static_cast<std::size_t>(turning));
}

void SoftBodies::set(std::size_t piece, std::span<const SoftBody> bodies) {
  const std::size_t end = std::min((piece + 1) * kPieceBodies, count_);
  for (std::size_t k = piece * kPieceBodies; k < end; ++k) set(k, bodies[k]);
}

void SoftBodies::set(std::size_t k, const SoftBody& body) {
  Course& course = course_[k];
  HotBody& hot = hot_[k];
  SoftMass& mass = masses_[k];
  hot = {lanes_of(body.v), lanes_of(body.omega), Lanes{}, Lanes{0, 0, 0, 1}};
  mass = SoftMass{};
  energy_[k] = torque_work_[k] = 0;
  course.has_turned = false;
  course.predicted_v = hot.v;
  course.predicted_omega = hot.omega;
  course.kick_v = course.kick_omega = Lanes{};
  if (course.kind < Kind::kRound) return;
  mass.inv_mass = body.inv_mass;
  if (body.turns_evenly) {
    mass.inv_J_W = symmetric(body.inv_J_B);
  } else {
    const Mat3 R = body.q.toRotationMatrix();
    mass.inv_J_W = symmetric(R * body.inv_J_B * R.transpose());
    if (course.kind == Kind::kTurning) {
      const Mat3 J_B = body.inv_J_B.inverse();
      turning_[static_cast<std::size_t>(course.turning)] = {body.q,
                                                            body.L,
                                                            body.torque,
                                                            times(mass.inv_J_W, body.L),
                                                            body.inv_J_B,
                                                            J_B,
                                                            R * J_B * R.transpose(),
                                                            0};
    }
  }
  const Vec3 omega = times(mass.inv_J_W, body.L);
  hot.omega = lanes_of(omega);
  course.kick_v = lanes_of(h_ * body.acceleration);
  course.kick_omega = lanes_of(h_ * times(mass.inv_J_W, body.torque));
  course.predicted_v = hot.v;
  course.predicted_omega = hot.omega;
  energy_[k] = 0.5 * (body.v.squaredNorm() / body.inv_mass + omega.dot(body.L));
}

void SoftBodies::sync(Turning& turning, const HotBody& hot) const {
  const Vec3 omega = vector_of(hot.omega);
  turning.L += turning.J_W * (omega - turning.synced_omega);
  turning.synced_omega = omega;
}

void SoftBodies::take_forces(std::size_t piece) {
  const std::size_t end = std::min((piece + 1) * kPieceBodies, count_);
  for (std::size_t k = piece * kPieceBodies; k < end; ++k) {
    Course& course = course_[k];
    if (course.kind < Kind::kRound) continue;
    HotBody& hot = hot_[k];
    const Lanes by_contacts_v = hot.v - course.predicted_v;
    const Lanes by_contacts_omega = hot.omega - course.predicted_omega;
    course.predicted_v = hot.v + course.kick_v;
    course.predicted_omega = hot.omega + course.kick_omega;
    hot.v = course.predicted_v + by_contacts_v;
    hot.omega = course.predicted_omega + by_contacts_omega;
  }
}

void SoftBodies::move(std::size_t piece) {
  const std::size_t end = std::min((piece + 1) * kPieceBodies, count_);
  for (std::size_t k = piece * kPieceBodies; k < end; ++k) {
    Course& course = course_[k];
    if (course.kind == Kind::kFixed) continue;
    HotBody& hot = hot_[k];
    const bool free =
        is_zero(hot.v - course.predicted_v) && is_zero(hot.omega - course.predicted_omega);
    hot.shift += h_ * hot.v;
    if (free) hot.shift -= (0.5 * h_) * course.kick_v;
    if (!is_zero(course.kick_omega)) add_torque_work(k, free);
    if (course.kind == Kind::kTurning) {
      turn(k);
    } else if (!is_zero(hot.omega)) {
      const Quat turned = turn_by(h_ * vector_of(hot.omega)) * quat_of(hot.turn);
      hot.turn = Lanes{turned.x(), turned.y(), turned.z(), turned.w()};
    }
  }
}

void SoftBodies::add_torque_work(std::size_t k, bool free) {
  const Course& course = course_[k];
  const Vec3 mean = vector_of(free ? hot_[k].omega - 0.5 * course.kick_omega : hot_[k].omega);
  const double inv_J = masses_[k].inv_J_W[0];
  if (course.kind == Kind::kTurning)
    torque_work_[k] += h_ * turning_[static_cast<std::size_t>(course.turning)].torque.dot(mean);
  else if (inv_J > 0)
    torque_work_[k] += vector_of(course.kick_omega).dot(mean) / inv_J;
}

void SoftBodies::turn(std::size_t k) {
  Course& course = course_[k];
  HotBody& hot = hot_[k];
  Turning& turning = turning_[static_cast<std::size_t>(course.turning)];
  const Vec3 omega = vector_of(hot.omega);
  const double angle = h_ * omega.norm();
  turning.turned_angle += angle;
  course.has_turned = turning.turned_angle > kStill;
  if (!course.has_turned) {
    const Quat turned = turn_by(h_ * omega) * quat_of(hot.turn);
    hot.turn = Lanes{turned.x(), turned.y(), turned.z(), turned.w()};
    return;
  }
  turning.turned_angle = 0;
  sync(turning, hot);
  const Vec3 by_contacts = turning.J_W * (omega - vector_of(course.predicted_omega));
  const Quat q = free_flow(quat_of(hot.turn) * turning.q_0, turning.L, turning.inv_J_B, h_);
  const Quat turned = q * turning.q_0.conjugate();
  hot.turn = Lanes{turned.x(), turned.y(), turned.z(), turned.w()};
  const Mat3 R = q.toRotationMatrix();
  turning.J_W = R * turning.J_B * R.transpose();
  masses_[k].inv_J_W = symmetric(R * turning.inv_J_B * R.transpose());
  turning.synced_omega = times(masses_[k].inv_J_W, turning.L);
  hot.omega = lanes_of(turning.synced_omega);
  course.predicted_omega = lanes_of(turning.synced_omega - times(masses_[k].inv_J_W, by_contacts));
  course.kick_omega = lanes_of(h_ * times(masses_[k].inv_J_W, turning.torque));
}

void SoftBodies::finish(std::span<SoftBody> bodies) {
  work_ = kinetic_change_ = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    SoftBody& body = bodies[k];
    const Course& course = course_[k];
    if (course.kind == Kind::kFixed) continue;
    const HotBody& hot = hot_[k];
    body.c += vector_of(hot.shift);
    body.q = quat_of(hot.turn) * body.q;
    body.q.normalize();
    if (course.kind == Kind::kEven) continue;
    const Vec3 omega = vector_of(hot.omega);
    if (course.kind == Kind::kTurning) {
      Turning& turning = turning_[static_cast<std::size_t>(course.turning)];
      sync(turning, hot);
      body.L = turning.L;
    } else if (body.turns_evenly) {
      const Vec3 before = times(masses_[k].inv_J_W, body.L);
      if (masses_[k].inv_J_W[0] > 0) body.L += (omega - before) / masses_[k].inv_J_W[0];
    }
    body.v = vector_of(hot.v);
    body.omega = omega;
    kinetic_change_ +=
        0.5 * (body.v.squaredNorm() / body.inv_mass + omega.dot(body.L)) - energy_[k];
    work_ += torque_work_[k] + body.acceleration.dot(vector_of(hot.shift)) / body.inv_mass;
  }
}

}  // namespace poinsot
