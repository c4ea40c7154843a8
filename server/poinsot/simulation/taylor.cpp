#include "poinsot/simulation/taylor.h"

#include <algorithm>
#include <cmath>

#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

// Coefficient k of a product of two series.
template <class S>
double dot_product(const S& a, const S& b, std::size_t k) {
  double sum = 0;
  for (std::size_t j = 0; j <= k; ++j) sum += a[j].dot(b[k - j]);
  return sum;
}

template <class S>
double product(const S& a, const S& b, std::size_t k) {
  double sum = 0;
  for (std::size_t j = 0; j <= k; ++j) sum += a[j] * b[k - j];
  return sum;
}

// Coefficient k of the square root whose square is `squared`.
template <class S>
double square_root(const S& squared, const S& root, std::size_t k) {
  if (k == 0) return std::sqrt(squared[0]);
  double sum = squared[k];
  for (std::size_t j = 1; j < k; ++j) sum -= root[j] * root[k - j];
  return sum / (2 * root[0]);
}

template <class S>
double reciprocal(const S& a, const S& inverse, std::size_t k) {
  if (k == 0) return 1 / a[0];
  double sum = 0;
  for (std::size_t j = 1; j <= k; ++j) sum -= a[j] * inverse[k - j];
  return sum / a[0];
}

double whole_power(double x, int n) {
  double power = 1;
  for (; n > 0; --n) power *= x;
  return power;
}

// The fraction of a step for which a term of order n shrinks by `factor`.
double allowed(double factor, int n) {
  if (!(factor > 1e-300)) return 0;
  return factor < 1 ? power(factor, 1.0 / n) : 1;
}

double inverse_of_next(std::size_t k) {
  return 1 / static_cast<double>(k + 1);
}

}  // namespace

void TaylorSeries::prepare(std::size_t bodies, std::size_t springs) {
  series_.resize(std::max(series_.size(), bodies));
  scales_.resize(series_.size());
  springs_.resize(std::max(springs_.size(), springs));
}

void TaylorSeries::start(const System& system, const SystemState& y) {
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    Body& body = series_[static_cast<std::size_t>(i)];
    const Quat q(y(6, i), y(3, i), y(4, i), y(5, i));
    body.c[0] = y.block<3, 1>(0, i);
    body.block(0).topRows<3>() = q.normalized().toRotationMatrix();
    body.block(0).row(3) = y.block<3, 1>(10, i).transpose();
    body.v(0) = system.bodies[static_cast<std::size_t>(i)].inv_mass * y.block<3, 1>(7, i);
    body.W[0] = y(13, i);
    body.H[0] = y.block<3, 1>(14, i);
  }
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    separate(system.springs[s], springs_[s], 0);
}

// From the coefficients of tᵏ of the state to those of tᵏ⁺¹.
bool TaylorSeries::add_order(const System& system, int order) {
  const auto k = static_cast<std::size_t>(order);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const SystemBody& body = system.bodies[i];
    move_on(body, series_[i], k);
    add_push(body, series_[i], k);
    if (body.dragged && !add_drag(body, series_[i], k)) return false;
    add_up(body, series_[i], k);
  }
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    if (!add_spring(system, system.springs[s], springs_[s], k)) return false;
  return true;
}

// c′ = v, and n′ = n × ω of each row n of R and of m.
void TaylorSeries::move_on(const SystemBody& body, Body& series, std::size_t k) const {
  series.omega(k) = body.inv_J_B * series.m(k);
  series.c[k + 1] = inverse_of_next(k) * series.v(k);
  kernels_.cross(series.rows[0].data(), series.flow[0].data(), static_cast<int>(k),
                 series.rows[k + 1].data());
  series.block(k + 1) *= inverse_of_next(k);
}

// A force F constant in W is Σ Fᵢ nᵢ in B, and its moment at p is Σ Fᵢ p × nᵢ: linear in R.
void TaylorSeries::add_push(const SystemBody& body, Body& series, std::size_t k) {
  auto force = series.force(k);
  auto torque = series.torque(k);
  Vec3& H = series.H[k + 1];
  force.setZero();
  torque.setZero();
  H.setZero();
  const auto R = series.R(k);
  const HeldWrench& push = body.push;
  if (body.force_in_B) force = R * push.in_B.force;
  if (body.couple_in_W) torque = R.transpose() * push.in_W.torque;
  if (body.torque_in_B) H = inverse_of_next(k) * (R * push.in_B.torque);
  if (body.at_points) {
    for (int i = 0; i < 3; ++i) torque += Vec3(push.moment.col(i)).cross(Vec3(R.row(i)));
    const Mat3 moment = R * push.moment;
    H += inverse_of_next(k) * axial(moment);
  }
  if (k == 0) {
    torque += push.in_B.torque;
    H += push.in_W.torque;
  }
}

bool TaylorSeries::add_drag(const SystemBody& body, Body& series, std::size_t k) {
  const DragDef& drag = body.drag;
  series.force(k) -= drag.linear * series.v(k);
  if (drag.quadratic > 0) {
    double squared = 0;
    for (std::size_t j = 0; j <= k; ++j) squared += series.v(j).dot(series.v(k - j));
    series.speed_squared[k] = squared;
    if (k == 0 && !(squared > 0)) return false;  // |v| has no series there
    series.speed[k] = square_root(series.speed_squared, series.speed, k);
    for (std::size_t j = 0; j <= k; ++j)
      series.force(k) -= (drag.quadratic * series.speed[j]) * series.v(k - j);
  }
  if (drag.angular > 0) {
    series.torque(k) -= drag.angular * series.omega(k);
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j <= k; ++j) sum += series.R(j) * series.omega(k - j);
    series.H[k + 1] -= (drag.angular * inverse_of_next(k)) * sum;
  }
  return true;
}

// v′ = F/M, m′ = m × ω + τ, W′ = F·v + τ·ω; a force constant in W has done F·Δc.
void TaylorSeries::add_up(const SystemBody& body, Body& series, std::size_t k) const {
  const double scale = inverse_of_next(k);
  series.block(k + 1).row(3) += scale * series.torque(k).transpose();
  series.v(k + 1) = (scale * body.inv_mass) * series.force(k);
  if (k == 0) series.v(1) += body.inv_mass * (body.weight + body.push.in_W.force);
  series.W[k + 1] = body.push.in_W.force.dot(series.c[k + 1]);
  if (!body.pushed_in_B() && !body.dragged) return;
  series.W[k + 1] +=
      scale * kernels_.dot(series.effort[0].data(), series.flow[0].data(), static_cast<int>(k));
}

void TaylorSeries::separate(const SpringLink& link, Spring& spring, std::size_t k) const {
  const Body& a = series_[static_cast<std::size_t>(link.a)];
  spring.lever_a[k] = a.R(k) * link.p_a;
  spring.d[k] = a.c[k] + spring.lever_a[k];
  if (link.b == SpringLink::kWorld) {
    if (k == 0) spring.d[k] -= link.p_b;
  } else {
    const Body& b = series_[static_cast<std::size_t>(link.b)];
    spring.lever_b[k] = b.R(k) * link.p_b;
    spring.d[k] -= b.c[k] + spring.lever_b[k];
  }
  if (!link.is_linear()) spring.squared[k] = dot_product(spring.d, spring.d, k);
}

// F = −(stiffness (1 − rest/r) + damping (d·d′)/r²) d on a, and its opposite on b.
bool TaylorSeries::add_spring(const System& system, const SpringLink& link, Spring& s,
                              std::size_t k) {
  separate(link, s, k + 1);  // d′ is needed too
  if (link.is_linear()) {
    s.force[k] = -link.stiffness * s.d[k];
  } else {
    if (k == 0 && !(s.squared[0] > 0)) return false;  // no direction
    s.length[k] = square_root(s.squared, s.length, k);
    s.inverse[k] = reciprocal(s.length, s.inverse, k);
    s.inverse_squared[k] = product(s.inverse, s.inverse, k);
    s.closing[k] = 0.5 * static_cast<double>(k + 1) * s.squared[k + 1];  // d·d′
    s.damping[k] = link.damping * product(s.closing, s.inverse_squared, k);
    s.factor[k] = s.damping[k] - link.stiffness * link.rest * s.inverse[k];
    if (k == 0) s.factor[0] += link.stiffness;
    s.force[k].setZero();
    for (std::size_t j = 0; j <= k; ++j) s.force[k] -= s.factor[j] * s.d[k - j];
    if (link.damping > 0)
      series_[static_cast<std::size_t>(link.a)].W[k + 1] -=
          inverse_of_next(k) * product(s.damping, s.closing, k);
  }
  pull(system, link.a, link.p_a, s.lever_a, s.force, 1, k);
  if (link.b != SpringLink::kWorld) pull(system, link.b, link.p_b, s.lever_b, s.force, -1, k);
  return true;
}

void TaylorSeries::pull(const System& system, int index, const Vec3& p, const Series<Vec3>& lever,
                        const Series<Vec3>& force, double sign, std::size_t k) {
  const auto i = static_cast<std::size_t>(index);
  Body& body = series_[i];
  const double scale = sign * inverse_of_next(k);
  body.v(k + 1) += (scale * system.bodies[i].inv_mass) * force[k];
  if (p.isZero(0)) return;
  Vec3 in_B = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t j = 0; j <= k; ++j) {
    in_B += body.R(j).transpose() * force[k - j];
    moment += lever[j].cross(force[k - j]);
  }
  body.block(k + 1).row(3) += scale * p.cross(in_B).transpose();
  body.H[k + 1] += scale * moment;
}

void TaylorSeries::expand(const System& system, const SystemState& y, int order) {
  start(system, y);
  for (order_ = 0; order_ < order; ++order_) add_order(system, order_);
}

void TaylorSeries::evaluate(const System& system, double h, SystemState& y) const {
  const auto sum = [&](const auto& coefficient) {
    auto value = coefficient(static_cast<std::size_t>(order_));
    for (int k = order_ - 1; k >= 0; --k)
      value = coefficient(static_cast<std::size_t>(k)) + h * value;
    return value;
  };
  using Rows = Eigen::Matrix<double, 4, 3>;
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    const Body& body = series_[static_cast<std::size_t>(i)];
    const Rows rows = sum([&](std::size_t k) -> Rows { return ConstBlock(body.rows[k].data()); });
    const Vec3 v = sum([&](std::size_t k) -> Vec3 {
      return {body.flow[k][0], body.flow[k][1], body.flow[k][2]};
    });
    const Eigen::Vector4d before = y.block<4, 1>(3, i);
    const Quat q(Mat3(rows.topRows<3>()));
    y.block<3, 1>(0, i) = sum([&](std::size_t k) { return body.c[k]; });
    y.block<4, 1>(3, i) = (q.coeffs().dot(before) < 0 ? -1 : 1) / q.norm() * q.coeffs();
    y.block<3, 1>(7, i) = system.bodies[static_cast<std::size_t>(i)].mass * v;
    y.block<3, 1>(10, i) = rows.row(3).transpose();
    y(13, i) = sum([&](std::size_t k) { return body.W[k]; });
    y.block<3, 1>(14, i) = sum([&](std::size_t k) { return body.H[k]; });
  }
}

LocalError TaylorSeries::last_terms(const System& system, double h) const {
  LocalError error;
  const double factor = whole_power(std::abs(h), order_);
  const auto k = static_cast<std::size_t>(order_);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    error.raise_to({factor * series_[i].c[k].norm(), factor * series_[i].R(k).norm()});
  return error;
}

// What errors of v and m are relative to: their own size, what the forces add in h, and for v the
// speed that moves the body by a rounding of its coordinates.
void TaylorSeries::find_scales(const System& system, double h) {
  constexpr double kRounding = 2e-16, kTiny = 1e-280;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    Body& body = series_[i];
    const double resolution = kRounding / h;
    const double v = std::max({body.v(0).squaredNorm(), h * h * body.v(1).squaredNorm(),
                               resolution * resolution * body.c[0].squaredNorm(), kTiny});
    const double m = std::max({body.m(0).squaredNorm(), h * h * body.m(1).squaredNorm(), kTiny});
    scales_[i] = {1 / v, 1 / m};
  }
}

// The square of the coefficients of order k against their scales; a turn counts as it is [rad].
double TaylorSeries::squared_term(const System& system, int order) const {
  const auto k = static_cast<std::size_t>(order);
  double largest = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const auto& rows = series_[i].rows[k];
    const auto& flow = series_[i].flow[k];
    const double turn = rows[0] * rows[0] + rows[1] * rows[1] + rows[2] * rows[2] +
                        rows[4] * rows[4] + rows[5] * rows[5] + rows[6] * rows[6] +
                        rows[8] * rows[8] + rows[9] * rows[9] + rows[10] * rows[10];
    const double m = rows[3] * rows[3] + rows[7] * rows[7] + rows[11] * rows[11];
    const double v = flow[0] * flow[0] + flow[1] * flow[1] + flow[2] * flow[2];
    largest = std::max({largest, turn, v * scales_[i].v, m * scales_[i].m});
  }
  return largest;
}

bool TaylorSeries::advance(const System& system, SystemState& y, double duration, double tolerance,
                           int most_steps, LocalError& error) {
  // The last term is the error of a series one order shorter: the one before may be larger.
  constexpr double kBefore = 100;
  const double limit = tolerance * tolerance, limit_before = kBefore * kBefore * limit;
  double left = duration;
  while (left > 0) {
    start(system, y);
    double last = 1, before = 1;  // squares of terms at `left`
    double h_power = 1;
    bool done = false;
    for (order_ = 0; order_ < kMaxOrder && !done;) {
      if (!add_order(system, order_)) return false;
      ++order_;
      h_power *= left * left;
      if (order_ == 1) find_scales(system, left);
      before = last;
      last = squared_term(system, order_) * h_power;
      done = order_ >= 2 && last <= limit && before <= limit_before;
    }
    double h = left;
    if (!done) {
      const double shrink = std::min(allowed(limit / last, 2 * kMaxOrder),
                                     allowed(limit_before / before, 2 * (kMaxOrder - 1)));
      h = 0.95 * left * shrink;
      if (!(h * most_steps > duration)) return false;
    }
    evaluate(system, h, y);
    error += last_terms(system, h);
    left -= h;
  }
  return true;
}

}  // namespace poinsot
