#include <algorithm>
#include <cmath>

#include "poinsot/collision/contact_step.h"
#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

// Slower ones still are left to the standing contact, which stops them within the sub-step.
constexpr double kImpactSteps = 0.25;
// Of the speed at which penetration is removed: how well it is met.
constexpr double kPushedOut = 1e-3;
// Of the tolerance: what velocities that are hard to find may be wrong by in a sub-step. When even
// that takes too many iterations, the next sub-step goes on from the impulses found.
constexpr double kAcceptable = 0.1, kOfSpeed = 1e-3;  // … and of what moves fastest
constexpr int kMostIterations = 150, kProofIterations = 60;
// A point is inside its cone by this much, relative: below it an equilibrium is not proven.
constexpr double kInsideCone = 1e-3;

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

PairPoint& ContactStep::point(CollisionState& state, std::size_t i) {
  PairRecord& record = state.pairs[records_[static_cast<std::size_t>(points_[i].record)]];
  return state.pairs.contact(record).points[static_cast<std::size_t>(points_[i].index)];
}

void ContactStep::gather(const World& world) {
  bodies_.resize(columns_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    ContactBody& body = bodies_[k];
    body.c = position(world.y, i);
    body.v = linear_velocity(world, i);
    if (!world.moves(i)) {
      body.omega = angular_velocity(world, i);
      body.inv_mass = 0;
      body.inv_J_W.setZero();
      continue;
    }
    body.inv_mass = world.inv_mass[static_cast<std::size_t>(i)];
    body.inv_J_W = inv_J_W(world, i);
    body.omega = body.inv_J_W * angular_momentum(world.y, i);
  }
}

ContactStep::Outcome ContactStep::solve(CollisionState& state, Books& books) {
  target_.resize(contacts_.size());
  if (!contacts_.empty()) {
    push_out(state, books);
    foresee_impacts(state, books);
    resolve(state);
    remember(state);
  }
  find_movers(state);
  Outcome outcome;
  outcome.residual = residual_;
  outcome.iterations = iterations_;
  for (const Contact& contact : contacts_) {
    outcome.pushing += contact.normal_impulse > 0 ? 1 : 0;
    outcome.max_penetration = std::max(outcome.max_penetration, -contact.gap);
  }
  return outcome;
}

bool ContactStep::proves_rest(CollisionState& state) {
  const World& world = state.world();
  const double still = def_.sleep_acceleration * h_;
  if (contacts_.empty()) return false;
  const double deepest = std::max(2 * def_.allowed_penetration, def_.contact_tolerance);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {  // what is pushed apart moves
    const double size = state.pairs[records_[static_cast<std::size_t>(points_[i].record)]].size;
    if (contacts_[i].gap < -deepest * size) return false;
  }
  gather(world);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    ContactBody& body = bodies_[k];
    body.v.setZero();
    body.omega.setZero();
    if (!state.is_awake(i)) continue;
    const Wrench w = acting_wrench(world, i);
    body.v = (h_ * body.inv_mass) * w.force;
    body.omega = h_ * (body.inv_J_W * w.torque);
  }
  target_.resize(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    target_[i] = -std::max(contacts_[i].gap, 0.0) / h_;
    contacts_[i].friction *= 1 - kInsideCone;  // what slid into place pushes with all of it
  }
  solver_.max_iterations = kProofIterations;
  solver_.acceptable = 0;
  if (!solver_.solve(bodies_, contacts_, target_).converged) return false;
  remember(state);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const double arm = state.arm[static_cast<std::size_t>(columns_[k])];
    if (state.is_awake(columns_[k]) &&
        !(bodies_[k].v.norm() <= still && arm * bodies_[k].omega.norm() <= still))
      return false;
  }
  return true;
}

void ContactStep::push_out(CollisionState& state, Books& books) {
  const auto size = [&](std::size_t i) {
    return state.pairs[records_[static_cast<std::size_t>(points_[i].record)]].size;
  };
  bool any = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i)  // far out is out of rest
    if (contacts_[i].gap < -def_.touch_gap * size(i)) h_ = std::min(h_, usual_);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double excess = contacts_[i].gap + def_.allowed_penetration * size(i);
    any = any || excess < 0;
    target_[i] =
        excess >= 0 ? -excess / h_ : std::min(-def_.push_out_rate * excess, def_.push_out_speed);
  }
  if (!any) return;
  World& world = state.simulation.world();
  gather(world);
  for (ContactBody& body : bodies_) {
    body.v.setZero();
    body.omega.setZero();
  }
  const double tolerance = solver_.tolerance;
  solver_.tolerance = kPushedOut * *std::max_element(target_.begin(), target_.end());
  solver_.max_iterations = kMostIterations;
  solver_.acceptable = solver_.tolerance;
  iterations_ += solver_.push_out(bodies_, contacts_, target_).iterations;
  solver_.tolerance = tolerance;
  for (Contact& contact : contacts_) contact.gap += h_ * relative_speed(contact, bodies_);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    if (!world.moves(i) || (bodies_[k].v.isZero(0) && bodies_[k].omega.isZero(0))) continue;
    const double spin_energy = rotational_energy(world, i);
    position(world.y, i) += h_ * bodies_[k].v;
    turn(world, i, h_ * bodies_[k].omega);
    const double added =
        rotational_energy(world, i) - spin_energy -
        world.mass[static_cast<std::size_t>(i)] * h_ * world.gravity.dot(bodies_[k].v);
    if (std::isfinite(added)) books.push_out_energy += added;
  }
}

// A pair on its way in is slowed to arrive at the end of the sub-step and remembers its approach;
// once it touches it leaves with the restitution of that approach. True if anything approaches.
bool ContactStep::choose_targets(CollisionState& state) {
  const double step_speed = h_ * state.world().gravity.norm();
  bool any = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    PairPoint& memory = point(state, i);
    const double size = state.pairs[records_[static_cast<std::size_t>(points_[i].record)]].size;
    const double speed = relative_speed(contact, bodies_);
    const double arrival = -std::max(contact.gap, 0.0) / h_;
    const double approach = std::max(-speed, memory.approach);
    target_[i] = arrival;
    const bool touches = contact.gap <= def_.touch_gap * size;
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

void ContactStep::foresee_impacts(CollisionState& state, Books& books) {
  World& world = state.simulation.world();
  gather(world);
  fastest_.resize(columns_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) fastest_[k] = 0;
  if (!choose_targets(state)) return;
  impacts_.assign(contacts_.begin(), contacts_.end());
  for (Contact& contact : impacts_) {
    contact.normal_impulse = 0;
    contact.friction_impulse.setZero();
  }
  before_ = bodies_;
  solver_.max_iterations = kMostIterations;
  solver_.acceptable = kAcceptable * def_.contact_tolerance * least_size_ / h_;
  iterations_ += solver_.solve(bodies_, impacts_, target_).iterations;
  for (const Contact& contact : impacts_) {
    const auto a = static_cast<std::size_t>(contact.a), b = static_cast<std::size_t>(contact.b);
    const Vec3 impulse = impulse_of(contact);
    if (impulse.isZero(0)) continue;
    const double lost = energy_taken(contact, before_[a], bodies_[a], 1) +
                        energy_taken(contact, before_[b], bodies_[b], -1);
    if (std::isfinite(lost)) books.impact_loss += lost;
    for (const auto& [body, sign] : {std::pair{a, 1.0}, {b, -1.0}}) {
      const Eigen::Index i = columns_[body];
      if (!world.moves(i)) continue;
      momentum(world.y, i) += sign * impulse;
      angular_momentum(world.y, i) += sign * (contact.point - before_[body].c).cross(impulse);
    }
  }
}

// The impulses of a sub-step, and how long it is.
void ContactStep::resolve(CollisionState& state) {
  constexpr int kTries = 8;
  const World& world = state.world();
  gather(world);
  before_ = bodies_;
  acceleration_.resize(columns_.size());
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    acceleration_[k] = Velocity{};
    if (!world.moves(columns_[k])) continue;
    const Wrench w = acting_wrench(world, columns_[k]);
    acceleration_[k] = {bodies_[k].inv_mass * w.force, bodies_[k].inv_J_W * w.torque};
  }
  double h = stops_ ? while_turning(state, h_, before_) : h_;
  stopped_ = h < h_;
  scale_impulses(h / h_);
  find_forces(state, h);
  for (int attempt = 0; attempt < kTries && !foresees_; ++attempt) {
    const double next = shorter(state, h);
    if (next == h) break;
    scale_impulses(next / h);
    h = next;
    find_forces(state, h);
  }
  set_duration(state, h);
  act(state);
}

void ContactStep::scale_impulses(double by) {
  for (Contact& contact : contacts_) {
    contact.normal_impulse *= by;
    contact.friction_impulse *= by;
  }
}

void ContactStep::find_forces(const CollisionState& state, double h) {
  place_middle(state, h);
  // A gap that the last sub-steps left is not closed in one that is cut short: nothing would push.
  const double longest = foresees_ ? h : std::max(h, usual_);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    target_[i] = -std::max(contacts_[i].gap, 0.0) / longest;
  solver_.max_iterations = kMostIterations;
  double fastest = 0;  // what stands has to be found for sure
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (before_[k].inv_mass > 0)
      fastest =
          std::max(fastest, before_[k].v.norm() + state.arm[static_cast<std::size_t>(columns_[k])] *
                                                      before_[k].omega.norm());
  solver_.acceptable =
      std::min(kAcceptable * def_.contact_tolerance * least_size_ / h, kOfSpeed * fastest);
  residual_ = solver_.solve(bodies_, contacts_, target_);
  iterations_ += residual_.iterations;
}

void ContactStep::set_duration(CollisionState& state, double h) {
  h_ = h;
  for (const int r : records_) state.pairs.contact(state.pairs[r]).last_h = h;
}

void ContactStep::act(CollisionState& state) {
  const World& world = state.world();
  const std::span<Wrench> wrenches = state.simulation.contact_wrenches();
  for (const Contact& contact : contacts_) {
    const Vec3 force = impulse_of(contact) / h_;
    for (const auto& [body, sign] : {std::pair{contact.a, 1.0}, {contact.b, -1.0}}) {
      const auto k = static_cast<std::size_t>(body);
      if (!world.moves(columns_[k])) continue;
      Wrench& wrench = wrenches[static_cast<std::size_t>(columns_[k])];
      wrench.force += sign * force;
      wrench.torque += sign * (contact.point - bodies_[k].c).cross(force);
    }
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    if (!world.moves(columns_[k])) continue;
    const double arm = state.arm[static_cast<std::size_t>(columns_[k])];
    const auto speed = [&](const ContactBody& b) { return b.v.norm() + arm * b.omega.norm(); };
    fastest_[k] = h_ * std::max(speed(before_[k]), speed(bodies_[k]));
  }
}

void ContactStep::remember(CollisionState& state) {
  for (const int r : records_) state.pairs[r].by_crowd = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    PairPoint& p = point(state, i);
    p.normal_impulse = contacts_[i].normal_impulse;
    p.friction_impulse = contacts_[i].friction_impulse;
    p.gap = contacts_[i].gap;
  }
}

}  // namespace poinsot
