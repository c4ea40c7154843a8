#include "poinsot/simulation/embedded_pair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

// Rows that a step's error is measured in: c, q, P, m.
constexpr Eigen::Index kMotion = 13;

double norm3(const SystemState& y, Eigen::Index row, Eigen::Index i) {
  return y.block<3, 1>(row, i).norm();
}

}  // namespace

double relative_error(const System& system, const SystemState& from, const SystemState& to,
                      const SystemState& rate, const SystemState& error, double h,
                      double tolerance) {
  // What a step may be off by whatever the tolerance: rounding of the coordinates, in m and rad.
  constexpr double kRounding = 1e-14, kTiny = 1e-300;
  if (!error.allFinite() || !to.allFinite()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (Eigen::Index i = 0; i < system.size(); ++i) {
    const SystemBody& body = system.bodies[static_cast<std::size_t>(i)];
    const auto scale = [&](Eigen::Index row, double least) {
      return std::max({norm3(from, row, i), norm3(to, row, i), h * norm3(rate, row, i), least});
    };
    const double step_rounding = kRounding / (h * tolerance);
    const double least_P = step_rounding * body.mass * norm3(from, 0, i);
    const double least_m = step_rounding / std::max(body.inv_J_B.norm(), kTiny);
    largest = std::max({largest, norm3(error, 0, i) / scale(0, kTiny),
                        norm3(error, 7, i) / scale(7, std::max(least_P, kTiny)),
                        norm3(error, 10, i) / scale(10, std::max(least_m, kTiny)),
                        2 * error.block<4, 1>(3, i).norm()});
  }
  return largest;
}

void EmbeddedRungeKutta::prepare(Eigen::Index n) {
  k_.resize(16);
  for (SystemState& k : k_) k.resize(17, n);
  for (SystemState* s : {&stage_, &end_, &error_, &error3_}) s->resize(17, n);
}

// out = y + h Σ weight k, over the columns that y has.
void EmbeddedRungeKutta::combine(const SystemState& y, double h, EmbeddedPair::Row row,
                                 SystemState& out) const {
  const Eigen::Index size = y.size();
  const double* const from = y.data();
  double* const to = out.data();
  std::fill(to, to + size, 0.0);
  for (const EmbeddedPair::Term& term : row) {
    const double* const k = k_[static_cast<std::size_t>(term.stage)].data();
    for (Eigen::Index e = 0; e < size; ++e) to[e] += term.weight * k[e];
  }
  for (Eigen::Index e = 0; e < size; ++e) to[e] = from[e] + h * to[e];
}

void EmbeddedRungeKutta::step(const EmbeddedPair& pair, const System& system, const SystemState& y,
                              double h) {
  system.derivative(y, k_[0]);
  std::size_t s = 1;
  for (const EmbeddedPair::Row row : pair.stages) {
    combine(y, h, row, stage_);
    system.derivative(stage_, k_[s++]);
  }
  combine(y, h, pair.solution, end_);
  system.derivative(end_, k_[s]);
}

double EmbeddedRungeKutta::error_of_step(const EmbeddedPair& pair, const System& system,
                                         const SystemState& y, double h, double tolerance) {
  const auto measure = [&](EmbeddedPair::Row row, SystemState& error) {
    combine(y, h, row, error);
    error.leftCols(y.cols()) -= y;
    return relative_error(system, y, end_, k_[0], error, h, tolerance);
  };
  const double error = measure(pair.error, error_);
  if (pair.error3.empty()) return error;
  const double error3 = measure(pair.error3, error3_);
  const double both = std::sqrt(error * error + 0.01 * error3 * error3);
  if (!(both > 0)) return both;
  // Of both estimates: the fifth-order one, lowered as the third shows how fast they fall.
  error_ *= error / both;
  return error * error / both;
}

// The largest rate of the system in the step, from f at two states near its end.
bool EmbeddedRungeKutta::looks_stiff(const EmbeddedPair& pair, double h) const {
  constexpr double kRounding = 1e-9;
  const std::size_t last = pair.stages.size();
  double rates = 0, states = 0, size = 0;
  for (Eigen::Index i = 0; i < end_.cols(); ++i) {
    const auto rows = Eigen::seqN(0, kMotion);
    rates += (k_[last + 1](rows, i) - k_[last](rows, i)).squaredNorm();
    states += (end_(rows, i) - stage_(rows, i)).squaredNorm();
    size += end_(rows, i).squaredNorm();
  }
  return states > kRounding * kRounding * size && h * std::sqrt(rates / states) > pair.stiff;
}

bool EmbeddedRungeKutta::advance(const EmbeddedPair& pair, const System& system, SystemState& y,
                                 double duration, double tolerance, int most_steps,
                                 StepMemory& memory, LocalError& error, double& done) {
  constexpr double kSafety = 0.9;
  constexpr int kStiffSteps = 15;
  const double exponent = 1.0 / (pair.error_order + 1) - 0.75 * pair.beta;
  if (!(memory.h > 0)) memory.h = duration;
  bool rejected = false;
  for (int steps = 0; done < duration; ++steps) {
    if (steps >= most_steps) return false;
    const double left = duration - done;
    const bool last = memory.h >= left * (1 - 1e-9);
    const double h = last ? left : memory.h;
    step(pair, system, y, h);
    const double ratio = error_of_step(pair, system, y, h, tolerance) / tolerance;
    if (!std::isfinite(ratio)) {
      if (h < 1e-12 * duration) return false;
      memory.h = h * pair.least_factor;
      rejected = true;
      continue;
    }
    // Below: growth of the step as a power of the error, and of the one before.
    const double now = ratio > 0 ? power(ratio, exponent) : 0;
    const double divisor = std::clamp(now / power(memory.last_error, pair.beta) / kSafety,
                                      1 / pair.most_factor, 1 / pair.least_factor);
    if (ratio > 1) {
      memory.h = h / std::min(1 / pair.least_factor, now / kSafety);
      rejected = true;
      continue;
    }
    const bool stiff = looks_stiff(pair, h);
    memory.stiff_steps = stiff ? memory.stiff_steps + 1 : 0;
    memory.last_error = std::max(ratio, 1e-4);
    const double next = rejected ? std::min(h, h / divisor) : h / divisor;
    if (!last || next > memory.h) memory.h = next;  // a step cut short by the end tells little
    rejected = false;
    LocalError of_step;
    for (Eigen::Index i = 0; i < y.cols(); ++i)
      of_step.raise_to({norm3(error_, 0, i), 2 * error_.block<4, 1>(3, i).norm()});
    error += of_step;
    y = end_.leftCols(y.cols());
    normalize_orientations(y);
    done = last ? duration : done + h;
    if (memory.stiff_steps >= kStiffSteps) {
      memory.stiff = true;
      return done >= duration;
    }
  }
  return true;
}

void EmbeddedRungeKutta::dense(const EmbeddedPair& pair, const System& system, const SystemState& y,
                               double h, double theta, SystemState& at) {
  std::size_t s = pair.stages.size() + 2;
  for (const EmbeddedPair::Row row : pair.extra) {
    combine(y, h, row, stage_);
    system.derivative(stage_, k_[s++]);
  }
  const SystemState& f_begin = k_[0];
  const SystemState& f_end = k_[pair.stages.size() + 1];
  // Nested in θ and 1 − θ: y + θ (Δ + (1 − θ) (b₁ + θ (b₂ + (1 − θ) (…)))).
  SystemState sum = SystemState::Zero(17, y.cols());
  for (std::size_t d = pair.dense.size(); d-- > 0;) {
    combine(y, h, pair.dense[d], stage_);
    sum = (sum + stage_.leftCols(y.cols()) - y) * (d % 2 == 0 ? 1 - theta : theta);
  }
  const SystemState delta = end_.leftCols(y.cols()) - y;
  sum = (sum + 2 * delta - h * (f_end + f_begin).leftCols(y.cols())) * theta;
  sum = (sum + h * f_begin.leftCols(y.cols()) - delta) * (1 - theta);
  at = y + theta * (sum + delta);
  normalize_orientations(at);
}

}  // namespace poinsot
