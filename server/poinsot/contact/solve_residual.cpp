#include "poinsot/contact/solve_residual.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace poinsot {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Vec3 velocity(const ContactBody& body, const Vec3& point) {
  return body.v + body.omega.cross(point - body.c);
}

// [1/kg] What a unit impulse along d changes of the relative velocity along d.
double inverse_mass(const ContactBody& a, const ContactBody& b, const Vec3& point, const Vec3& d) {
  double sum = 0;
  for (const ContactBody* body : {&a, &b}) {
    const Vec3 lever = (point - body->c).cross(d);
    sum += body->inv_mass + lever.dot(body->inv_J_W * lever);
  }
  return sum;
}

struct Push {
  Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();
  double reach = 0;  // [m] of the body's contacts from its centre
};

void push(std::vector<Push>& pushes, std::span<const ContactBody> bodies, int body,
          const Vec3& point, const Vec3& impulse) {
  const Vec3 arm = point - bodies[at(body)].c;
  Push& p = pushes[at(body)];
  p.impulse += impulse;
  p.moment += arm.cross(impulse);
  p.reach = std::max(p.reach, arm.norm());
}

void measure_contact(const ContactBody& a, const ContactBody& b, const Contact& contact,
                     double target, SolveResidual& result) {
  const Vec3& n = contact.normal;
  const Vec3 relative = velocity(a, contact.point) - velocity(b, contact.point);
  const double vn = relative.dot(n);
  const Vec3 vt = relative - vn * n;
  const double w = inverse_mass(a, b, contact.point, n);
  const double normal = std::abs(std::min(contact.normal_impulse * w, vn - target));
  result.normal = std::max(result.normal, normal);

  Vec3 t = n.cross(Vec3::Unit(std::abs(n.x()) < 0.5 ? 0 : 1)).normalized();
  const double wt =
      0.5 * (inverse_mass(a, b, contact.point, t) + inverse_mass(a, b, contact.point, n.cross(t)));
  const Vec3 wanted = wt * contact.friction_impulse - vt;
  const double limit = wt * contact.friction * std::max(0.0, contact.normal_impulse);
  const double length = wanted.norm();
  const Vec3 nearest = length > limit ? Vec3(wanted * (limit / length)) : wanted;
  const double friction = (wt * contact.friction_impulse - nearest).norm();
  result.friction = std::max(result.friction, friction);
}

}  // namespace

double SolveResidual::worst() const {
  return std::max({normal, friction, joint, balance});
}

SolveResidual measure_residual(std::span<const ContactBody> before,
                               std::span<const ContactBody> after,
                               std::span<const Contact> contacts, std::span<const double> target,
                               std::span<const PointJoint> joints) {
  SolveResidual result;
  std::vector<Push> pushes(before.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const ContactBody &a = after[at(contact.a)], &b = after[at(contact.b)];
    const Vec3 impulse = contact.normal_impulse * contact.normal + contact.friction_impulse;
    const double sum = velocity(a, contact.point).sum() + velocity(b, contact.point).sum() +
                       impulse.sum() + contact.friction + target[i];
    if (!std::isfinite(sum)) continue;
    push(pushes, before, contact.a, contact.point, impulse);
    push(pushes, before, contact.b, contact.point, -impulse);
    measure_contact(a, b, contact, target[i], result);
  }
  for (const PointJoint& joint : joints) {
    const Vec3 relative =
        velocity(after[at(joint.a)], joint.point) - velocity(after[at(joint.b)], joint.point);
    const double error = (relative - joint.target).norm();
    if (!std::isfinite(error + joint.impulse.sum())) continue;
    push(pushes, before, joint.a, joint.point, joint.impulse);
    push(pushes, before, joint.b, joint.point, -joint.impulse);
    result.joint = std::max(result.joint, error);
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    const ContactBody& body = before[i];
    const Vec3 v = after[i].v - body.v, omega = after[i].omega - body.omega;
    if (!std::isfinite(v.sum() + omega.sum())) continue;
    const double error =
        body.inv_mass > 0 ? (v - body.inv_mass * pushes[i].impulse).norm() +
                                pushes[i].reach * (omega - body.inv_J_W * pushes[i].moment).norm()
                          : v.norm() + pushes[i].reach * omega.norm();
    result.balance = std::max(result.balance, error);
  }
  return result;
}

}  // namespace poinsot
