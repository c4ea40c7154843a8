#include "poinsot/simulation/taylor.h"

#include <algorithm>
#include <cmath>

#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

// Coefficient k of a product of two series.
template <class A, class B>
double dot_product(const A& a, const B& b, std::size_t k) {
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
    body.R[0].topRows<3>() = q.normalized().toRotationMatrix();
    body.R[0].row(3).setZero();
    body.P[0] = y.block<3, 1>(7, i);
    body.m[0] = y.block<3, 1>(10, i);
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
    if (!add_spring(system.springs[s], springs_[s], k)) return false;
  return true;
}

// c′ = P/M and n′ = n × ω of each row n of R.
void TaylorSeries::move_on(const SystemBody& body, Body& series, std::size_t k) {
  series.omega[k] = body.inv_J_B * series.m[k];
  series.c[k + 1] = (body.inv_mass * inverse_of_next(k)) * series.P[k];
  Rows sum = Rows::Zero();
  for (std::size_t j = 0; j <= k; ++j) {
    const Rows& R = series.R[j];
    const Vec3& w = series.omega[k - j];
    sum.col(0) += w.z() * R.col(1) - w.y() * R.col(2);
    sum.col(1) += w.x() * R.col(2) - w.z() * R.col(0);
    sum.col(2) += w.y() * R.col(0) - w.x() * R.col(1);
  }
  series.R[k + 1] = inverse_of_next(k) * sum;
}

void TaylorSeries::add_push(const SystemBody& body, Body& series, std::size_t k) {
  Vec3& force = series.force[k];
  Vec3& torque = series.torque[k];
  Vec3& H = series.H[k + 1];
  force.setZero();
  torque.setZero();
  H.setZero();
  if (!body.pushed_in_B) return;
  const Mat3 R = series.R[k].topRows<3>();
  const Wrench turning = body.push.turning(R);
  force = turning.force;
  H = inverse_of_next(k) * turning.torque;
  torque = R.transpose() * body.push.in_W.torque;
  for (int i = 0; i < 3; ++i) torque += Vec3(body.push.moment.col(i)).cross(Vec3(R.row(i)));
  if (k == 0) {
    torque += body.push.in_B.torque;
    H += body.push.in_W.torque;
  }
}

bool TaylorSeries::add_drag(const SystemBody& body, Body& series, std::size_t k) {
  const DragDef& drag = body.drag;
  const double inv_mass = body.inv_mass;
  series.force[k] -= (drag.linear * inv_mass) * series.P[k];
  if (drag.quadratic > 0) {
    series.speed_squared[k] = inv_mass * inv_mass * dot_product(series.P, series.P, k);
    if (k == 0 && !(series.speed_squared[0] > 0)) return false;  // |v| has no series there
    series.speed[k] = square_root(series.speed_squared, series.speed, k);
    for (std::size_t j = 0; j <= k; ++j)
      series.force[k] -= (drag.quadratic * inv_mass * series.speed[j]) * series.P[k - j];
  }
  if (drag.angular > 0) {
    series.torque[k] -= drag.angular * series.omega[k];
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j <= k; ++j) sum += series.R[j].topRows<3>() * series.omega[k - j];
    series.H[k + 1] -= (drag.angular * inverse_of_next(k)) * sum;
  }
  return true;
}

// P′ = F, m′ = m × ω + τ, W′ = F·v + τ·ω; a force constant in W has done F·Δc.
void TaylorSeries::add_up(const SystemBody& body, Body& series, std::size_t k) {
  const double scale = inverse_of_next(k);
  Vec3 sum = series.torque[k];
  for (std::size_t j = 0; j <= k; ++j) sum += series.m[j].cross(series.omega[k - j]);
  series.m[k + 1] = scale * sum;
  series.P[k + 1] = scale * series.force[k];
  series.W[k + 1] = body.push.in_W.force.dot(series.c[k + 1]);
  if (k == 0) series.P[1] += body.weight + body.push.in_W.force;
  if (!body.pushed_in_B && !body.dragged) return;
  series.W[k + 1] += scale * (body.inv_mass * dot_product(series.force, series.P, k) +
                              dot_product(series.torque, series.omega, k));
}

void TaylorSeries::separate(const SpringLink& link, Spring& spring, std::size_t k) const {
  const Body& a = series_[static_cast<std::size_t>(link.a)];
  spring.lever_a[k] = a.R[k].topRows<3>() * link.p_a;
  spring.d[k] = a.c[k] + spring.lever_a[k];
  if (link.b == SpringLink::kWorld) {
    if (k == 0) spring.d[k] -= link.p_b;
  } else {
    const Body& b = series_[static_cast<std::size_t>(link.b)];
    spring.lever_b[k] = b.R[k].topRows<3>() * link.p_b;
    spring.d[k] -= b.c[k] + spring.lever_b[k];
  }
  if (!link.is_linear()) spring.squared[k] = dot_product(spring.d, spring.d, k);
}

// F = −(stiffness (1 − rest/r) + damping (d·d′)/r²) d on a, and its opposite on b.
bool TaylorSeries::add_spring(const SpringLink& link, Spring& s, std::size_t k) {
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
  pull(link.a, link.p_a, s.lever_a, s.force, 1, k);
  if (link.b != SpringLink::kWorld) pull(link.b, link.p_b, s.lever_b, s.force, -1, k);
  return true;
}

void TaylorSeries::pull(int index, const Vec3& p, const Series<Vec3>& lever,
                        const Series<Vec3>& force, double sign, std::size_t k) {
  Body& body = series_[static_cast<std::size_t>(index)];
  const double scale = sign * inverse_of_next(k);
  body.P[k + 1] += scale * force[k];
  if (p.isZero(0)) return;
  Vec3 in_B = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t j = 0; j <= k; ++j) {
    in_B += body.R[j].topRows<3>().transpose() * force[k - j];
    moment += lever[j].cross(force[k - j]);
  }
  body.m[k + 1] += scale * p.cross(in_B);
  body.H[k + 1] += scale * moment;
}

void TaylorSeries::expand(const System& system, const SystemState& y, int order) {
  start(system, y);
  for (order_ = 0; order_ < order; ++order_) add_order(system, order_);
}

void TaylorSeries::evaluate(const System& system, double h, SystemState& y) const {
  const auto sum = [&](const auto& series) {
    auto value = series[static_cast<std::size_t>(order_)];
    for (int k = order_ - 1; k >= 0; --k) value = series[static_cast<std::size_t>(k)] + h * value;
    return value;
  };
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    const Body& body = series_[static_cast<std::size_t>(i)];
    const Eigen::Vector4d before = y.block<4, 1>(3, i);
    y.block<3, 1>(0, i) = sum(body.c);
    y.block<3, 1>(7, i) = sum(body.P);
    y.block<3, 1>(10, i) = sum(body.m);
    y(13, i) = sum(body.W);
    y.block<3, 1>(14, i) = sum(body.H);
    const Quat q(Mat3(sum(body.R).template topRows<3>()));
    y.block<4, 1>(3, i) = (q.coeffs().dot(before) < 0 ? -1 : 1) / q.norm() * q.coeffs();
  }
}

LocalError TaylorSeries::last_terms(const System& system, double h) const {
  LocalError error;
  const double factor = whole_power(std::abs(h), order_);
  const auto k = static_cast<std::size_t>(order_);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    error.raise_to({factor * series_[i].c[k].norm(), factor * series_[i].R[k].norm()});
  return error;
}

// What errors of P and m are relative to: their own size, what the forces add in h, and for P the
// momentum that moves the body by a rounding of its coordinates.
void TaylorSeries::find_scales(const System& system, const SystemState& y, double h) {
  constexpr double kRounding = 2e-16;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const Body& body = series_[i];
    const double P = y.block<3, 1>(7, column).norm(), m = y.block<3, 1>(10, column).norm();
    const double resolution =
        system.bodies[i].mass * kRounding * y.block<3, 1>(0, column).norm() / h;
    scales_[i] = {std::max({P, h * body.P[1].norm(), resolution, 1e-300}),
                  std::max({m, h * body.m[1].norm(), 1e-300})};
  }
}

// The terms of order k at h, against the scales; a turn counts as it is [rad].
double TaylorSeries::relative_term(const System& system, int order, double h) const {
  const auto k = static_cast<std::size_t>(order);
  double largest = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const Body& body = series_[i];
    largest = std::max({largest, body.R[k].norm(), body.P[k].norm() / scales_[i].P,
                        body.m[k].norm() / scales_[i].m});
  }
  return largest * whole_power(h, order);
}

bool TaylorSeries::advance(const System& system, SystemState& y, double duration, double tolerance,
                           int most_steps, LocalError& error) {
  double left = duration;
  LocalError sum;
  while (left > 0) {
    start(system, y);
    double last = 1, before = 1;
    for (order_ = 0; order_ < kMaxOrder;) {
      if (!add_order(system, order_)) return false;
      ++order_;
      if (order_ == 1) find_scales(system, y, left);
      before = last;
      last = relative_term(system, order_, left);
      if (order_ >= 2 && last <= tolerance && before <= tolerance) break;
    }
    double h = left;
    if (!(last <= tolerance && before <= tolerance)) {
      const double shrink = std::min(allowed(tolerance / last, kMaxOrder),
                                     allowed(tolerance / before, kMaxOrder - 1));
      h = 0.95 * left * std::min(1.0, shrink);
      if (!(h * most_steps > duration)) return false;
    }
    evaluate(system, h, y);
    sum += last_terms(system, h);
    left -= h;
  }
  error += sum;
  return true;
}

}  // namespace poinsot
