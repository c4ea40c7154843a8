#include "support/extended_reference.h"

#include <utility>
#include <variant>

#include "poinsot/base/check.h"
#include "support/body_series.h"

namespace poinsot::test {
namespace {

using Quad4 = std::array<Quad, 4>;

Quad3 quad(const Vec3& a) {
  return {Quad(a.x()), Quad(a.y()), Quad(a.z())};
}

Quad4 quad(const Quat& q) {
  return normalized({Quad(q.x()), Quad(q.y()), Quad(q.z()), Quad(q.w())});
}

Vec3 rounded(const Quad3& a) {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

Quad dot(const Quad3& a, const Quad3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Quad3 times(const Quad33& A, const Quad3& x) {
  return {dot(A[0], x), dot(A[1], x), dot(A[2], x)};
}

Quad33 transposed(const Quad33& A) {
  Quad33 result;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = A[j][i];
  return result;
}

double distance(const Quad3& a, const Quad3& b) {
  const Quad3 d = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return static_cast<double>(sqrtq(dot(d, d)));
}

// Angle of the rotation conj(a) b.
double angle(const Quad4& a, const Quad4& b) {
  const Quad w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const Quad3 v = {a[3] * b[0] - b[3] * a[0] - (a[1] * b[2] - a[2] * b[1]),
                   a[3] * b[1] - b[3] * a[1] - (a[2] * b[0] - a[0] * b[2]),
                   a[3] * b[2] - b[3] * a[2] - (a[0] * b[1] - a[1] * b[0])};
  return static_cast<double>(2 * atan2q(sqrtq(dot(v, v)), fabsq(w)));
}

using AnySeries = std::variant<BodySeries<Quad>, BodySeries<long double>>;

AnySeries series_of(const ReferenceBody& body, const ReferenceOptions& options) {
  if (options.quad) return BodySeries<Quad>(body);
  return BodySeries<long double>(body);
}

}  // namespace

struct ExtendedReference::Motion {
  ReferenceBody body;
  ReferenceOptions options;
  Quad33 inv_J;
  AnySeries series;
  QuadState now = {};
  Quad t = 0;       // [s]
  Quad anchor = 0;  // [s] the series' origin
  double step = 0;  // [s] up to which the series holds
  double phase = 0;
  Quad energy0 = 0;
  Quad3 L0{};

  void expand() {
    anchor = t;
    std::visit([&](auto& s) { s.expand(now, options.order); }, series);
    step = std::visit([&](const auto& s) { return s.step(options.tolerance); }, series);
  }

  // Moves on to anchor + h, h ≤ step.
  void move(Quad h) {
    phase += turned(t - anchor, h);
    now = std::visit([&](const auto& s) { return s.state_at(h); }, series);
    t = anchor + h;
  }

  // ∫ |ω| dt by Gauss and Legendre, three nodes.
  double turned(Quad from, Quad to) const {
    const double width = static_cast<double>(to - from);
    double sum = 0;
    for (const auto& [node, weight] :
         {std::pair{-0.7745966692414834, 5.0 / 9}, {0.0, 8.0 / 9}, {0.7745966692414834, 5.0 / 9}}) {
      const Quad h = from + (0.5 * width) * (1 + node);
      const Quad3 m = std::visit([&](const auto& s) { return s.momentum_B_at(h); }, series);
      sum += weight * rounded(times(inv_J, m)).norm();
    }
    return 0.5 * width * sum;
  }

  Quad3 angular_momentum() const { return times(rotation(now.q), now.m); }
  Quad energy() const {
    return (dot(now.P, now.P) / body.mass + dot(now.m, times(inv_J, now.m))) / 2;
  }
};

ExtendedReference::ExtendedReference(const ReferenceBody& body, const Vec3& c, const Quat& q,
                                     const Vec3& P_W, const Vec3& L_W,
                                     const ReferenceOptions& options)
    : motion_(new Motion{.body = body,
                         .options = options,
                         .inv_J = inverse(body.J_B),
                         .series = series_of(body, options)}) {
  Motion& m = *motion_;
  m.now.c = quad(c);
  m.now.P = quad(P_W);
  m.now.q = quad(q);
  m.L0 = quad(L_W);
  m.now.m = times(transposed(rotation(m.now.q)), m.L0);
  m.energy0 = m.energy();
  m.expand();
}

ExtendedReference::~ExtendedReference() = default;
ExtendedReference::ExtendedReference(ExtendedReference&&) noexcept = default;

void ExtendedReference::advance_to(double t) {
  Motion& m = *motion_;
  POINSOT_CHECK(m.t <= t);
  while (t - m.anchor > m.step) {
    m.move(m.step);
    m.expand();
  }
  m.move(t - m.anchor);
}

void ExtendedReference::hold(const HeldWrench& held) {
  std::visit([&](auto& s) { s.hold(held); }, motion_->series);
  motion_->expand();
}

Vec3 ExtendedReference::position() const {
  return rounded(motion_->now.c);
}

Quat ExtendedReference::orientation() const {
  const Quad4& q = motion_->now.q;
  return {static_cast<double>(q[3]), static_cast<double>(q[0]), static_cast<double>(q[1]),
          static_cast<double>(q[2])};
}

Vec3 ExtendedReference::momentum() const {
  return rounded(motion_->now.P);
}

Vec3 ExtendedReference::angular_momentum() const {
  return rounded(motion_->angular_momentum());
}

Vec3 ExtendedReference::angular_momentum_B() const {
  return rounded(motion_->now.m);
}

Vec3 ExtendedReference::angular_velocity() const {
  const Motion& m = *motion_;
  return rounded(times(rotation(m.now.q), times(m.inv_J, m.now.m)));
}

double ExtendedReference::kinetic_energy() const {
  return static_cast<double>(motion_->energy());
}

double ExtendedReference::orientation_error(const Quat& q) const {
  return angle(motion_->now.q, quad(q));
}

double ExtendedReference::position_error(const Vec3& c) const {
  return distance(motion_->now.c, quad(c));
}

double ExtendedReference::orientation_error(const ExtendedReference& other) const {
  return angle(motion_->now.q, other.motion_->now.q);
}

double ExtendedReference::position_error(const ExtendedReference& other) const {
  return distance(motion_->now.c, other.motion_->now.c);
}

double ExtendedReference::energy_drift() const {
  const Motion& m = *motion_;
  return static_cast<double>(fabsq(m.energy() - m.energy0) / m.energy0);
}

double ExtendedReference::angular_momentum_drift() const {
  const Motion& m = *motion_;
  return distance(m.angular_momentum(), m.L0) / rounded(m.L0).norm();
}

double ExtendedReference::spin_phase() const {
  return motion_->phase;
}

ExtendedReference reference_of(const ReferenceBody& body, const Vec3& c, const Quat& q,
                               const Vec3& velocity_W, const Vec3& omega_W,
                               const ReferenceOptions& options) {
  const Mat3 R = q.toRotationMatrix();
  const Vec3 L = R * (body.J_B * (R.transpose() * omega_W));
  return {body, c, q, body.mass * velocity_W, L, options};
}

}  // namespace poinsot::test
