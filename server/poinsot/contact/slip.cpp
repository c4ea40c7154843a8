#include "poinsot/contact/slip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kTolerance = 1e-11;  // of a step, relative to the speed before the impact
constexpr double kStopped = 1e-11;    // slip slower than this has stopped, relative likewise
constexpr double kStraight = 1e-14;   // relative rate of turning taken as none
constexpr int kSteps = 20'000;

}  // namespace

Slip::Slip(const Mat3& A, const Vec3& u, double returned_share)
    : tangential(u.head<2>()),
      A_(A),
      u_(u),
      share_(returned_share),
      speed_(u.norm()),
      normal_(u.z()) {}

Vec3 Slip::impulse(double friction) const {
  Vec3 p = p_;
  const double length = p.head<2>().norm(), limit = friction * p.z();
  if (length > limit) p.head<2>() *= limit / length;
  return p;
}

// Normal velocity is linear in the impulse here and its work a parabola.
bool Slip::straight(const Vec2& f, double limit) {
  const Vec3 direction(f.x(), f.y(), 1);
  const Vec3 k = A_ * direction;
  double left = limit;
  const auto advance = [&](double dp) {
    p_ += dp * direction;
    tangential += dp * k.head<2>();
    left -= dp;
  };
  while (left > 0) {
    if (compressing_) {
      const double needed = k.z() > 0 ? -normal_ / k.z() : left;
      const double dp = std::min(needed, left);
      if (!std::isfinite(dp)) return false;
      const double work = dp * (normal_ + 0.5 * k.z() * dp);
      const bool ended = k.z() > 0 && needed <= left;
      advance(dp);
      compression_ -= work;
      normal_ = ended ? 0.0 : normal_ + dp * k.z();
      if (!ended) return false;
      compressing_ = false;
    }
    const double wanted = share_ * compression_ - restitution_;
    if (!(wanted > 0)) return true;
    const double discriminant = normal_ * normal_ + 2 * k.z() * wanted;
    const bool reached = discriminant >= 0 && normal_ + std::sqrt(discriminant) > 0;
    const double end =
        reached ? 2 * wanted / (normal_ + std::sqrt(discriminant)) : normal_ / -k.z();
    const double dp = std::min(end, left);
    restitution_ += dp * (normal_ + 0.5 * k.z() * dp);
    advance(dp);
    normal_ += dp * k.z();
    if (dp == end && reached) return true;
    if (dp < end) return false;
    normal_ = 0;
    compressing_ = true;
    if (!(k.z() < 0)) return false;
  }
  return false;
}

bool Slip::slip_is_straight(double friction) const {
  const Vec2 theta = tangential.normalized();
  const Vec2 Atn = A_.topRightCorner<2, 1>();
  const Vec2 kicked = friction * (A_.topLeftCorner<2, 2>() * theta);
  const Vec2 g = Atn - kicked;
  return std::abs(theta.x() * g.y() - theta.y() * g.x()) <=
         kStraight * (Atn.norm() + kicked.norm());
}

Slip::State Slip::rate(const State& y, double friction) const {
  const Vec2 slip = y.head<2>();
  const double r = slip.norm();
  // Per unit of σ the impulse is r, and r ut/|ut| = ut: smooth where slip stops.
  const Vec3 impulse(-friction * slip.x(), -friction * slip.y(), r);
  State d;
  d.head<2>() = A_.topRows<2>() * impulse;
  d.segment<3>(2) = impulse;
  d[5] = r * normal_speed(y);
  return d;
}

double Slip::normal_speed(const State& y) const {
  return u_.z() + A_.row(2).dot(y.segment<3>(2));
}

// Dormand, Prince: fifth order, the error of the fourth.
Slip::State Slip::step(const State& y, double h, double friction, double* error) const {
  const State k1 = rate(y, friction);
  const State k2 = rate(y + h * (k1 / 5), friction);
  const State k3 = rate(y + h * (3 * k1 / 40 + 9 * k2 / 40), friction);
  const State k4 = rate(y + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9), friction);
  const State k5 =
      rate(y + h * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 - 212 * k4 / 729),
           friction);
  const State k6 = rate(y + h * (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 +
                                 49 * k4 / 176 - 5103 * k5 / 18656),
                        friction);
  const State next =
      y + h * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 + 11 * k6 / 84);
  if (error) {
    const State k7 = rate(next, friction);
    const State e = h * (71 * k1 / 57600 - 71 * k3 / 16695 + 71 * k4 / 1920 - 17253 * k5 / 339200 +
                         22 * k6 / 525 - k7 / 40);
    const double mass = 1 / A_(2, 2);
    // Slip about to stop is followed relative to itself, or it would never get there.
    const double slip = std::min(speed_, 1e5 * next.head<2>().norm());
    *error = std::max({e.head<2>().norm() / slip, e.segment<3>(2).norm() / (mass * speed_),
                       std::abs(e[5]) / (mass * speed_ * speed_)});
  }
  return next;
}

double Slip::overshoot(const State& y) const {
  const double un = normal_speed(y);
  if (compressing_) return un;
  return std::max(restitution_ + y[5] - share_ * compression_, -un);
}

// The step ends beyond the phase: shortened by false position (Illinois) until it ends with it.
void Slip::land(const State& from, State& to, double h, double friction) const {
  double low = 0, high = h, at_low = overshoot(from), at_high = overshoot(to);
  int side = 0;
  for (int i = 0; i < 100 && high - low > 1e-16 * h && at_high > 0; ++i) {
    double middle = low + (high - low) * (at_low / (at_low - at_high));
    if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
    const State trial = step(from, middle, friction, nullptr);
    const double value = overshoot(trial);
    if (value >= 0) {
      if (side > 0) at_low *= 0.5;
      high = middle;
      at_high = value;
      to = trial;
      side = 1;
    } else {
      if (side < 0) at_high *= 0.5;
      low = middle;
      at_low = value;
      side = -1;
    }
  }
}

bool Slip::end_phase(double work) {
  if (compressing_) {
    compression_ -= work;
    compressing_ = false;
    return !(share_ * compression_ - restitution_ > 0);
  }
  restitution_ += work;
  // Within the reach of rounding either the work is done or a second compression begins.
  if (restitution_ >= share_ * compression_ * (1 - 1e-14)) return true;
  compressing_ = true;
  return false;
}

Slip::End Slip::until_it_ends(double friction) {
  double h = 0.01 / (A_.trace() * (1 + friction));
  for (int i = 0; i < kSteps; ++i) {
    if (slip_is_straight(friction)) {
      const Vec2 theta = tangential.normalized();
      const Vec2 f = -friction * theta;
      const double slope = theta.dot((A_ * Vec3(f.x(), f.y(), 1)).head<2>());
      const double limit =
          slope < 0 ? tangential.norm() / -slope : std::numeric_limits<double>::infinity();
      if (straight(f, limit)) return End::kImpactOver;
      if (!(slope < 0)) return End::kLost;
      tangential.setZero();
      return End::kStopped;
    }
    State y;
    y << tangential, p_, 0.0;
    double error = 0;
    State next = step(y, h, friction, &error);
    if (!next.allFinite()) return End::kLost;
    const double factor = 0.9 * std::pow(kTolerance / std::max(error, 1e-30), 0.2);
    if (error > kTolerance) {
      h *= std::max(0.2, factor);
      continue;
    }
    const bool phase_over = overshoot(next) > 0;
    if (phase_over) land(y, next, h, friction);
    h *= std::clamp(factor, 0.2, 5.0);
    tangential = next.head<2>();
    p_ = next.segment<3>(2);
    normal_ = phase_over && compressing_ ? 0.0 : normal_speed(next);
    if (phase_over) {
      if (end_phase(next[5])) return End::kImpactOver;
    } else if (compressing_) {
      compression_ -= next[5];
    } else {
      restitution_ += next[5];
    }
    if (tangential.norm() <= kStopped * speed_) {
      tangential.setZero();
      return End::kStopped;
    }
  }
  return End::kLost;
}

}  // namespace poinsot
