#include "poinsot/simulation/torque_free.h"

#include <cmath>
#include <numbers>

#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

SinCos sin_cos_turns(double turns) {
  return sin_cos(2 * std::numbers::pi * turns);
}

SinCos at_phase(const Phase& phase, double t) {
  return sin_cos_turns(phase.at(t).fraction);
}

Quat about(const Vec3& axis, const SinCos& half) {
  return {half.cos, half.sin * axis.x(), half.sin * axis.y(), half.sin * axis.z()};
}

// x for which h = eˣ: h − 1/h without cancellation, given h.
double twice_sinh(double x, double h) {
  if (std::abs(x) > 0.4) return h - 1 / h;
  const double s = x * x;
  return 2 * x *
         (1 + s / 6 * (1 + s / 20 * (1 + s / 42 * (1 + s / 72 * (1 + s / 110 * (1 + s / 156))))));
}

// Squares of the complementary nome below this are lost beside 1.
constexpr double kLastNome = 1e-20;

}  // namespace

// Theta series in the nome q ≤ ¼, all sines and cosines from one pair.
void TorqueFree::evaluate(const Polhode& p, double t, Vec3& m, double& x, double& y,
                          double& angle) {
  const SinCos z = at_phase(p.z, t);
  angle = 2 * std::numbers::pi * p.lambda.at(t).fraction;
  const double c2 = (z.cos - z.sin) * (z.cos + z.sin), s2 = 2 * z.sin * z.cos;
  double theta1 = z.sin, theta2 = z.cos, theta3 = 1, theta4 = 1;
  double re = p.shifted ? p.real[0] * z.sin : p.real[0];
  double im = p.shifted ? p.imag[0] * z.cos : 0;
  double c = c2, s = s2;  // of 2nz
  for (std::size_t n = 1; n <= static_cast<std::size_t>(p.terms); ++n) {
    const double odd_c = c * z.cos - s * z.sin, odd_s = s * z.cos + c * z.sin;  // of (2n+1)z
    const double sign = n % 2 == 0 ? 1 : -1;
    theta3 += 2 * p.even[n] * c;
    theta4 += 2 * sign * p.even[n] * c;
    theta2 += p.odd[n] * odd_c;
    theta1 += sign * p.odd[n] * odd_s;
    re += p.real[n] * (p.shifted ? odd_s : c);
    im += p.imag[n] * (p.shifted ? odd_c : s);
    const double next = c * c2 - s * s2;
    s = s * c2 + c * s2;
    c = next;
  }
  const double inverse = 1 / theta4;
  m = {p.scale.x() * theta2 * inverse, p.scale.y() * theta1 * inverse,
       p.scale.z() * theta3 * inverse};
  // times (m₁ − i m₂), both over the same positive factor
  const double m2 = p.sn_scale * theta1;
  x = re * theta2 + im * m2;
  y = im * theta2 - re * m2;
}

// The same functions as sums over n of exp(−(z − cₙ)²/s), the common factor exp(−z²/s) left out;
// z is reduced to the half turn around 0, where two or three terms are enough.
void TorqueFree::evaluate(const Separatrix& p, double t, Vec3& m, double& x, double& y,
                          double& angle) {
  const Reduced z = p.z.at(t);
  const double parity = std::fmod(z.turns, 2) == 0 ? 1 : -1;  // sn, cn change sign after 2K
  const double exponent = p.exponent * z.fraction;
  const double h = exponential(exponent), g = 1 / h;
  const double h2 = h * h, g2 = g * g;
  const double plus1 = h + g, minus1 = twice_sinh(exponent, h), e1 = h2 + g2;
  double theta3 = 1 + p.q1 * e1, theta2 = 1 - p.q1 * e1, theta4 = plus1, theta1 = minus1;
  double re = p.real[0] * plus1, im = p.imag[0] * minus1;
  if (p.q1 > kLastNome) {  // else all further terms are nothing, and their factors overflow
    const double h3 = h2 * h, g3 = g2 * g, h5 = h3 * h2, g5 = g3 * g2;
    const double e2 = h2 * h2 + g2 * g2;
    const double plus3 = p.q2 * (h3 + g3), minus3 = p.q2 * (h3 - g3);
    const double plus5 = p.q6 * (h5 + g5), minus5 = p.q6 * (h5 - g5);
    theta3 += p.q4 * e2;
    theta2 += p.q4 * e2;
    theta4 += plus3 + plus5;
    theta1 += minus5 - minus3;
    re += p.real[1] * plus3 + p.real[2] * plus5;
    im += p.imag[1] * minus3 + p.imag[2] * minus5;
  }
  const double inverse = 1 / theta4;
  m = {p.scale.x() * parity * theta2 * inverse, p.scale.y() * parity * theta1 * inverse,
       p.scale.z() * theta3 * inverse};
  // Only the direction of the product counts; so close to the axis its factors are huge and tiny.
  const double m2 = p.sn_scale * theta1;
  const double first = 1 / plus1, second = parity / (std::abs(theta2) + std::abs(m2));
  x = (re * first) * (theta2 * second) + (im * first) * (m2 * second);
  y = (im * first) * (theta2 * second) - (re * first) * (m2 * second);
  angle = 2 * std::numbers::pi * p.lambda.at(t).fraction - std::numbers::pi * p.beta * z.fraction;
}

// left · Rz(angle + arg(x + iy)) · A(m) · right, brought to unit length once.
Quat TorqueFree::turn(const Frame& frame, const Vec3& m, double x, double y, double angle) {
  const SinCos a = sin_cos(angle);
  const double re = x * a.cos - y * a.sin, im = x * a.sin + y * a.cos;
  const double r = std::sqrt(re * re + im * im);
  // (c, s) along (cos ψ/2, sin ψ/2)
  const double c = re >= 0 ? r + re : std::abs(im);
  const double s = re >= 0 ? im : std::copysign(r - re, im);
  const double w = m.norm() + m.z();
  Quat q(c * w, c * m.y() + s * m.x(), s * m.y() - c * m.x(), s * w);
  q.coeffs() *= 1 / q.norm();
  return frame.left * q * frame.right;
}

template <class Kind>
Quat TorqueFree::orientation(const Kind& kind, double t) {
  if constexpr (std::is_same_v<Kind, Still>) {
    return kind.q;
  } else if constexpr (std::is_same_v<Kind, Spin>) {
    return about(kind.axis, at_phase(kind.half_angle, t)) * kind.q;
  } else if constexpr (std::is_same_v<Kind, Top>) {
    return about(kind.axis_W, at_phase(kind.half_precession, t)) * kind.q *
           about(kind.axis_B, at_phase(kind.half_spin, t));
  } else {
    Vec3 m;
    double x, y, angle;
    evaluate(kind, t, m, x, y, angle);
    return turn(kind, m, x, y, angle);
  }
}

Quat TorqueFree::at(double t) const {
  return std::visit([t](const auto& kind) { return orientation(kind, t); }, motion_);
}

double TorqueFree::error(double t) const {
  constexpr double kRounding = 4e-15, kPhase = 1e-18;  // [rad], [-]
  return kRounding + kPhase * rate_ * std::abs(t);
}

}  // namespace poinsot
