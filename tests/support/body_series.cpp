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
Quad cross(int i, Times times) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  return times(j, k) - times(k, j);
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

BodySeries::BodySeries(const ReferenceBody& body)
    : body_(body), inv_J_(inverse(body.J_B)), springs_(body.springs.size()) {}

void BodySeries::expand(const QuadState& state, int order) {
  POINSOT_CHECK(order >= 2 && order <= kMaxOrder);
  order_ = order;
  const HeldWrench& held = body_.held;
  needs_rotation_ = !springs_.empty() || !held.in_B.force.isZero(0) ||
                    !held.in_W.torque.isZero(0) || !held.moment.isZero(0);
  for (std::size_t i = 0; i < 3; ++i) {
    c_[i][0] = state.c[i];
    P_[i][0] = state.P[i];
    m_[i][0] = state.m[i];
  }
  for (std::size_t i = 0; i < 4; ++i) q_[i][0] = state.q[i];
  speed_ = {};
  for (Spring& spring : springs_) spring.length = {};
  for (int k = 0; k < order; ++k) extend(k);
}

void BodySeries::extend(int k) {
  for (std::size_t i = 0; i < 3; ++i) {
    omega_[i][at(k)] = 0;
    for (std::size_t j = 0; j < 3; ++j) omega_[i][at(k)] += inv_J_[i][j] * m_[j][at(k)];
    v_[i][at(k)] = P_[i][at(k)] / body_.mass;
  }
  if (needs_rotation_) extend_rotation(k);
  for (std::size_t s = 0; s < springs_.size(); ++s) extend_spring(body_.springs[s], springs_[s], k);
  const Quad3 F = force_W(k), tau = torque_B(k);

  const Quad n = k + 1;
  for (int i = 0; i < 3; ++i) {
    c_[at(i)][at(k + 1)] = v_[at(i)][at(k)] / n;
    P_[at(i)][at(k + 1)] = F[at(i)] / n;
    const Quad gyroscopic =
        cross(i, [&](int a, int b) { return product(m_[at(a)], omega_[at(b)], k); });
    m_[at(i)][at(k + 1)] = (gyroscopic + tau[at(i)]) / n;
    const Quad vector = product(q_[3], omega_[at(i)], k) + cross(i, [&](int a, int b) {
                          return product(q_[at(a)], omega_[at(b)], k);
                        });
    q_[at(i)][at(k + 1)] = vector / (2 * n);
  }
  Quad scalar = 0;
  for (std::size_t i = 0; i < 3; ++i) scalar -= product(q_[i], omega_[i], k);
  q_[3][at(k + 1)] = scalar / (2 * n);
}

void BodySeries::extend_rotation(int k) {
  const auto p = [&](std::size_t i, std::size_t j) { return product(q_[i], q_[j], k); };
  const Quad xx = p(0, 0), yy = p(1, 1), zz = p(2, 2), ww = p(3, 3);
  const Quad xy = p(0, 1), xz = p(0, 2), yz = p(1, 2), wx = p(3, 0), wy = p(3, 1), wz = p(3, 2);
  const Quad33 R = {{{ww + xx - yy - zz, 2 * (xy - wz), 2 * (xz + wy)},
                     {2 * (xy + wz), ww - xx + yy - zz, 2 * (yz - wx)},
                     {2 * (xz - wy), 2 * (yz + wx), ww - xx - yy + zz}}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) R_[i][j][at(k)] = R[i][j];
}

Quad3 BodySeries::force_W(int k) {
  Quad3 F{};
  if (body_.drag_quadratic != 0) speed_.extend(v_, k);
  for (int i = 0; i < 3; ++i) {
    Quad& f = F[at(i)];
    if (k == 0) f = Quad(body_.mass) * body_.gravity[i] + body_.held.in_W.force[i];
    if (needs_rotation_)
      for (int j = 0; j < 3; ++j) f += R_[at(i)][at(j)][at(k)] * body_.held.in_B.force[j];
    f -= body_.drag_linear * v_[at(i)][at(k)];
    if (body_.drag_quadratic != 0)
      f -= body_.drag_quadratic * product(speed_.series(), v_[at(i)], k);
    for (const Spring& spring : springs_) f += spring.force_W[at(i)][at(k)];
  }
  return F;
}

Quad3 BodySeries::torque_B(int k) {
  Quad3 tau{};
  const Mat3& M = body_.held.moment;
  for (int i = 0; i < 3; ++i) {
    Quad& t = tau[at(i)];
    if (k == 0) t = body_.held.in_B.torque[i];
    t -= body_.drag_angular * omega_[at(i)][at(k)];
    if (!needs_rotation_) continue;
    for (int j = 0; j < 3; ++j) t += R_[at(j)][at(i)][at(k)] * body_.held.in_W.torque[j];
    // Σ p × Rᵀ F is the axial vector of M R, M = Σ p Fᵀ.
    t += cross(i, [&](int a, int b) {
      Quad sum = 0;
      for (int l = 0; l < 3; ++l) sum += M(a, l) * R_[at(l)][at(b)][at(k)];
      return sum;
    });
    for (std::size_t s = 0; s < springs_.size(); ++s)
      t += cross(i, [&](int a, int b) {
        Quad force_B = 0;
        for (std::size_t l = 0; l < 3; ++l)
          force_B += product(R_[l][at(b)], springs_[s].force_W[l], k);
        return body_.springs[s].point_B[a] * force_B;
      });
  }
  return tau;
}

void BodySeries::extend_spring(const ReferenceSpring& def, Spring& spring, int k) {
  for (int i = 0; i < 3; ++i)
    spring.lever_rate[at(i)][at(k)] =
        cross(i, [&](int a, int b) { return omega_[at(a)][at(k)] * def.point_B[b]; });
  for (int i = 0; i < 3; ++i) {
    Quad x = c_[at(i)][at(k)], rate = v_[at(i)][at(k)];
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
  const Series& d = spring.length.series();
  for (std::size_t i = 0; i < 3; ++i) {
    Quad rest = spring.x[i][at(k)];
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

bool BodySeries::fits(double h, double tolerance) const {
  const auto decays = [&](const auto& x) {
    double power = 1, largest = 0, last = 0;
    for (int k = 0; k <= order_; ++k, power *= h) {
      double term = 0;
      for (const Series& component : x)
        term = std::max(term, std::abs(static_cast<double>(component[at(k)])) * power);
      largest = std::max(largest, term);
      if (k >= order_ - 1) last = std::max(last, term);
    }
    return last <= tolerance * largest;
  };
  return decays(c_) && decays(P_) && decays(m_) && decays(q_);
}

double BodySeries::step(double tolerance) const {
  constexpr double kLongest = 64, kShortest = 1e-9;  // [s]
  double h = kLongest;
  while (h > kShortest && !fits(h, tolerance)) h *= 0.85;
  return std::max(h, kShortest);
}

QuadState BodySeries::state_at(Quad h) const {
  QuadState state;
  for (std::size_t i = 0; i < 3; ++i) {
    state.c[i] = value(c_[i], order_, h);
    state.P[i] = value(P_[i], order_, h);
    state.m[i] = value(m_[i], order_, h);
  }
  for (std::size_t i = 0; i < 4; ++i) state.q[i] = value(q_[i], order_, h);
  state.q = normalized(state.q);
  return state;
}

Quad3 BodySeries::momentum_B_at(Quad h) const {
  return {value(m_[0], order_, h), value(m_[1], order_, h), value(m_[2], order_, h)};
}

}  // namespace poinsot::test
