#include "poinsot/contact/shift_acceleration.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace poinsot {
namespace {

// [-] of the largest square: what makes the least squares of nearly parallel errors definite.
constexpr double kRidge = 1e-14;
constexpr double kWorse = 2;  // [-] growth of the error that ends trust in what was remembered

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

double dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace

void ShiftAcceleration::load(std::size_t points) {
  for (Memory& memory : memory_) {
    memory.speed.resize(points);
    memory.error.resize(points);
  }
  shifts_.resize(points);
  restart();
}

void ShiftAcceleration::restart(bool still) {
  filled_ = 0;
  still_ = still;
  first_ = true;
}

void ShiftAcceleration::choose_shifts(NewtonProblem& problem) {
  const std::size_t n = problem.points.size();
  if (first_) {
    for (NewtonPoint& p : problem.points) p.shift = p.joint || still_ ? 0.0 : p.speed;
    first_ = false;
    return;
  }
  newest_ = (newest_ + 1) % (kDepth + 1);
  filled_ = std::min(filled_ + 1, kDepth + 1);
  Memory& now = memory_[at(newest_)];
  for (std::size_t i = 0; i < n; ++i) {
    const NewtonPoint& p = problem.points[i];
    const bool slides = !p.joint && p.friction > 0 && p.start[0] > 0;
    now.speed[i] = p.joint ? 0.0 : p.speed;
    now.error[i] = slides ? p.speed - p.shift : 0.0;
  }
  const double error = std::sqrt(dot(now.error, now.error));
  if (!still_ && filled_ > 1 && error > kWorse * last_error_) filled_ = 1;
  last_error_ = error;
  combine();
  for (std::size_t i = 0; i < n; ++i) problem.points[i].shift = std::max(0.0, shifts_[i]);
}

// The newest speeds, less the combination of differences to older ones that leaves least error.
void ShiftAcceleration::combine() {
  using Square = Eigen::Matrix<double, kDepth, kDepth>;
  using Column = Eigen::Matrix<double, kDepth, 1>;
  const Memory& now = memory_[at(newest_)];
  shifts_ = now.speed;
  const int count = filled_ - 1;
  if (count < 1 || !(last_error_ > 0)) return;
  const auto older = [&](int k) -> const Memory& {
    return memory_[at((newest_ + kDepth - k) % (kDepth + 1))];
  };
  Square products = Square::Identity();
  Column right = Column::Zero();
  for (int i = 0; i < count; ++i) {
    const std::vector<double>& e = older(i).error;
    right[i] = dot(now.error, now.error) - dot(e, now.error);
    for (int j = 0; j <= i; ++j) {
      double sum = 0;
      const std::vector<double>& f = older(j).error;
      for (std::size_t q = 0; q < e.size(); ++q)
        sum += (now.error[q] - e[q]) * (now.error[q] - f[q]);
      products(i, j) = products(j, i) = sum;
    }
  }
  const double ridge = kRidge * products.topLeftCorner(count, count).trace();
  for (int i = 0; i < count; ++i) products(i, i) += ridge;
  const Column weights = products.ldlt().solve(right);
  if (!std::isfinite(weights.sum())) return;
  for (int i = 0; i < count; ++i) {
    const Memory& then = older(i);
    for (std::size_t q = 0; q < shifts_.size(); ++q)
      shifts_[q] -= weights[i] * (now.speed[q] - then.speed[q]);
  }
}

}  // namespace poinsot
