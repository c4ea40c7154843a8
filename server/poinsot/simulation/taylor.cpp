#include "poinsot/simulation/taylor.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    SeriesBlock& first = body.at[0];
    const Quat q(y(6, i), y(3, i), y(4, i), y(5, i));
    const Mat3 R = q.normalized().toRotationMatrix();
    const double inv_mass = system.bodies[static_cast<std::size_t>(i)].inv_mass;
    for (Eigen::Index column = 0; column < 3; ++column) {
      double* const at = first.rows.data() + 4 * column;
      Eigen::Map<Vec3>{at} = R.col(column);
      at[3] = y(10 + column, i);
      first.v[static_cast<std::size_t>(column)] = inv_mass * y(7 + column, i);
      first.c_W[static_cast<std::size_t>(column)] = y(column, i);
      first.H[static_cast<std::size_t>(column)] = y(14 + column, i);
    }
    first.c_W[3] = y(13, i);
  }
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    separate(system.springs[s], springs_[s], 0);
}

// The same for all steps of an advance.
void TaylorSeries::bring(const System& system) {
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const SystemBody& body = system.bodies[i];
    SeriesBody& acts = series_[i].acts;
    for (Eigen::Index column = 0; column < 3; ++column) {
      Eigen::Map<Vec3>(acts.inv_J.data() + 4 * column) = body.inv_J_B.col(column);
      Eigen::Map<Vec3>(acts.moment.data() + 4 * column) = body.push.moment.col(column);
    }
    acts.inv_mass = body.inv_mass;
    Body::of(acts.push) = body.push.in_W.force;
    Body::of(acts.steady) = body.push.in_W.force + body.weight;
    Body::of(acts.couple_W) = body.push.in_W.torque;
    Body::of(acts.force_B) = body.push.in_B.force;
    Body::of(acts.torque_B) = body.push.in_B.torque;
    acts.couple_in_W = body.couple_in_W;
    acts.force_in_B = body.force_in_B;
    acts.torque_in_B = body.torque_in_B;
    acts.at_points = body.at_points;
    acts.works = body.pushed_in_B() || body.dragged;
  }
}

// From the coefficients of tᵏ of the state to those of tᵏ⁺¹.
bool TaylorSeries::add_order(const System& system, int order) {
  const auto k = static_cast<std::size_t>(order);
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    Body& body = series_[i];
    if (!system.bodies[i].dragged) {
      body.squares = kernels_.step(body.acts, body.at.data(), body.effort.data(), order);
      continue;
    }
    kernels_.push(body.acts, body.at.data(), body.effort.data(), order);
    if (!add_drag(system.bodies[i].drag, body, k)) return false;
    body.squares = kernels_.integrate(body.acts, body.at.data(), body.effort.data(), order);
  }
  for (std::size_t s = 0; s < system.springs.size(); ++s)
    if (!add_spring(system.springs[s], springs_[s], k)) return false;
  if (!system.springs.empty())
    for (std::size_t i = 0; i < system.bodies.size(); ++i)
      series_[i].squares = kernels_.squares(series_[i].at[k + 1]);
  return true;
}

bool TaylorSeries::add_drag(const DragDef& drag, Body& series, std::size_t k) {
  auto force = Body::of(series.effort[k].force);
  force -= drag.linear * series.v(k);
  if (drag.quadratic > 0) {
    double squared = 0;
    for (std::size_t j = 0; j <= k; ++j) squared += series.v(j).dot(series.v(k - j));
    series.speed_squared[k] = squared;
    if (k == 0 && !(squared > 0)) return false;  // |v| has no series there
    series.speed[k] = square_root(series.speed_squared, series.speed, k);
    for (std::size_t j = 0; j <= k; ++j)
      force -= (drag.quadratic * series.speed[j]) * series.v(k - j);
  }
  if (drag.angular > 0) {
    Body::of(series.effort[k].torque) -= drag.angular * series.omega(k);
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j <= k; ++j) sum += series.R(j) * series.omega(k - j);
    Body::of(series.at[k + 1].H) -= (drag.angular * inverse_of_next(k)) * sum;
  }
  return true;
}

void TaylorSeries::separate(const SpringLink& link, Spring& spring, std::size_t k) const {
  const Body& a = series_[static_cast<std::size_t>(link.a)];
  spring.lever_a[k] = a.R(k) * link.p_a;
  spring.d[k] = a.c(k) + spring.lever_a[k];
  if (link.b == SpringLink::kWorld) {
    if (k == 0) spring.d[k] -= link.p_b;
  } else {
    const Body& b = series_[static_cast<std::size_t>(link.b)];
    spring.lever_b[k] = b.R(k) * link.p_b;
    spring.d[k] -= b.c(k) + spring.lever_b[k];
  }
  if (!link.is_linear()) spring.squared[k] = dot_product(spring.d, spring.d, k);
}

// F = −stiffness d − damping d′ on a, and its opposite on b.
void TaylorSeries::add_linear(const SpringLink& link, Spring& s, std::size_t k) {
  s.force[k] = -link.stiffness * s.d[k];
  if (!(link.damping > 0)) return;
  const auto rate = [&](std::size_t j) -> Vec3 { return static_cast<double>(j + 1) * s.d[j + 1]; };
  s.force[k] -= link.damping * rate(k);
  double squared = 0;  // |d′|²
  for (std::size_t j = 0; j <= k; ++j) squared += rate(j).dot(rate(k - j));
  series_[static_cast<std::size_t>(link.a)].at[k + 1].c_W[3] -=
      inverse_of_next(k) * link.damping * squared;
}

// F = −(stiffness (1 − rest/r) + damping (d·d′)/r²) d on a, and its opposite on b.
bool TaylorSeries::add_spring(const SpringLink& link, Spring& s, std::size_t k) {
  separate(link, s, k + 1);  // d′ is needed too
  if (link.is_linear()) {
    add_linear(link, s, k);
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
      series_[static_cast<std::size_t>(link.a)].at[k + 1].c_W[3] -=
          inverse_of_next(k) * product(s.damping, s.closing, k);
  }
  pull(link.a, link.p_a, s.lever_a, s.force, 1, k);
  if (link.b != SpringLink::kWorld) pull(link.b, link.p_b, s.lever_b, s.force, -1, k);
  return true;
}

void TaylorSeries::Body::add_to_m(std::size_t k, const Vec3& rate) {
  for (std::size_t i = 0; i < 3; ++i) at[k].rows[4 * i + 3] += rate[static_cast<Eigen::Index>(i)];
}

void TaylorSeries::pull(int index, const Vec3& p, const Series<Vec3>& lever,
                        const Series<Vec3>& force, double sign, std::size_t k) {
  Body& body = series_[static_cast<std::size_t>(index)];
  const double scale = sign * inverse_of_next(k);
  Body::of(body.at[k + 1].v) += (scale * body.acts.inv_mass) * force[k];
  if (p.isZero(0)) return;
  Vec3 in_B = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t j = 0; j <= k; ++j) {
    in_B += body.R(j).transpose() * force[k - j];
    moment += lever[j].cross(force[k - j]);
  }
  body.add_to_m(k + 1, scale * p.cross(in_B));
  Body::of(body.at[k + 1].H) += scale * moment;
}

void TaylorSeries::expand(const System& system, const SystemState& y, int order) {
  bring(system);
  start(system, y);
  for (order_ = 0; order_ < order; ++order_) add_order(system, order_);
}

void TaylorSeries::evaluate(const System& system, double h, SystemState& y) const {
  SeriesBlock sum;
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    kernels_.evaluate(series_[static_cast<std::size_t>(i)].at.data(), order_, h, sum);
    const double mass = system.bodies[static_cast<std::size_t>(i)].mass;
    const Eigen::Vector4d before = y.block<4, 1>(3, i);
    Mat3 R;
    for (Eigen::Index column = 0; column < 3; ++column) {
      const double* const at = sum.rows.data() + 4 * column;
      const auto k = static_cast<std::size_t>(column);
      R.col(column) = Eigen::Map<const Vec3>(at);
      y(column, i) = sum.c_W[k];
      y(7 + column, i) = mass * sum.v[k];
      y(10 + column, i) = at[3];
      y(14 + column, i) = sum.H[k];
    }
    y(13, i) = sum.c_W[3];
    const Quat q(R);
    y.block<4, 1>(3, i) = (q.coeffs().dot(before) < 0 ? -1 : 1) / q.norm() * q.coeffs();
  }
}

LocalError TaylorSeries::last_terms(const System& system, double h) const {
  LocalError error;
  const double factor = whole_power(std::abs(h), order_);
  const auto k = static_cast<std::size_t>(order_);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    error.raise_to({factor * series_[i].c(k).norm(), factor * series_[i].R(k).norm()});
  return error;
}

// What errors of v and m are relative to: their own size, what the forces add in h, and for v the
// speed that moves the body by a rounding of its coordinates.
void TaylorSeries::find_scales(const System& system, double h) {
  constexpr double kRounding = 2e-16, kTiny = 1e-280;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const Body& body = series_[i];
    const double resolution = kRounding / h;
    const SeriesSquares first = kernels_.squares(body.at[0]), second = body.squares;
    scales_[i] = {1 / std::max({first.v, h * h * second.v,
                                resolution * resolution * body.c(0).squaredNorm(), kTiny}),
                  1 / std::max({first.m, h * h * second.m, kTiny})};
  }
  work_scale_ = work_scale(system, h);
}

// Power is a product of velocities: its series decays half as fast as theirs, and has to be watched
// by itself. Relative to the energy that may flow in h.
double TaylorSeries::work_scale(const System& system, double h) const {
  constexpr double kTiny = 1e-280;
  double energy = 0;
  bool damps = false;
  for (std::size_t s = 0; s < system.springs.size(); ++s) {
    const SpringLink& link = system.springs[s];
    damps = damps || (link.isotropic && link.damping > 0);
    energy += 0.5 * link.stiffness * springs_[s].d[0].squaredNorm();
  }
  if (!damps) return 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    energy += 0.5 * system.bodies[i].mass *
              std::max(kernels_.squares(series_[i].at[0]).v, h * h * series_[i].squares.v);
  return 1 / std::max(energy * energy, kTiny);
}

// The square of the latest coefficients against their scales; a turn counts as it is [rad].
double TaylorSeries::squared_term(const System& system) const {
  double largest = 0;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const SeriesSquares& square = series_[i].squares;
    const double v = square.v * scales_[i].v, m = square.m * scales_[i].m;
    if (!std::isfinite(square.R + v + m)) return std::numeric_limits<double>::infinity();
    largest = std::max({largest, square.R, v, m});
    if (work_scale_ > 0) {
      const double work = series_[i].at[static_cast<std::size_t>(order_)].c_W[3];
      largest = std::max(largest, work * work * work_scale_);
    }
  }
  return largest;
}

// A series of |v| goes on through zero to negative values; nature turns round.
bool TaylorSeries::passed_standstill(const System& system, double h, const SystemState& y) const {
  constexpr double kSame = 1e-6;
  for (std::size_t i = 0; i < system.bodies.size(); ++i) {
    const SystemBody& body = system.bodies[i];
    if (!(body.drag.quadratic > 0)) continue;
    double speed = series_[i].speed[static_cast<std::size_t>(order_) - 1];
    for (std::size_t k = static_cast<std::size_t>(order_) - 1; k-- > 0;)
      speed = series_[i].speed[k] + h * speed;
    const double actual = body.inv_mass * y.block<3, 1>(7, static_cast<Eigen::Index>(i)).norm();
    if (!(std::abs(speed - actual) <= kSame * std::max(actual, series_[i].speed[0]))) return true;
  }
  return false;
}

bool TaylorSeries::advance(const System& system, SystemState& y, double duration, double tolerance,
                           int most_steps, LocalError& error) {
  // The last term is the error of a series one order shorter: the one before may be larger.
  constexpr double kBefore = 100;
  const double limit = tolerance * tolerance, limit_before = kBefore * kBefore * limit;
  double left = duration;
  bring(system);
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
      last = squared_term(system) * h_power;
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
    if (passed_standstill(system, h, y)) return false;
    error += last_terms(system, h);
    left -= h;
  }
  return true;
}

}  // namespace poinsot
