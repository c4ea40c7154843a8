#include "poinsot/collision/contact_resolution.h"

#include <algorithm>
#include <cmath>

#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

// Of the speed that a sub-step of gravity gives: slower approaches are at rest, and do not
// bounce.
constexpr double kRestingSteps = 2.0;
// Slower ones still are left to the standing contact, which stops them within the sub-step.
constexpr double kImpactSteps = 0.25;

double relative_speed(const Contact& contact, std::span<const ContactBody> bodies) {
  const ContactBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const ContactBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const Vec3 at_a = a.v + a.omega.cross(contact.point - a.c);
  const Vec3 at_b = b.v + b.omega.cross(contact.point - b.c);
  return contact.normal.dot(at_a - at_b);
}

Vec3 impulse_of(const Contact& contact) {
  return contact.normal_impulse * contact.normal + contact.friction_impulse;
}

void turn(World& world, Eigen::Index i, const Vec3& angle) {
  const Quat q = orientation(world.y, i);
  orientation(world.y, i).coeffs() += quaternion_rate(q, angle);
  orientation(world.y, i).normalize();
}

double rotational_energy(const World& world, Eigen::Index i) {
  return 0.5 * angular_velocity(world, i).dot(angular_momentum(world.y, i));
}

// Kinetic energy that an impulse pair takes out, given the velocities before and after [J].
double energy_taken(const Contact& contact, const ContactBody& before, const ContactBody& after,
                    double sign) {
  const Vec3 impulse = sign * impulse_of(contact);
  const Vec3 moment = (contact.point - before.c).cross(impulse);
  return -0.5 * (impulse.dot(before.v + after.v) + moment.dot(before.omega + after.omega));
}

}  // namespace

void ContactResolution::gather(const World& world) {
  bodies_.resize(static_cast<std::size_t>(world.size()));
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    ContactBody& body = bodies_[static_cast<std::size_t>(i)];
    body.c = position(world.y, i);
    body.inv_mass = world.inv_mass[static_cast<std::size_t>(i)];
    if (!world.moves(i)) {
      body.v.setZero();
      body.omega.setZero();
      body.inv_J_W.setZero();
      continue;
    }
    body.inv_J_W = inv_J_W(world, i);
    body.v = body.inv_mass * momentum(world.y, i);
    body.omega = body.inv_J_W * angular_momentum(world.y, i);
  }
}

double ContactResolution::push_out(World& world, ContactSet& set, double h) {
  const std::span<Contact> contacts = set.contacts();
  target_.resize(contacts.size());
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double excess = contacts[i].gap + def_.allowed_penetration * set.memories()[i].size;
    any = any || excess < 0;
    target_[i] =
        excess >= 0 ? -excess / h : std::min(-def_.push_out_rate * excess, def_.push_out_speed);
  }
  if (!any) return 0;
  gather(world);
  for (ContactBody& body : bodies_) {
    body.v.setZero();
    body.omega.setZero();
  }
  solver_.push_out(bodies_, contacts, target_);
  double added = 0;
  for (Contact& contact : contacts) contact.gap += h * relative_speed(contact, bodies_);
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!world.moves(i) || (bodies_[k].v.isZero(0) && bodies_[k].omega.isZero(0))) continue;
    const double spin_energy = rotational_energy(world, i);
    position(world.y, i) += h * bodies_[k].v;
    turn(world, i, h * bodies_[k].omega);
    added += rotational_energy(world, i) - spin_energy -
             world.mass[k] * h * world.gravity.dot(bodies_[k].v);
  }
  return added;
}

// A pair on its way in is slowed to arrive at the end of the sub-step and remembers its approach;
// once it touches it leaves with the restitution of that approach. True if anything approaches.
bool ContactResolution::choose_impact_targets(const World& world, ContactSet& set, double h) {
  const std::span<Contact> contacts = set.contacts();
  const double step_speed = h * world.gravity.norm();
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Contact& contact = contacts[i];
    ContactMemory& memory = set.memories()[i];
    const double speed = relative_speed(contact, bodies_);
    const double arrival = -std::max(contact.gap, 0.0) / h;
    const double approach = std::max(-speed, memory.approach);
    target_[i] = arrival;
    const bool touches = contact.gap <= def_.touch_gap * memory.size;
    if (!touches) {
      memory.approach = speed < arrival ? approach : 0;
    } else if (contact.restitution > 0 && approach > kRestingSteps * step_speed) {
      target_[i] = std::max(arrival, contact.restitution * approach);
      memory.approach = 0;
    } else {
      memory.approach = 0;
    }
    any = any || speed < target_[i] - kImpactSteps * step_speed - 1e-12;
  }
  return any;
}

double ContactResolution::resolve_impacts(World& world, ContactSet& set, double h) {
  if (set.contacts().empty()) return 0;
  target_.resize(set.contacts().size());
  gather(world);
  if (!choose_impact_targets(world, set, h)) return 0;
  impacts_.assign(set.contacts().begin(), set.contacts().end());
  for (Contact& contact : impacts_) {
    contact.normal_impulse = 0;
    contact.friction_impulse.setZero();
  }
  before_ = bodies_;
  solver_.solve(bodies_, impacts_, target_);
  double lost = 0;
  for (const Contact& contact : impacts_) {
    const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
    const Vec3 impulse = impulse_of(contact);
    if (impulse.isZero(0)) continue;
    lost += energy_taken(contact, before_[a], bodies_[a], 1) +
            energy_taken(contact, before_[b], bodies_[b], -1);
    for (const auto& [body, sign] : {std::pair{contact.a, 1.0}, {contact.b, -1.0}}) {
      if (!world.moves(body)) continue;
      momentum(world.y, body) += sign * impulse;
      angular_momentum(world.y, body) +=
          sign * (contact.point - before_[static_cast<std::size_t>(body)].c).cross(impulse);
    }
  }
  return lost;
}

void ContactResolution::resolve_contacts(SimulationLayer& simulation, ContactSet& set, double h) {
  const std::span<Contact> contacts = set.contacts();
  if (contacts.empty()) return;
  const World& world = simulation.world();
  const std::span<Wrench> wrenches = simulation.contact_wrenches();
  gather(world);
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    if (!world.moves(i)) continue;
    ContactBody& body = bodies_[static_cast<std::size_t>(i)];
    const Wrench w = acting_wrench(world, i);
    body.v += (h * body.inv_mass) * w.force;
    body.omega += h * (body.inv_J_W * w.torque);
  }
  target_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    target_[i] = -std::max(contacts[i].gap, 0.0) / h;
  solver_.solve(bodies_, contacts, target_);
  for (const Contact& contact : contacts) {
    const Vec3 force = impulse_of(contact) / h;
    for (const auto& [body, sign] : {std::pair{contact.a, 1.0}, {contact.b, -1.0}}) {
      Wrench& wrench = wrenches[static_cast<std::size_t>(body)];
      wrench.force += sign * force;
      wrench.torque +=
          sign * (contact.point - bodies_[static_cast<std::size_t>(body)].c).cross(force);
    }
  }
}

}  // namespace poinsot
