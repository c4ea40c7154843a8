#include "poinsot/contact/sequential_impulses.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

Vec3 perpendicular(const Vec3& n) {
  Eigen::Index least = 0;
  n.cwiseAbs().minCoeff(&least);
  return n.cross(Vec3::Unit(least)).normalized();
}

}  // namespace

SequentialImpulses::Row SequentialImpulses::make_row(const ContactBody& a, const ContactBody& b,
                                                     const Vec3& point, const Vec3& direction) {
  Row row;
  row.direction = direction;
  row.angular_a = (point - a.c).cross(direction);
  row.angular_b = (point - b.c).cross(direction);
  row.turn_a = a.inv_J_W * row.angular_a;
  row.turn_b = b.inv_J_W * row.angular_b;
  row.inv_effective_mass =
      a.inv_mass + b.inv_mass + row.angular_a.dot(row.turn_a) + row.angular_b.dot(row.turn_b);
  row.effective_mass = row.inv_effective_mass > 0 ? 1 / row.inv_effective_mass : 0;
  return row;
}

// Of a's point relative to b's, along the row [m/s].
double SequentialImpulses::speed(const Prepared& p, const Row& row,
                                 std::span<const ContactBody> bodies) {
  const ContactBody& a = bodies[static_cast<std::size_t>(p.a)];
  const ContactBody& b = bodies[static_cast<std::size_t>(p.b)];
  return row.direction.dot(a.v - b.v) + row.angular_a.dot(a.omega) - row.angular_b.dot(b.omega);
}

void SequentialImpulses::apply(const Prepared& p, const Row& row, double impulse,
                               std::span<ContactBody> bodies) {
  ContactBody& a = bodies[static_cast<std::size_t>(p.a)];
  ContactBody& b = bodies[static_cast<std::size_t>(p.b)];
  // A body that does not move is shared by many: an infinite impulse must not make it 0·∞.
  if (p.inv_mass_a > 0) {
    a.v += (p.inv_mass_a * impulse) * row.direction;
    a.omega += impulse * row.turn_a;
  }
  if (p.inv_mass_b > 0) {
    b.v -= (p.inv_mass_b * impulse) * row.direction;
    b.omega -= impulse * row.turn_b;
  }
}

void SequentialImpulses::prepare(std::span<const ContactBody> bodies,
                                 std::span<const Contact> contacts, bool with_friction) {
  prepared_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const ContactBody& a = bodies[static_cast<std::size_t>(contact.a)];
    const ContactBody& b = bodies[static_cast<std::size_t>(contact.b)];
    Prepared& p = prepared_[i];
    p.a = contact.a;
    p.b = contact.b;
    p.inv_mass_a = a.inv_mass;
    p.inv_mass_b = b.inv_mass;
    p.normal = make_row(a, b, contact.point, contact.normal);
    p.impulse = 0;
    p.friction_impulse[0] = p.friction_impulse[1] = 0;
    if (!with_friction) continue;
    const Vec3 t = perpendicular(contact.normal);
    p.tangent[0] = make_row(a, b, contact.point, t);
    p.tangent[1] = make_row(a, b, contact.point, contact.normal.cross(t));
    p.impulse = contact.normal_impulse;
    for (int k = 0; k < 2; ++k)
      p.friction_impulse[k] = contact.friction_impulse.dot(p.tangent[k].direction);
  }
}

// Both visits return the velocity change they caused [m/s].
double SequentialImpulses::visit_normal(Prepared& p, double target, std::span<ContactBody> bodies) {
  const double wanted = p.impulse + (target - speed(p, p.normal, bodies)) * p.normal.effective_mass;
  const double change = std::max(0.0, wanted) - p.impulse;
  p.impulse += change;
  apply(p, p.normal, change, bodies);
  return std::abs(change) * p.normal.inv_effective_mass;
}

double SequentialImpulses::visit_friction(Prepared& p, double friction,
                                          std::span<ContactBody> bodies) {
  const double before[2] = {p.friction_impulse[0], p.friction_impulse[1]};
  double wanted[2];
  for (int k = 0; k < 2; ++k)
    wanted[k] = before[k] - speed(p, p.tangent[k], bodies) * p.tangent[k].effective_mass;
  const double limit = friction * p.impulse;
  const double length = std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1]);
  const double scale = length > limit ? limit / length : 1.0;
  double moved = 0;
  for (int k = 0; k < 2; ++k) {
    p.friction_impulse[k] = scale * wanted[k];
    const double change = p.friction_impulse[k] - before[k];
    apply(p, p.tangent[k], change, bodies);
    moved = std::max(moved, std::abs(change) * p.tangent[k].inv_effective_mass);
  }
  return moved;
}

void SequentialImpulses::solve(std::span<ContactBody> bodies, std::span<Contact> contacts,
                               std::span<const double> target) {
  prepare(bodies, contacts, true);
  for (const Prepared& p : prepared_) {
    apply(p, p.normal, p.impulse, bodies);
    for (int k = 0; k < 2; ++k) apply(p, p.tangent[k], p.friction_impulse[k], bodies);
  }
  const std::size_t n = contacts.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double moved = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = sweep % 2 == 0 ? k : n - 1 - k;
      if (contacts[i].friction > 0)
        moved = std::max(moved, visit_friction(prepared_[i], contacts[i].friction, bodies));
      moved = std::max(moved, visit_normal(prepared_[i], target[i], bodies));
    }
    if (moved <= settled_speed) break;
  }
  // Normal impulses may have shrunk since friction was last looked at: back into the cone.
  for (std::size_t i = 0; i < n; ++i)
    if (contacts[i].friction > 0) visit_friction(prepared_[i], contacts[i].friction, bodies);
  for (std::size_t i = 0; i < n; ++i) {
    const Prepared& p = prepared_[i];
    const bool sound = std::isfinite(p.impulse) && std::isfinite(p.friction_impulse[0]) &&
                       std::isfinite(p.friction_impulse[1]);
    if (!sound) {
      contacts[i].normal_impulse = 0;
      contacts[i].friction_impulse.setZero();
      continue;
    }
    contacts[i].normal_impulse = p.impulse;
    contacts[i].friction_impulse = p.friction_impulse[0] * p.tangent[0].direction +
                                   p.friction_impulse[1] * p.tangent[1].direction;
  }
}

void SequentialImpulses::push_out(std::span<ContactBody> bodies, std::span<const Contact> contacts,
                                  std::span<const double> target) {
  prepare(bodies, contacts, false);
  const std::size_t n = contacts.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double moved = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = sweep % 2 == 0 ? k : n - 1 - k;
      moved = std::max(moved, visit_normal(prepared_[i], target[i], bodies));
    }
    if (moved <= settled_speed) break;
  }
}

}  // namespace poinsot
