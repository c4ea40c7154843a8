// The set-up of an exact torque-free rotation: from inertia, orientation and angular momentum to
// the constants that torque_free.cpp evaluates. In extended precision, because errors of the two
// rates grow with time, and in 113 bits where the motion comes close to the separatrix, because
// there the time of a turn-over depends on the logarithm of a difference.

#include <cmath>
#include <numbers>

#include "poinsot/math/elementary.h"
#include "poinsot/math/elliptic.h"
#include "poinsot/simulation/torque_free.h"

namespace poinsot {
namespace {

using Real = long double;
__extension__ using Quad = __float128;

constexpr Real kPi = std::numbers::pi_v<Real>;

// L in the principal frame, Aᵀ R(q)ᵀ L; q as it is, for rounding it to unit length would turn m by
// more than a needle's smallest component can bear.
template <class T>
std::array<T, 3> principal_momentum(const PrincipalAxes& body, const Quat& q, const Vec3& L) {
  const T x = q.x(), y = q.y(), z = q.z(), w = q.w();
  const T xx = x * x, yy = y * y, zz = z * z, ww = w * w, norm = xx + yy + zz + ww;
  const T l[3] = {L.x(), L.y(), L.z()};
  const T b[3] = {
      ((ww + xx - yy - zz) * l[0] + 2 * ((x * y + w * z) * l[1] + (x * z - w * y) * l[2])) / norm,
      ((ww - xx + yy - zz) * l[1] + 2 * ((x * y - w * z) * l[0] + (y * z + w * x) * l[2])) / norm,
      ((ww - xx - yy + zz) * l[2] + 2 * ((x * z + w * y) * l[0] + (y * z - w * x) * l[1])) / norm};
  std::array<T, 3> m = {};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) m[k] += T(body.axes[i][k]) * b[i];
  return m;
}

// |a₁| m₃² − |a₃| m₁² = (G² − 2 T I₂)/I₂: positive where the axis of I₃ is circled, negative where
// that of I₁ is, zero on the separatrix.
template <class T>
T separation(const std::array<Real, 3>& moments, const std::array<T, 3>& m) {
  const T i1 = moments[0], i2 = moments[1], i3 = moments[2];
  return ((i3 - i2) / i3 * m[2] * m[2] - (i2 - i1) / i1 * m[0] * m[0]) / i2;
}

Vec3 to_vec(Real x, Real y, Real z) {
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

// Half an angle [rad/s] as turns.
Phase half_turns(Real rate) {
  return {rate / (4 * kPi), 0};
}

// The polhode in a frame with m₃ > 0 circled, in units of G.
struct Circled {
  Real I1, a1, a2, a3;  // [1/(kg·m²)] the a
  Real m1, m2, m3;      // [-]
  Real M1, M2, M3;      // [-] amplitudes
  Real k, k_complement;
  Real spin;                                // [1/(kg·m²)] 2T/G²
  std::array<std::array<Real, 3>, 3> axes;  // of that frame, in B
};

Circled circle(const PrincipalAxes& body, std::array<Real, 3> m, Real separation, Real G) {
  std::array<Real, 3> I = body.moments;
  Circled c = {};
  c.axes = body.axes;
  if (separation < 0) {  // exchange axes 1 and 3, turn axis 2 round
    std::swap(I[0], I[2]);
    std::swap(m[0], m[2]);
    m[1] = -m[1];
    for (auto& row : c.axes) {
      std::swap(row[0], row[2]);
      row[1] = -row[1];
    }
  }
  if (m[2] < 0) {  // half a turn about axis 1
    m[1] = -m[1];
    m[2] = -m[2];
    for (auto& row : c.axes) {
      row[1] = -row[1];
      row[2] = -row[2];
    }
  }
  c.I1 = I[0];
  c.a1 = (I[1] - I[2]) / (I[1] * I[2]);
  c.a2 = (I[2] - I[0]) / (I[2] * I[0]);
  c.a3 = (I[0] - I[1]) / (I[0] * I[1]);
  c.spin = (m[0] * m[0] / I[0] + m[1] * m[1] / I[1] + m[2] * m[2] / I[2]) / (G * G);
  c.m1 = m[0] / G;
  c.m2 = m[1] / G;
  c.m3 = m[2] / G;
  const Real r12 = std::abs(c.a1 / c.a2), r32 = std::abs(c.a3 / c.a2);
  c.M1 = std::sqrt(c.m1 * c.m1 + r12 * c.m2 * c.m2);
  c.M2 = std::sqrt(c.m2 * c.m2 + c.m1 * c.m1 / r12);
  c.M3 = std::sqrt(c.m3 * c.m3 + r32 * c.m2 * c.m2);
  // A motion closer to the separatrix than any double could tell stays this close.
  constexpr Real kLeast = 1e-145L;
  c.k_complement =
      std::fmax(kLeast, std::sqrt(std::abs(separation) / (std::abs(c.a1) * G * G)) / c.M3);
  c.k = std::sqrt(std::abs(c.a3 / c.a1)) * c.M1 / c.M3;
  return c;
}

struct Periods {
  Real K, K_prime;
  Real u;           // at t = 0
  Real b, b_prime;  // b + b′ = K′
};

Periods periods(const Circled& c) {
  Periods p = {};
  p.K = complete_elliptic_k(c.k_complement);
  p.K_prime = complete_elliptic_k(c.k);
  const Real sn = c.m2 / c.M2, cn = c.m1 / c.M1, dn = c.m3 / c.M3;
  const Real f = incomplete_elliptic_f(sn, cn, dn * dn);
  p.u = cn >= 0 ? f : (sn >= 0 ? 2 * p.K : -2 * p.K) - f;
  const Real kk = c.k_complement * c.k_complement;
  const auto f_of_tan = [&c, kk](Real opposite, Real adjacent) {
    const Real r = std::hypot(opposite, adjacent);
    const Real s = opposite / r;
    const Real c_phi = adjacent / r;
    return incomplete_elliptic_f(s, c_phi, c.k * c.k + kk * c_phi * c_phi);
  };
  p.b = f_of_tan(c.M3, c.M1);
  p.b_prime = f_of_tan(std::sqrt(std::abs(c.a1)), std::sqrt(std::abs(c.a3)));
  return p;
}

Quat to_quat(const std::array<std::array<Real, 3>, 3>& axes) {
  Mat3 R;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      R(static_cast<int>(i), static_cast<int>(k)) = static_cast<double>(axes[i][k]);
  return Quat(R).normalized();
}

Real power(Real x, std::size_t n) {
  Real product = 1;
  for (; n > 0; --n) product *= x;
  return product;
}

Real hyperbolic_cos(Real x) {
  const Real e = exponential(x);
  return (e + 1 / e) / 2;
}

// Relative accuracy for small x as well: a needle's rates depend on it.
Real hyperbolic_sin(Real x) {
  if (std::abs(x) > 0.5L) {
    const Real e = exponential(x);
    return (e - 1 / e) / 2;
  }
  Real sum = 1;
  for (int n = 18; n >= 2; n -= 2) sum = 1 + x * x * sum / static_cast<Real>(n * (n + 1));
  return x * sum;
}

}  // namespace

struct TorqueFree::Setup {
  const PrincipalAxes& body;
  Quat q;
  Real Lx, Ly, Lz, G;

  Setup(const PrincipalAxes& axes, const Quat& orientation, const Vec3& L)
      : body(axes), q(orientation.normalized()), Lx(L.x()), Ly(L.y()), Lz(L.z()) {
    G = std::sqrt(Lx * Lx + Ly * Ly + Lz * Lz);
  }

  Spin spin(Real moment) const {
    return {half_turns(G / moment), to_vec(Lx / G, Ly / G, Lz / G), q};
  }

  // m: along the axis of symmetry, which is a column of body.axes.
  Top top(std::size_t axis, Real m) const {
    const Real along = body.moments[axis], across = body.moments[1];
    return {half_turns(G / across), half_turns(m * (across - along) / (along * across)),
            to_vec(Lx / G, Ly / G, Lz / G),
            to_vec(body.axes[0][axis], body.axes[1][axis], body.axes[2][axis]), q};
  }

  // Θ(u + ib) itself, or θ₁ in its place where b is nearer to K′: both series converge at once.
  Polhode polhode(const Circled& c, const Periods& p, Real nome) const {
    Polhode motion = {};
    motion.shifted = p.b > p.b_prime;
    const Real y = kPi * (motion.shifted ? p.b_prime : p.b) / (2 * p.K);
    const Real cosh_y = hyperbolic_cos(y), sinh_y = hyperbolic_sin(y);
    const Real cosh_2y = cosh_y * cosh_y + sinh_y * sinh_y, sinh_2y = 2 * sinh_y * cosh_y;
    Real ch = 1, sh = 0;        // of 2ny
    Real above = 0, below = 0;  // Jacobi's −i Z(iβ, k) over π/2K, β = 2K y/π
    Real theta2 = 0, theta3 = -1, theta4 = -1;
    Real even = 1, odd = 1, step = nome;  // qⁿ², qⁿ⁽ⁿ⁺¹⁾, q²ⁿ⁺¹
    for (std::size_t n = 0; n <= Polhode::kTerms; ++n) {
      const Real sign = n % 2 == 0 ? 1 : -1;
      theta2 += odd;
      theta3 += 2 * even;
      theta4 += 2 * sign * even;
      const Real weight = sign * (n == 0 ? 1 : 2) * even;
      Real re = weight * ch, im = -weight * sh;
      above += static_cast<Real>(2 * n) * im;
      below += re;
      if (motion.shifted) {  // of (2n+1)y, over cosh y
        re = sign * odd * (ch + sh * sinh_y / cosh_y);
        im = -sign * odd * (sh + ch * sinh_y / cosh_y);
      }
      motion.even[n] = static_cast<double>(even);
      motion.odd[n] = static_cast<double>(odd);
      motion.real[n] = static_cast<double>(re);
      motion.imag[n] = static_cast<double>(im);
      constexpr Real kNegligible = 1e-20L;
      if (n > 0 && even * ch < kNegligible && odd * ch < kNegligible) break;
      motion.terms = static_cast<int>(n);
      const Real next = ch * cosh_2y + sh * sinh_2y;
      sh = sh * cosh_2y + ch * sinh_2y;
      ch = next;
      even *= step;
      step *= nome;
      odd *= step;
      step *= nome;
    }
    const Real rate = p_rate(c);
    const Real zeta = kPi / (2 * p.K) * above / below;
    motion.z = {rate / (4 * p.K), p.u / (4 * p.K)};
    motion.lambda = {(motion.shifted ? shifted_rate(c, zeta) : G / c.I1 - zeta * rate) / (2 * kPi),
                     0};
    set_frame(motion, c, theta4 / theta2, theta3 / theta2, theta4 / theta3);
    return motion;
  }

  Separatrix separatrix(const Circled& c, const Periods& p) const {
    Separatrix motion = {};
    const Real nome = exponential(-kPi * p.K / p.K_prime);
    motion.exponent = static_cast<double>(kPi * p.K / p.K_prime);
    motion.q1 = static_cast<double>(nome);
    motion.q2 = static_cast<double>(power(nome, 2));
    motion.q4 = static_cast<double>(power(nome, 4));
    motion.q6 = static_cast<double>(power(nome, 6));
    const Real beta = p.b / p.K_prime, beta_prime = p.b_prime / p.K_prime;
    motion.beta = static_cast<double>(beta);
    Real zeta = kPi * p.b / (2 * p.K * p.K_prime);  // λ = 2T/G + p (Z(b, k′) + πb/2KK′)
    for (std::size_t n = 0; n < motion.real.size(); ++n) {
      const double odd = static_cast<double>(2 * n + 1) * 0.5 * std::numbers::pi;
      const bool near_one = beta > 0.5L;
      const SinCos a = sin_cos(odd * static_cast<double>(near_one ? beta_prime : beta));
      const double sign = n % 2 == 0 ? 1 : -1;
      motion.real[n] = near_one ? sign * a.sin : a.cos;
      motion.imag[n] = near_one ? sign * a.cos : a.sin;
    }
    // Jacobi's Z(b, k′) by its Fourier series
    for (int n = 1; n <= 7; ++n) {
      const Real q_n = power(nome, static_cast<std::size_t>(n));
      const SinCos a = sin_cos(n * std::numbers::pi * static_cast<double>(beta));
      zeta += 2 * kPi / p.K_prime * q_n / (1 - q_n * q_n) * static_cast<Real>(a.sin);
    }
    const Real rate = p_rate(c);
    motion.z = {rate / (2 * p.K), p.u / (2 * p.K)};
    motion.lambda = {(G * c.spin + zeta * rate) / (2 * kPi), 0};
    const Real theta2 = 1 - 2 * nome + 2 * power(nome, 4);
    const Real theta3 = 1 + 2 * nome + 2 * power(nome, 4);
    const Real theta4 = 2 + 2 * power(nome, 2) + 2 * power(nome, 6);
    set_frame(motion, c, theta4 / theta2, theta3 / theta2, theta4 / theta3);
    return motion;
  }

  // λ of the shifted form, which is G/I₁ less a term that for a needle is as large: with β = b′,
  // tan am β = sqrt(|a₁/a₃|) and dn β = sqrt(|a₃/a₂|)/M₃ both become 2T/G.
  Real shifted_rate(const Circled& c, Real zeta) const {
    const Real root = std::sqrt(std::abs(c.a1 / c.a2));  // sn β
    const Real kk = c.k_complement * c.k_complement;
    return G * c.spin + p_rate(c) * (zeta - root / c.M3 + kk * c.M3 * root);
  }

  // u′ [1/s]
  Real p_rate(const Circled& c) const {
    return std::copysign(c.M3 * G * std::sqrt(std::abs(c.a1 * c.a2)), c.a2);
  }

  // Quotients of theta constants: cn, sn and dn against quotients of theta functions.
  template <class Motion>
  void set_frame(Motion& motion, const Circled& c, Real cn, Real sn, Real dn) const {
    motion.scale = to_vec(c.M1 * cn, c.M2 * sn, c.M3 * dn);
    motion.sn_scale = static_cast<double>(c.M2 * sn / (c.M1 * cn));
    motion.right = to_quat(c.axes).conjugate();
    motion.left = Quat::Identity();
  }
};

TorqueFree::TorqueFree(const PrincipalAxes& body, const Quat& q, const Vec3& L) : TorqueFree() {
  const Setup setup(body, q, L);
  const auto& I = body.moments;
  const Real G = setup.G;
  rate_ = static_cast<double>(G / I[0]);
  constexpr Real kNoTurn = 1e-60L;  // [rad/s] no representable time turns the body
  if (!(G / I[0] > kNoTurn)) {
    motion_ = Still{setup.q};
    return;
  }
  auto m = principal_momentum<Real>(body, q, L);
  constexpr Real kEqual = 1e-19L;  // moments that agree to rounding
  const bool low = I[1] - I[0] <= kEqual * I[1], high = I[2] - I[1] <= kEqual * I[2];
  if (low && high) {
    motion_ = setup.spin(I[1]);
    return;
  }
  // About an axis, to the last bit of any time.
  constexpr Real kAlong = 1e-140L;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::hypot(m[(k + 1) % 3], m[(k + 2) % 3]) <= kAlong * G) {
      motion_ = setup.spin(I[k]);
      return;
    }
  if (low || high) {
    motion_ = low ? setup.top(2, m[2]) : setup.top(0, m[0]);
    return;
  }
  Real apart = separation<Real>(I, m);
  // Where the difference cancels, and where one component is so small beside the others (a needle's
  // along its axis) that 64 bits of their sum leave too few of its own.
  constexpr Real kCancels = 1e-3L, kNeedle = 100;
  if (std::abs(apart) < kCancels * G * G * (I[2] - I[0]) / (I[0] * I[2]) || I[2] > kNeedle * I[0]) {
    const auto exact = principal_momentum<Quad>(body, q, L);
    apart = static_cast<Real>(separation<Quad>(I, exact));
    for (std::size_t k = 0; k < 3; ++k) m[k] = static_cast<Real>(exact[k]);
  }
  const Circled circled = circle(body, m, apart, G);
  const Periods p = periods(circled);
  const Real nome = exponential(-kPi * p.K_prime / p.K);
  constexpr Real kSeries = 0.25L;
  Frame* frame = nullptr;
  if (nome <= kSeries)
    frame = &motion_.emplace<Polhode>(setup.polhode(circled, p, nome));
  else
    frame = &motion_.emplace<Separatrix>(setup.separatrix(circled, p));
  frame->left = (setup.q * at(0).conjugate()).normalized();  // until now the identity
}

}  // namespace poinsot
