// The sub-step's bodies and points where they are in its middle, as far as velocities at its start
// tell: forces that are constant over it have the arms and directions of then, and velocities keep
// what contacts ask for at its end. Both together make the motion second order.

#include <cmath>

#include "poinsot/collision/contact_step.h"
#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

// Turned by the angle (in W), to its third order.
Mat3 turn_by(const Vec3& angle) {
  return Quat(1, 0.5 * angle.x(), 0.5 * angle.y(), 0.5 * angle.z()).normalized().toRotationMatrix();
}

Vec3 velocity_at(const ContactBody& body, const Vec3& point) {
  return body.v + body.omega.cross(point - body.c);
}

}  // namespace

void ContactStep::place_bodies(const CollisionState& state, double h) {
  const World& world = state.world();
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const ContactBody& before = before_[k];
    ContactBody& body = bodies_[k];
    body = before;
    body.c += 0.5 * h * before.v;
    if (!(body.inv_mass > 0)) continue;
    body.v += h * acceleration_[k].linear;
    if (before.omega.isZero(0)) {
      body.omega += h * acceleration_[k].angular;
      continue;
    }
    const Mat3 half = turn_by(0.5 * h * before.omega);
    body.inv_J_W = half * before.inv_J_W * half.transpose();
    const Vec3 L = angular_momentum(world.y, columns_[k]);
    const Vec3 L_back = half.transpose() * (half.transpose() * L);
    body.omega = half * (half * (before.inv_J_W * L_back)) + h * acceleration_[k].angular;
  }
}

void ContactStep::place_middle(const CollisionState& state, double h) {
  place_bodies(state, h);
  const double half = 0.5 * h;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Point& start = points_[i];
    const PointMotion& motion = start.motion;
    Contact& contact = contacts_[i];
    const ContactBody& a = before_[static_cast<std::size_t>(contact.a)];
    const ContactBody& b = before_[static_cast<std::size_t>(contact.b)];
    const Vec3 arm_a = start.position - a.c, arm_b = start.position - b.c;
    contact.normal = start.normal;
    contact.carried.setZero();
    Vec3 along;  // [m/s] the point
    if (motion.is_round_a && motion.is_round_b) {
      const double to_a = arm_a.norm(), to_b = arm_b.norm();
      const Vec3 apart = a.v - b.v;
      along = (to_b * a.v + to_a * b.v) / (to_a + to_b);
      contact.normal += (half / (to_a + to_b)) * (apart - start.normal.dot(apart) * start.normal);
      contact.normal.normalize();
    } else if (motion.is_round_a || motion.is_round_b) {
      along = motion.is_round_a ? a.v : b.v;
    } else {
      const Vec3 at_a = velocity_at(a, start.position), at_b = velocity_at(b, start.position);
      along = a.inv_mass > 0 && b.inv_mass > 0 ? Vec3(0.5 * (at_a + at_b))
                                               : (a.inv_mass > 0 ? at_a : at_b);
      const Vec3 turn = motion.turns_a * a.omega + motion.turns_b * b.omega;
      contact.normal += half * turn.cross(start.normal);
      contact.normal.normalize();
      contact.carried =
          half * (a.omega.cross(a.omega.cross(arm_a)) - b.omega.cross(b.omega.cross(arm_b)));
    }
    contact.point = start.position + half * along;
  }
}

Vec3 ContactStep::slip_at_start(std::size_t i) const {
  const ContactBody& a = before_[static_cast<std::size_t>(contacts_[i].a)];
  const ContactBody& b = before_[static_cast<std::size_t>(contacts_[i].b)];
  const Vec3 v = velocity_at(a, points_[i].position) - velocity_at(b, points_[i].position);
  return v - points_[i].normal.dot(v) * points_[i].normal;
}

}  // namespace poinsot
