#include "poinsot/contact/normal_impulses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace poinsot {
namespace {

constexpr double kShift = 1e-9;  // ε, of a matrix with unit diagonal
constexpr double kLeastShift = 1e-13;
constexpr int kShiftSteps = 6;  // proximal steps before ε is made smaller
constexpr int kProximalSteps = 48;
constexpr double kNoise = 1e-14;    // of the numbers that cancel: below it nothing is infeasible
constexpr double kSettled = 4e-15;  // the same for the end of the proximal steps
constexpr int kPatience = 3;        // block exchanges without progress before Murty's

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void NormalImpulses::factor() {
  pushing_.clear();
  for (Eigen::Index i = 0; i < n_; ++i)
    if (pushes_[at(i)]) pushing_.push_back(static_cast<int>(i));
  const std::size_t m = pushing_.size();
  factor_.resize(at(n_ * n_));
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = j; i < m; ++i) {
      double sum = N_[at(pushing_[i]) + at(pushing_[j] * n_)] + (i == j ? shift_ : 0);
      for (std::size_t k = 0; k < j; ++k) sum -= factor_[i * m + k] * factor_[j * m + k];
      // The shift is far above rounding, so the pivot is positive.
      factor_[i * m + j] =
          i == j ? std::sqrt(std::max(sum, shift_ * shift_)) : sum / factor_[j * m + j];
    }
  }
  factored_ = true;
}

void NormalImpulses::solve_pushing() {
  const std::size_t m = pushing_.size();
  column_.resize(at(n_));
  for (std::size_t i = 0; i < m; ++i) {
    double sum = -target_[at(pushing_[i])];
    for (std::size_t k = 0; k < i; ++k) sum -= factor_[i * m + k] * column_[k];
    column_[i] = sum / factor_[i * m + i];
  }
  for (std::size_t i = m; i-- > 0;) {
    double sum = column_[i];
    for (std::size_t k = i + 1; k < m; ++k) sum -= factor_[k * m + i] * column_[k];
    column_[i] = sum / factor_[i * m + i];
  }
  std::fill(lambda_.begin(), lambda_.end(), 0.0);
  for (std::size_t i = 0; i < m; ++i) lambda_[at(pushing_[i])] = column_[i];
}

bool NormalImpulses::exchange() {
  Eigen::Index wrong = 0, last = -1;
  for (Eigen::Index i = 0; i < n_; ++i) {
    bool bad = false;
    if (pushes_[at(i)]) {
      bad = lambda_[at(i)] < 0;
    } else {
      double w = target_[at(i)], size = std::abs(w);
      for (const int j : pushing_) {
        const double term = N_[at(i + j * n_)] * lambda_[at(j)];
        w += term;
        size += std::abs(term);
      }
      bad = w < -kNoise * size;
    }
    w_[at(i)] = bad ? 1 : 0;
    if (!bad) continue;
    ++wrong;
    last = i;
  }
  if (wrong == 0) return true;
  bool blocks = true;
  if (wrong < fewest_) {
    fewest_ = wrong;
    patience_ = kPatience;
  } else if (patience_ > 0) {
    --patience_;
  } else {
    blocks = false;
  }
  for (Eigen::Index i = 0; i < n_; ++i)
    if (w_[at(i)] > 0 && (blocks || i == last)) pushes_[at(i)] = pushes_[at(i)] ? 0 : 1;
  factored_ = false;
  return false;
}

bool NormalImpulses::pivot() {
  fewest_ = n_ + 1;
  patience_ = kPatience;
  const Eigen::Index limit = 200 + 20 * n_;
  for (Eigen::Index round = 0; round < limit; ++round) {
    if (!factored_) factor();
    solve_pushing();
    if (exchange()) return true;
  }
  return false;
}

bool NormalImpulses::settled() const {
  for (Eigen::Index i = 0; i < n_; ++i) {
    if (!pushes_[at(i)]) continue;
    double size = std::abs(u_[at(i)]);
    for (const int j : pushing_) size += std::abs(N_[at(i + j * n_)] * lambda_[at(j)]);
    if (shift_ * std::abs(lambda_[at(i)] - previous_[at(i)]) > kSettled * size) return false;
  }
  return true;
}

bool NormalImpulses::solve(Eigen::Index n, const double* N, const double* u, double* lambda) {
  n_ = n;
  for (std::vector<double>* v : {&scale_, &u_, &target_, &lambda_, &previous_, &w_})
    v->assign(at(n), 0.0);
  pushes_.assign(at(n), 0);
  N_.resize(at(n * n));
  for (Eigen::Index i = 0; i < n; ++i) scale_[at(i)] = 1 / std::sqrt(N[i + i * n]);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      N_[at(i + j * n)] = i == j ? 1.0 : scale_[at(i)] * N[i + j * n] * scale_[at(j)];
  for (Eigen::Index i = 0; i < n; ++i) {
    u_[at(i)] = scale_[at(i)] * u[i];
    pushes_[at(i)] = u[i] < 0 ? 1 : 0;
  }
  factored_ = false;
  shift_ = kShift;
  // Once settled, one step more costs little and takes out what is below the mark.
  bool done = false, ended = false;
  for (int step = 0; step < kProximalSteps && !ended; ++step) {
    // Directions that N hardly sees (masses far apart) take many steps unless ε is small.
    if (step > 0 && step % kShiftSteps == 0 && shift_ > kLeastShift) {
      shift_ *= 0.1;
      factored_ = false;
    }
    for (Eigen::Index i = 0; i < n; ++i) target_[at(i)] = u_[at(i)] - shift_ * previous_[at(i)];
    if (!pivot()) {
      lambda_ = previous_;
      break;
    }
    ended = done;
    done = done || settled();
    previous_ = lambda_;
  }
  for (Eigen::Index i = 0; i < n; ++i) lambda[i] = scale_[at(i)] * std::max(0.0, lambda_[at(i)]);
  return done;
}

}  // namespace poinsot
