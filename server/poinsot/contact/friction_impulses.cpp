#include "poinsot/contact/friction_impulses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace poinsot {
namespace {

constexpr double kShift = 1e-9;      // of Newton's matrix where it may be singular
constexpr double kRounding = 1e-14;  // relative residual taken as none
constexpr double kGood = 1e-9;       // relative residual still taken as found
constexpr double kFound = 1e-12;     // good enough to end the search
constexpr int kRounds = 8;           // projections, then Newton; twice as many the next time
constexpr int kFirstProjections = 4;
constexpr int kNewtonSteps = 14;
constexpr Eigen::Index kNewtonPoints = 64;  // more: projections alone, a matrix costs (3n)³
constexpr Eigen::Index kProjectionWork = 4'000'000;  // projections · points²

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

// LU with row exchanges, in place; x becomes the solution. False: singular.
bool solve_dense(Eigen::Index n, double* a, double* x) {
  const auto row = [n, a](Eigen::Index i) { return a + i * n; };
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (std::abs(row(i)[k]) > std::abs(row(pivot)[k])) pivot = i;
    if (!(std::abs(row(pivot)[k]) > 0)) return false;
    if (pivot != k) {
      std::swap_ranges(row(k), row(k) + n, row(pivot));
      std::swap(x[k], x[pivot]);
    }
    const double inverse = 1 / row(k)[k];
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const double factor = row(i)[k] * inverse;
      if (factor == 0) continue;
      for (Eigen::Index j = k + 1; j < n; ++j) row(i)[j] -= factor * row(k)[j];
      x[i] -= factor * x[k];
    }
  }
  for (Eigen::Index i = n; i-- > 0;) {
    for (Eigen::Index j = i + 1; j < n; ++j) x[i] -= row(i)[j] * x[j];
    x[i] /= row(i)[i];
  }
  return true;
}

}  // namespace

// Impulses and velocities of a point are scaled by √A_nn, so that masses far apart look alike.
void FrictionImpulses::prepare(const ImpactSystem& system, const double* p) {
  n_ = system.points;
  const Eigen::Index size = 3 * n_;
  friction_ = system.friction;
  const MatrixView A = system.inverse_mass();
  scale_.resize(at(n_));
  for (Eigen::Index i = 0; i < n_; ++i) scale_[at(i)] = 1 / std::sqrt(A(3 * i + 2, 3 * i + 2));
  A_.resize(at(size * size));
  start_.resize(at(size));
  p_.resize(at(size));
  for (Eigen::Index k = 0; k < size; ++k) {
    const double scale = scale_[at(k / 3)];
    for (Eigen::Index j = 0; j < size; ++j)
      A_[at(k * size + j)] = scale * A(k, j) * scale_[at(j / 3)];
    start_[at(k)] = scale * system.u[k];
    p_[at(k)] = p[k] / scale;
  }
  for (std::vector<double>* v : {&damped_n_, &damped_t_, &step_t_}) v->resize(at(n_));
  for (std::vector<double>* v : {&u_, &residual_, &kept_}) v->resize(at(size));
  for (Eigen::Index i = 0; i < n_; ++i) {
    // Steps no longer than the inverse of the row's sum of magnitudes never overshoot.
    double sum[3] = {0, 0, 0};
    for (Eigen::Index k = 0; k < 3; ++k)
      for (Eigen::Index j = 0; j < size; ++j) sum[k] += std::abs(A_[at((3 * i + k) * size + j)]);
    damped_n_[at(i)] = 1 / sum[2];
    damped_t_[at(i)] = 1 / std::max(sum[0], sum[1]);
    step_t_[at(i)] = 1 / (A_[at(3 * i * (size + 1))] + A_[at((3 * i + 1) * (size + 1))]);
  }
}

double FrictionImpulses::evaluate() {
  const Eigen::Index size = 3 * n_;
  double worst = 0;
  for (Eigen::Index i = 0; i < n_; ++i) {
    double magnitude = 0;
    for (Eigen::Index k = 3 * i; k < 3 * i + 3; ++k) {
      double sum = start_[at(k)], sizes = std::abs(sum);
      for (Eigen::Index j = 0; j < size; ++j) {
        const double term = A_[at(k * size + j)] * p_[at(j)];
        sum += term;
        sizes += std::abs(term);
      }
      u_[at(k)] = sum;
      magnitude = std::max(magnitude, sizes);
    }
    const Point now = project(i, 1.0, step_t_[at(i)]);
    const double normal = p_[at(3 * i + 2)] - now.n;
    residual_[at(3 * i + 2)] = normals_given_ ? 0 : normal;
    for (int k = 0; k < 2; ++k) residual_[at(3 * i + k)] = p_[at(3 * i + k)] - now.t[k];
    const double tangential =
        std::hypot(residual_[at(3 * i)], residual_[at(3 * i + 1)]) / step_t_[at(i)];
    const double here = std::max(std::abs(residual_[at(3 * i + 2)]), tangential);
    if (here > 0) worst = std::max(worst, here / magnitude);
    if (!std::isfinite(here)) return here;
  }
  return worst;
}

// Point i after a step against its velocity, cut back to its cone.
FrictionImpulses::Point FrictionImpulses::project(Eigen::Index i, double step_n,
                                                  double step_t) const {
  Point q;
  const double* p = &p_[at(3 * i)];
  const double* u = &u_[at(3 * i)];
  q.n = normals_given_ ? p[2] : std::max(0.0, p[2] - step_n * u[2]);
  q.limit = friction_[i] * q.n;
  for (int k = 0; k < 2; ++k) q.t[k] = p[k] - step_t * u[k];
  q.length = std::hypot(q.t[0], q.t[1]);
  q.slips = q.length > q.limit;
  if (q.slips)
    for (double& t : q.t) t *= q.limit / q.length;
  return q;
}

void FrictionImpulses::descend() {
  for (Eigen::Index i = 0; i < n_; ++i) {
    const Point q = project(i, damped_n_[at(i)], damped_t_[at(i)]);
    p_[at(3 * i)] = q.t[0];
    p_[at(3 * i + 1)] = q.t[1];
    p_[at(3 * i + 2)] = q.n;
  }
}

// The derivative of the residual, rows of stuck and closed points in velocity.
void FrictionImpulses::assemble() {
  const Eigen::Index size = 3 * n_;
  matrix_.assign(at(size * size), 0.0);
  const auto row = [&](Eigen::Index k) { return matrix_.data() + k * size; };
  const auto add = [&](double* to, Eigen::Index k, double factor) {
    const double* from = A_.data() + k * size;
    for (Eigen::Index j = 0; j < size; ++j) to[j] += factor * from[j];
    to[k] += factor * kShift * from[k];
  };
  for (Eigen::Index i = 0; i < n_; ++i) {
    const Eigen::Index t = 3 * i, n = 3 * i + 2;
    const double step = step_t_[at(i)];
    const Point q = project(i, 1.0, step);
    const bool open = q.n <= 0;
    if (open || normals_given_)
      row(n)[n] = 1;
    else
      add(row(n), n, 1.0);
    if (open || q.limit <= 0) {
      row(t)[t] = row(t + 1)[t + 1] = 1;
    } else if (!q.slips) {
      add(row(t), t, step);
      add(row(t + 1), t + 1, step);
    } else {
      // pt − μ y x/|x| with x = pt − step·ut, y = pn − un.
      const double x[2] = {q.t[0] / q.limit, q.t[1] / q.limit};
      const double ratio = q.limit / q.length;
      for (int k = 0; k < 2; ++k) {
        double* to = row(t + k);
        to[t + k] += 1;
        if (!normals_given_) {
          to[n] -= friction_[i] * x[k];
          add(to, n, friction_[i] * x[k]);
        }
        for (int l = 0; l < 2; ++l) {
          const double across = ratio * ((k == l ? 1 : 0) - x[k] * x[l]);
          to[t + l] -= across;
          add(to, t + l, across * step);
        }
      }
    }
  }
}

bool FrictionImpulses::newton() {
  double best = evaluate();
  kept_ = p_;
  for (int step = 0; step < kNewtonSteps; ++step) {
    assemble();
    if (!solve_dense(3 * n_, matrix_.data(), residual_.data())) break;
    for (std::size_t k = 0; k < p_.size(); ++k) p_[k] -= residual_[k];
    const double now = evaluate();
    if (!std::isfinite(now)) break;
    const bool better = now < best;
    if (better) {
      best = now;
      kept_ = p_;
    }
    if (best <= kRounding || (best <= kGood && !better)) break;
  }
  p_ = kept_;
  best_ = evaluate();
  return best_ <= kFound;
}

bool FrictionImpulses::run(const ImpactSystem& system, double* p, bool normals_given) {
  normals_given_ = normals_given;
  prepare(system, p);
  Eigen::Index projections = kFirstProjections, work = 0;
  bool found = false;
  for (int round = 0; round < kRounds && !found; ++round, projections *= 2) {
    best_ = evaluate();
    for (Eigen::Index k = 0; k < projections && best_ > kRounding; ++k) {
      descend();
      best_ = evaluate();
    }
    work += projections * n_ * n_;
    found = best_ <= kRounding || (n_ <= kNewtonPoints && newton());
    if (work > kProjectionWork) break;
  }
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double scale = scale_[at(i)];
    const double* q = &p_[at(3 * i)];
    if (!normals_given_) p[3 * i + 2] = scale * std::max(0.0, q[2]);
    const double length = scale * std::hypot(q[0], q[1]), limit = friction_[i] * p[3 * i + 2];
    const double cut = length > limit ? limit / length : 1.0;
    for (int k = 0; k < 2; ++k) p[3 * i + k] = cut * scale * q[k];
  }
  return found || best_ <= kGood;
}

bool FrictionImpulses::solve(const ImpactSystem& system, double* p) {
  return run(system, p, false);
}

bool FrictionImpulses::solve_tangential(const ImpactSystem& system, double* p) {
  return run(system, p, true);
}

}  // namespace poinsot
