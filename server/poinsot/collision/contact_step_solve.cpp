#include <algorithm>
#include <cmath>

#include "poinsot/collision/contact_step.h"
#include "poinsot/math/elementary.h"
#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

// Of the speed that a sub-step of gravity gives: slower approaches are at rest, and do not bounce.
constexpr double kRestingSteps = 2.0;
// Slower ones still are left to the standing contact, which stops them within the sub-step.
constexpr double kImpactSteps = 0.25;
// Planes of contact hold while the bodies turn their surfaces by less than this of the size.
constexpr double kTurned = 0.15;
// Of the speed at which penetration is removed: how well it is met.
constexpr double kPushedOut = 1e-3;
// No less than this of the usual sub-step, however fast bodies turn where they touch.
constexpr double kLeastTurn = 1.0 / 4, kLeastPart = 1e-12;
// A slip that goes no farther than this of the tolerance in a sub-step is rest; and nothing shorter
// than kLeastSlip of a sub-step is stopped for.
constexpr double kNoSlip = 0.2;
constexpr double kLeastSlip = 1e-3;
// Of the tolerance: what velocities that are hard to find may be wrong by in a sub-step. When even
// that takes too many iterations, the next sub-step goes on from the impulses found.
constexpr double kAcceptable = 0.1, kOfSpeed = 1e-3;  // … and of what moves fastest
constexpr int kMostIterations = 150, kProofIterations = 60;
// Iterations from which a solve is too dear to be made again for a stop.
constexpr int kDear = 24;
// A pair that comes to rest at the end of a sub-step has full friction to this, relative.
constexpr double kFullSlip = 1e-7;
// A point is inside its cone by this much, relative: below it an equilibrium is not proven.
constexpr double kInsideCone = 1e-3;

double relative_speed(const Contact& contact, std::span<const ContactBody> bodies) {
  const ContactBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const ContactBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const Vec3 at_a = a.v + a.omega.cross(contact.point - a.c);
  const Vec3 at_b = b.v + b.omega.cross(contact.point - b.c);
  return contact.normal.dot(at_a - at_b);
}

Vec3 slip_of(const Contact& contact, std::span<const ContactBody> bodies) {
  const ContactBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const ContactBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const Vec3 v = contact.carried + (a.v + a.omega.cross(contact.point - a.c)) -
                 (b.v + b.omega.cross(contact.point - b.c));
  return v - contact.normal.dot(v) * contact.normal;
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
  for (std::size_t i = 0; i < contacts_.size(); ++i) {  // what is pushed apart moves
    const double size = state.pairs[records_[static_cast<std::size_t>(points_[i].record)]].size;
    if (contacts_[i].gap < -2 * def_.allowed_penetration * size) return false;
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
  target_.assign(contacts_.size(), 0);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    target_[i] = -std::max(contacts_[i].gap, 0.0) / h_;
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
  return std::all_of(contacts_.begin(), contacts_.end(), [](const Contact& contact) {
    const double limit = (1 - kInsideCone) * contact.friction * contact.normal_impulse;
    return contact.friction_impulse.squaredNorm() <= limit * limit;
  });
}

void ContactStep::push_out(CollisionState& state, Books& books) {
  bool any = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const double size = state.pairs[records_[static_cast<std::size_t>(points_[i].record)]].size;
    const double excess = contacts_[i].gap + def_.allowed_penetration * size;
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
  const double h = std::min(h_, usual_);  // a longer one may yet be cut
  for (Contact& contact : contacts_) contact.gap += h * relative_speed(contact, bodies_);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    if (!world.moves(i) || (bodies_[k].v.isZero(0) && bodies_[k].omega.isZero(0))) continue;
    const double spin_energy = rotational_energy(world, i);
    position(world.y, i) += h * bodies_[k].v;
    turn(world, i, h * bodies_[k].omega);
    const double added =
        rotational_energy(world, i) - spin_energy -
        world.mass[static_cast<std::size_t>(i)] * h * world.gravity.dot(bodies_[k].v);
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

// A sub-step shorter than h that is to be tried instead; h if it is good.
double ContactStep::shorter(const CollisionState& state, double h) {
  if (h > usual_) {  // only rest is stepped longer than usual
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const double arm = state.arm[static_cast<std::size_t>(columns_[k])];
      const double travel = h * (bodies_[k].v.norm() + arm * bodies_[k].omega.norm());
      if (state.is_awake(columns_[k]) && !(travel <= def_.contact_tolerance * arm)) return usual_;
    }
  }
  if (!stops_ || residual_.iterations > kDear) return h;
  constexpr double kMuchTooLong = 0.5;  // of h: less is left to the next sub-step
  const double turning = while_turning(state, h, bodies_);
  const double end = turning < kMuchTooLong * h ? turning : end_of_slip(state, h);
  stopped_ = stopped_ || end < h;
  return end;
}

// While bodies turn about where they touch, what is touched leaves the plane of contact by the cube
// of the angle, of what rolls on corners by its square: how long, at most h, until that exceeds the
// tolerance.
double ContactStep::while_turning(const CollisionState& state, double h,
                                  std::span<const ContactBody> bodies) const {
  double longest = h;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    if (!(contact.normal_impulse > 0)) continue;
    const bool rolls = points_[i].motion.is_round_a || points_[i].motion.is_round_b;
    for (const int body : {contact.a, contact.b}) {
      const auto k = static_cast<std::size_t>(body);
      if (!state.has_corners[static_cast<std::size_t>(columns_[k])]) continue;
      const Vec3 omega = bodies[k].omega - contact.normal.dot(bodies[k].omega) * contact.normal;
      const double angle = h * omega.norm();
      const double change = h * (bodies[k].omega - before_[k].omega).norm();
      const double error = rolls ? 0.5 * angle * angle : angle * (angle * angle / 12 + change);
      if (!(error > def_.contact_tolerance)) continue;
      const double part = std::max(def_.contact_tolerance / error, kLeastPart);
      longest = std::min(longest, h * (rolls ? std::sqrt(part) : power(part, 1.0 / 3)));
    }
  }
  return std::max(longest, std::min(h, kLeastTurn * def_.contact_step));
}

// When the first sliding pair comes to rest, if that is within h: there its friction stops being
// that of sliding. While it slides the force it would take to stop it within h is linear in 1/h.
double ContactStep::end_of_slip(const CollisionState& state, double h) {
  double end = h;
  Slip first;
  for (std::size_t r = 0; r < records_.size(); ++r) {
    Vec3 slip = Vec3::Zero(), slip_after = Vec3::Zero(), friction = Vec3::Zero();
    double limit = 0, count = 0;
    for (std::size_t i = first_point_[r]; i < first_point_[r + 1]; ++i) {
      const Contact& contact = contacts_[i];
      if (!(contact.normal_impulse > 0)) continue;
      slip += slip_at_start(i);
      slip_after += slip_of(contact, bodies_);
      friction += contact.friction_impulse / h;
      limit += contact.friction * contact.normal_impulse / h;
      ++count;
    }
    if (count == 0 || limit <= 0) continue;
    const double speed = slip.norm() / count;
    const double rest = kNoSlip * def_.contact_tolerance *
                        state.pairs.records()[static_cast<std::size_t>(records_[r])].size / h;
    if (speed <= rest || slip_after.norm() / count > rest) continue;
    const double excess = -friction.dot(slip) / slip.norm() - limit;
    if (excess >= -kFullSlip * limit) continue;  // it ends here
    const Slip now{static_cast<int>(r), 1 / h, excess};
    double inv_end;
    if (slip_.record == now.record && slip_.inv_h != now.inv_h) {  // secant
      inv_end = now.inv_h - excess * (now.inv_h - slip_.inv_h) / (excess - slip_.excess);
    } else {  // as if nothing but this friction slowed it
      inv_end = now.inv_h * limit / std::max(limit + excess, kLeastPart * limit);
    }
    const double at = 1 / inv_end;
    if (!(at > kLeastSlip * usual_ && at < end)) continue;
    end = at;
    first = now;
  }
  slip_ = first;
  return end;
}

double ContactStep::sound_part(const CollisionState& state) const {
  double part = 1;
  for (std::size_t r = 0; r < records_.size(); ++r) {
    if (first_point_[r] == first_point_[r + 1]) continue;
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(records_[r])];
    const double most = kTurned * record.size;
    for (const int column : {record.a, record.b}) {
      const auto body = static_cast<std::size_t>(local_of_[static_cast<std::size_t>(column)]);
      const double turned =
          h_ * state.arm[static_cast<std::size_t>(column)] * bodies_[body].omega.norm();
      if (turned > most) part = std::min(part, most / turned);
    }
  }
  for (std::size_t k = 0; k < fastest_.size() && k < columns_.size(); ++k) {
    const double allowed = std::max(travel_[k], room_[k]);
    if (fastest_[k] > allowed) part = std::min(part, allowed / fastest_[k]);
  }
  return part;
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
