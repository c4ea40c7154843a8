#include "poinsot/simulation/rosenbrock.h"

#include <algorithm>
#include <cmath>

#include "poinsot/math/elementary.h"

namespace poinsot {
namespace {

constexpr double kGamma = 0.25;
constexpr int kStages = 6;
// Stage s: (1/(γh) − J) gₛ = f(y + Σ aₛⱼ gⱼ) + Σ cₛⱼ gⱼ / h.
constexpr double kA[kStages][kStages] = {
    {},
    {0.1544000000000000e+01},
    {0.9466785280815826e+00, 0.2557011698983284e+00},
    {0.3314825187068521e+01, 0.2896124015972201e+01, 0.9986419139977817e+00},
    {0.1221224509226641e+01, 0.6019134481288629e+01, 0.1253708332932087e+02,
     -0.6878860361058950e+00},
    {0.1221224509226641e+01, 0.6019134481288629e+01, 0.1253708332932087e+02,
     -0.6878860361058950e+00, 1.0}};
constexpr double kC[kStages][kStages] = {
    {},
    {-0.5668800000000000e+01},
    {-0.2430093356833875e+01, -0.2063599157091915e+00},
    {-0.1073529058151375e+00, -0.9594562251023355e+01, -0.2047028614809616e+02},
    {0.7496443313967647e+01, -0.1024680431464352e+02, -0.3399990352819905e+02,
     0.1170890893206160e+02},
    {0.8083246795921522e+01, -0.7981132988064893e+01, -0.3152159432874371e+02,
     0.1631930543123136e+02, -0.6058818238834054e+01}};

// What a change of one entry is to be small against: its vector, or what that changes by in h.
double size_of(const SystemState& y, const SystemState& rate, Eigen::Index row, Eigen::Index i,
               double h) {
  if (row >= 3 && row < 7) return 1;
  const Eigen::Index first = row < 3 ? 0 : (row < 10 ? 7 : 10);
  return std::max(y.block<3, 1>(first, i).norm(), h * rate.block<3, 1>(first, i).norm());
}

Eigen::Map<Eigen::VectorXd> flat(SystemState& y) {
  return {y.data(), y.size()};
}

}  // namespace

void Rosenbrock::prepare(Eigen::Index n) {
  if (rate_.cols() == n) return;
  jacobian_.resize(17 * n, 17 * n);
  matrix_.resize(17 * n, 17 * n);
  solution_.resize(17 * n);
  factors_ = Eigen::PartialPivLU<Eigen::MatrixXd>(17 * n);
  g_.resize(kStages);
  for (SystemState& g : g_) g.resize(17, n);
  for (SystemState* s : {&rate_, &probe_, &end_, &error_}) s->resize(17, n);
}

// Column by column; nothing depends on W and H.
void Rosenbrock::differentiate(const System& system, const SystemState& y, double h) {
  constexpr double kStep = 1.5e-8;  // the square root of a rounding
  system.derivative(y, rate_);
  jacobian_.setZero();
  probe_ = y;
  SystemState& changed = g_[0];
  for (Eigen::Index i = 0; i < y.cols(); ++i)
    for (Eigen::Index row = 0; row < 13; ++row) {
      const double step = kStep * std::max(size_of(y, rate_, row, i, h), 1e-12);
      probe_(row, i) = y(row, i) + step;
      system.derivative(probe_, changed);
      probe_(row, i) = y(row, i);
      jacobian_.col(17 * i + row) = (flat(changed) - flat(rate_)) / step;
    }
}

// By way of another vector: to permute one in place Eigen allocates.
void Rosenbrock::solve(SystemState& stage) {
  solution_ = factors_.solve(flat(stage));
  flat(stage) = solution_;
}

void Rosenbrock::step(const System& system, const SystemState& y, double h) {
  differentiate(system, y, h);
  matrix_ = -jacobian_;
  matrix_.diagonal().array() += 1 / (kGamma * h);
  factors_.compute(matrix_);
  for (std::size_t s = 0; s < kStages; ++s) {
    SystemState& g = g_[s];
    if (s == 0) {
      g = rate_;
    } else {
      probe_ = y;
      for (std::size_t j = 0; j < s; ++j) probe_ += kA[s][j] * g_[j];
      system.derivative(probe_, g);
      for (std::size_t j = 0; j < s; ++j) g += (kC[s][j] / h) * g_[j];
    }
    solve(g);
  }
  error_ = g_[kStages - 1];
  end_ = probe_ + error_;
}

bool Rosenbrock::advance(const System& system, SystemState& y, double duration, double tolerance,
                         int most_steps, StepMemory& memory, LocalError& error, double& done) {
  if (!(memory.h > 0)) memory.h = duration;
  for (int steps = 0; done < duration; ++steps) {
    if (steps >= most_steps) return false;
    const double left = duration - done;
    const bool last = memory.h >= left * (1 - 1e-9);
    const double h = last ? left : memory.h;
    step(system, y, h);
    const double ratio = relative_error(system, y, end_, rate_, error_, h, tolerance) / tolerance;
    if (!std::isfinite(ratio) && h < 1e-12 * duration) return false;
    const double factor = std::isfinite(ratio)
                              ? (ratio > 0 ? std::clamp(0.9 / power(ratio, 0.25), 0.2, 6.0) : 6.0)
                              : 0.2;
    if (!(ratio <= 1)) {
      memory.h = h * std::min(factor, 0.9);
      continue;
    }
    if (!last || h * factor > memory.h) memory.h = h * factor;
    LocalError of_step;
    for (Eigen::Index i = 0; i < y.cols(); ++i)
      of_step.raise_to({error_.block<3, 1>(0, i).norm(), 2 * error_.block<4, 1>(3, i).norm()});
    error += of_step;
    y = end_;
    normalize_orientations(y);
    done = last ? duration : done + h;
  }
  return true;
}

}  // namespace poinsot
