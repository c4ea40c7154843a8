// How long a sub-step is: cut where the error of positions would exceed the scene's tolerance.

#include <algorithm>
#include <cmath>

#include "poinsot/collision/contact_step.h"
#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

// Planes of contact hold while the bodies turn their surfaces by less than this of the size.
constexpr double kTurned = 0.15;
// No less than this of the usual sub-step, however fast bodies turn where they touch.
constexpr double kLeastTurn = 1.0 / 4, kLeastPart = 1e-12;
// A slip that goes no farther than this of the tolerance in a sub-step is rest; and nothing shorter
// than kLeastSlip of a sub-step is stopped for.
constexpr double kNoSlip = 0.2;
constexpr double kLeastSlip = 1e-3;
// Iterations from which a solve is too dear to be made again for a stop.
constexpr int kDear = 24;
// A pair that comes to rest at the end of a sub-step has full friction to this, relative.
constexpr double kFullSlip = 1e-7;

Vec3 slip_of(const Contact& contact, std::span<const ContactBody> bodies) {
  const ContactBody& a = bodies[static_cast<std::size_t>(contact.a)];
  const ContactBody& b = bodies[static_cast<std::size_t>(contact.b)];
  const Vec3 v = contact.carried + (a.v + a.omega.cross(contact.point - a.c)) -
                 (b.v + b.omega.cross(contact.point - b.c));
  return v - contact.normal.dot(v) * contact.normal;
}

}  // namespace

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

}  // namespace poinsot
