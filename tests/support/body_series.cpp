#include "support/body_series.h"

#include <algorithm>
#include <cmath>

#include "poinsot/base/check.h"

namespace poinsot::test {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Component i of a × b from a function that multiplies component a_j by component b_k.
template <typename Times>
auto cross(int i, Times times) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return times(j, k) - times(k, j);
}

template <typename Real>
std::array<Real, 3> rounded(const Quad3& a) {
  return {static_cast<Real>(a[0]), static_cast<Real>(a[1]), static_cast<Real>(a[2])};
}

}  // namespace

Quad33 rotation(const std::array<Quad, 4>& q) {
  const auto [x, y, z, w] = q;
  return {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
}

std::array<Quad, 4> normalized(std::array<Quad, 4> q) {
  const Quad norm = sqrtq(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (Quad& x : q) x /= norm;
  return q;
}

Quad33 inverse(const Mat3& J) {
  const auto e = [&](int i, int j) { return Quad(J(i % 3, j % 3)); };
  Quad33 adjugate;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      adjugate[at(j)][at(i)] =
          e(i + 1, j + 1) * e(i + 2, j + 2) - e(i + 1, j + 2) * e(i + 2, j + 1);
  const Quad det = e(0, 0) * adjugate[0][0] + e(0, 1) * adjugate[1][0] + e(0, 2) * adjugate[2][0];
  for (Quad3& row : adjugate)
    for (Quad& x : row) x /= det;
  return adjugate;
}

template <typename Real>
BodySeries<Real>::BodySeries(const ReferenceBody& body)
    : body_(body), springs_(body.springs.size()) {
  const Quad33 inv_J = inverse(body.J_B);
  for (std::size_t i = 0; i < 3; ++i) inv_J_[i] = rounded<Real>(inv_J[i]);
}

template <typename Real>
void BodySeries<Real>::expand(const QuadState& state, int order) {
  POINSOT_CHECK(order >= 2 && order <= kMaxOrder);
  order_ = order;
  origin_ = state;
  const HeldWrench& held = body_.held;
  needs_rotation_ = !springs_.empty() || !held.in_B.force.isZero(0) ||
                    !held.in_W.torque.isZero(0) || !held.moment.isZero(0);
  for (std::size_t i = 0; i < 3; ++i) {
    c_[i][0] = static_cast<Real>(state.c[i]);
    P_[i][0] = static_cast<Real>(state.P[i]);
    m_[i][0] = static_cast<Real>(state.m[i]);
  }
  for (std::size_t i = 0; i < 4; ++i) q_[i][0] = static_cast<Real>(state.q[i]);
  speed_ = {};
  for (Spring& spring : springs_) spring.length = {};
  for (int k = 0; k < order; ++k) extend(k);
}

template <typename Real>
void BodySeries<Real>::extend(int k) {
  for (std::size_t i = 0; i < 3; ++i) {
    omega_[i][at(k)] = 0;
    for (std::size_t j = 0; j < 3; ++j) omega_[i][at(k)] += inv_J_[i][j] * m_[j][at(k)];
    v_[i][at(k)] = P_[i][at(k)] / body_.mass;
  }
  if (needs_rotation_) extend_rotation(k);
  for (std::size_t s = 0; s < springs_.size(); ++s) extend_spring(body_.springs[s], springs_[s], k);
  const Real3 F = force_W(k), tau = torque_B(k);

  const Real n = k + 1;
  for (int i = 0; i < 3; ++i) {
    c_[at(i)][at(k + 1)] = v_[at(i)][at(k)] / n;
    P_[at(i)][at(k + 1)] = F[at(i)] / n;
    const Real gyroscopic =
        cross(i, [&](int a, int b) { return product(m_[at(a)], omega_[at(b)], k); });
    m_[at(i)][at(k + 1)] = (gyroscopic + tau[at(i)]) / n;
    const Real vector = product(q_[3], omega_[at(i)], k) + cross(i, [&](int a, int b) {
                          return product(q_[at(a)], omega_[at(b)], k);
                        });
    q_[at(i)][at(k + 1)] = vector / (2 * n);
  }
  Real scalar = 0;
  for (std::size_t i = 0; i < 3; ++i) scalar -= product(q_[i], omega_[i], k);
  q_[3][at(k + 1)] = scalar / (2 * n);
}

template <typename Real>
void BodySeries<Real>::extend_rotation(int k) {
  const auto p = [&](std::size_t i, std::size_t j) { return product(q_[i], q_[j], k); };
  const Real xx = p(0, 0), yy = p(1, 1), zz = p(2, 2), ww = p(3, 3);
  const Real xy = p(0, 1), xz = p(0, 2), yz = p(1, 2), wx = p(3, 0), wy = p(3, 1), wz = p(3, 2);
  const std::array<Real3, 3> R = {{{ww + xx - yy - zz, 2 * (xy - wz), 2 * (xz + wy)},
                                   {2 * (xy + wz), ww - xx + yy - zz, 2 * (yz - wx)},
                                   {2 * (xz - wy), 2 * (yz + wx), ww - xx - yy + zz}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) R_[i][j][at(k)] = R[i][j];
}

template <typename Real>
auto BodySeries<Real>::force_W(int k) -> Real3 {
  Real3 F{};
  if (body_.drag_quadratic != 0) speed_.extend(v_, k);
  for (int i = 0; i < 3; ++i) {
    Real& f = F[at(i)];
    if (k == 0) f = Real(body_.mass) * body_.gravity[i] + body_.held.in_W.force[i];
    if (needs_rotation_)
      for (int j = 0; j < 3; ++j) f += R_[at(i)][at(j)][at(k)] * body_.held.in_B.force[j];
    f -= body_.drag_linear * v_[at(i)][at(k)];
    if (body_.drag_quadratic != 0)
      f -= body_.drag_quadratic * product(speed_.series(), v_[at(i)], k);
    for (const Spring& spring : springs_) f += spring.force_W[at(i)][at(k)];
  }
  return F;
}

template <typename Real>
auto BodySeries<Real>::torque_B(int k) -> Real3 {
  Real3 tau{};
  const Mat3& M = body_.held.moment;
  for (int i = 0; i < 3; ++i) {
    Real& t = tau[at(i)];
    if (k == 0) t = body_.held.in_B.torque[i];
    t -= body_.drag_angular * omega_[at(i)][at(k)];
    if (!needs_rotation_) continue;
    for (int j = 0; j < 3; ++j) t += R_[at(j)][at(i)][at(k)] * body_.held.in_W.torque[j];
    // Σ p × Rᵀ F is the axial vector of M R, M = Σ p Fᵀ.
    t += cross(i, [&](int a, int b) {
      Real sum = 0;
      for (int l = 0; l < 3; ++l) sum += M(a, l) * R_[at(l)][at(b)][at(k)];
      return sum;
    });
    for (std::size_t s = 0; s < springs_.size(); ++s)
      t += cross(i, [&](int a, int b) {
        Real force_B = 0;
        for (std::size_t l = 0; l < 3; ++l)
          force_B += product(R_[l][at(b)], springs_[s].force_W[l], k);
        return body_.springs[s].point_B[a] * force_B;
      });
  }
  return tau;
}

template <typename Real>
void BodySeries<Real>::extend_spring(const ReferenceSpring& def, Spring& spring, int k) {
  for (int i = 0; i < 3; ++i)
    spring.lever_rate[at(i)][at(k)] =
        cross(i, [&](int a, int b) { return omega_[at(a)][at(k)] * def.point_B[b]; });
  for (int i = 0; i < 3; ++i) {
    Real x = c_[at(i)][at(k)], rate = v_[at(i)][at(k)];
    if (k == 0) x -= def.point_W[i];
    for (int j = 0; j < 3; ++j) {
      x += R_[at(i)][at(j)][at(k)] * def.point_B[j];
      rate += product(R_[at(i)][at(j)], spring.lever_rate[at(j)], k);
    }
    spring.x[at(i)][at(k)] = x;
    spring.rate[at(i)][at(k)] = rate;
  }
  const bool is_linear = def.damping == 0 && def.rest_length == 0;
  if (is_linear) {
    for (std::size_t i = 0; i < 3; ++i)
      spring.force_W[i][at(k)] = -def.stiffness * spring.x[i][at(k)];
    return;
  }
  spring.length.extend(spring.x, k);
  const Series<Real>& d = spring.length.series();
  for (std::size_t i = 0; i < 3; ++i) {
    Real rest = spring.x[i][at(k)];
    for (int j = 1; j <= k; ++j) rest -= d[at(j)] * spring.along[i][at(k - j)];
    spring.along[i][at(k)] = rest / d[0];
  }
  spring.stretch_rate[at(k)] = 0;
  for (std::size_t i = 0; i < 3; ++i)
    spring.stretch_rate[at(k)] += product(spring.along[i], spring.rate[i], k);
  for (std::size_t i = 0; i < 3; ++i)
    spring.force_W[i][at(k)] = def.stiffness * def.rest_length * spring.along[i][at(k)] -
                               def.stiffness * spring.x[i][at(k)] -
                               def.damping * product(spring.stretch_rate, spring.along[i], k);
}

template <typename Real>
double BodySeries<Real>::step(double tolerance) const {
  constexpr double kLongest = 64, kShortest = 1e-9;       // [s]
  std::array<std::array<double, kMaxOrder + 1>, 4> size;  // of coefficient k of c, P, m, q
  const auto measure = [&](const auto& x, int k) {
    double largest = 0;
    for (const Series<Real>& component : x)
      largest = std::max(largest, std::abs(static_cast<double>(component[at(k)])));
    return largest;
  };
  for (int k = 0; k <= order_; ++k) {
    size[0][at(k)] = measure(c_, k);
    size[1][at(k)] = measure(P_, k);
    size[2][at(k)] = measure(m_, k);
    size[3][at(k)] = measure(q_, k);
  }
  const auto decays = [&](const auto& x, double h) {
    double power = 1, largest = 0, last = 0;
    for (int k = 0; k <= order_; ++k, power *= h) {
      largest = std::max(largest, x[at(k)] * power);
      if (k >= order_ - 1) last = std::max(last, x[at(k)] * power);
    }
    return last <= tolerance * largest;
  };
  double h = kLongest;
  while (h > kShortest &&
         !std::all_of(size.begin(), size.end(), [&](const auto& x) { return decays(x, h); }))
    h *= 0.9;
  return std::max(h, kShortest);
}

template <typename Real>
QuadState BodySeries<Real>::state_at(Quad h) const {
  QuadState state = origin_;
  const Real step = static_cast<Real>(h);
  for (std::size_t i = 0; i < 3; ++i) {
    state.c[i] += change(c_[i], order_, step);
    state.P[i] += change(P_[i], order_, step);
    state.m[i] += change(m_[i], order_, step);
  }
  for (std::size_t i = 0; i < 4; ++i) state.q[i] += change(q_[i], order_, step);
  state.q = normalized(state.q);
  return state;
}

template <typename Real>
Quad3 BodySeries<Real>::momentum_B_at(Quad h) const {
  Quad3 m = origin_.m;
  for (std::size_t i = 0; i < 3; ++i) m[i] += change(m_[i], order_, static_cast<Real>(h));
  return m;
}

template class BodySeries<Quad>;
template class BodySeries<long double>;

}  // namespace poinsot::test
