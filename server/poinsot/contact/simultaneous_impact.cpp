#include "poinsot/contact/simultaneous_impact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace poinsot {
namespace {

constexpr double kApproach = 1e-12;  // of the magnitudes that cancel; slower is not an approach
constexpr double kFaded = 1e-9;      // the same for reflections that only fade away
constexpr double kNoneHeld = 0;      // a threshold that every restitution reaches
constexpr int kPasses = 64;          // of reflections, and two more a point
constexpr int kGrowths = 8;          // of the set of points an inelastic impact presses on

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void SimultaneousImpact::start() {
  const Eigen::Index n = system_->points;
  q_.assign(at(3 * n), 0.0);
  v_.assign(system_->u, system_->u + 3 * n);
  scale_.resize(at(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    scale_[at(i)] = 0;
    for (Eigen::Index k = 0; k < 3; ++k)
      scale_[at(i)] = std::max(scale_[at(i)], std::abs(v_[at(3 * i + k)]));
  }
}

bool SimultaneousImpact::find_approaching(double threshold) {
  members_.clear();
  bool any = false;
  faded_ = true;
  for (Eigen::Index i = 0; i < system_->points; ++i) {
    const double un = v_[at(3 * i + 2)], size = scale_[at(i)];
    const bool approaches = un < -kApproach * size;
    const bool held = un <= kApproach * size && system_->restitution[i] < threshold;
    if (approaches || held) members_.push_back(static_cast<int>(i));
    any = any || approaches;
    faded_ = faded_ && un >= -kFaded * size;
  }
  return any;
}

void SimultaneousImpact::gather() {
  const auto m = static_cast<Eigen::Index>(members_.size());
  const MatrixView A = system_->inverse_mass();
  part_A_.resize(at(9 * m * m));
  part_N_.resize(at(m * m));
  part_friction_.resize(at(m));
  for (std::vector<double>* v : {&part_u_, &part_p_}) v->resize(at(3 * m));
  for (std::vector<double>* v : {&part_un_, &lambda_}) v->resize(at(m));
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::Index from = 3 * members_[at(j)];
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index row = 3 * members_[at(i)];
      for (Eigen::Index l = 0; l < 3; ++l)
        for (Eigen::Index k = 0; k < 3; ++k)
          part_A_[at(3 * i + k + (3 * j + l) * 3 * m)] = A(row + k, from + l);
      part_N_[at(i + j * m)] = A(row + 2, from + 2);
    }
    for (Eigen::Index k = 0; k < 3; ++k) part_u_[at(3 * j + k)] = v_[at(from + k)];
    part_un_[at(j)] = v_[at(from + 2)];
    part_friction_[at(j)] = system_->friction[members_[at(j)]];
  }
  part_ = {m, part_A_.data(), part_u_.data(), nullptr, part_friction_.data()};
}

double SimultaneousImpact::energy(const std::vector<double>& p) const {
  const VectorView q(p.data(), 3 * part_.points);
  return q.dot(part_.speed()) + 0.5 * q.dot(part_.inverse_mass().lazyProduct(q));
}

void SimultaneousImpact::compress() {
  if (!normal_.solve(part_.points, part_N_.data(), part_un_.data(), lambda_.data()))
    result_.converged = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    part_p_[3 * i] = part_p_[3 * i + 1] = 0;
    part_p_[3 * i + 2] = lambda_[i];
  }
  if (!frictionless_ && !friction_.solve(part_, part_p_.data())) result_.converged = false;
  part_energy_ = energy(part_p_);
  if (part_energy_ > 0) {
    // Friction that was not found may gain: the way to it goes down first, if it goes down at all.
    const VectorView p(part_p_.data(), 3 * part_.points);
    const double slope = p.dot(part_.speed());
    const double factor = slope < 0 ? -slope / (part_energy_ - slope) : 0.0;
    for (double& x : part_p_) x *= factor;
    part_energy_ = std::min(0.0, energy(part_p_));
  }
}

void SimultaneousImpact::restore(double threshold) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const bool elastic = system_->restitution[members_[i]] >= threshold;
    part_p_[3 * i] = part_p_[3 * i + 1] = 0;
    if (!elastic) part_p_[3 * i + 2] = 0;
    for (std::size_t k = 0; k < 3; ++k) part_u_[3 * i + k] = v_[at(3 * members_[i]) + k];
  }
  if (!frictionless_ && !friction_.solve_tangential(part_, part_p_.data()))
    result_.converged = false;
  // No more comes back than compression took: a x² + b x = −part_energy_ at the largest x.
  const VectorView p(part_p_.data(), 3 * part_.points);
  const double b = p.dot(part_.speed()), a = energy(part_p_) - b;
  if (a + b + part_energy_ <= 0) return;
  const double root = std::sqrt(b * b - 4 * a * part_energy_);
  const double factor = b > 0 ? -2 * part_energy_ / (b + root) : (root - b) / (2 * a);
  for (double& x : part_p_) x *= std::min(factor, 1.0);
}

void SimultaneousImpact::add(double factor) {
  const MatrixView A = system_->inverse_mass();
  for (std::size_t j = 0; j < members_.size(); ++j) {
    for (std::size_t l = 0; l < 3; ++l) {
      const double p = factor * part_p_[3 * j + l];
      if (p == 0) continue;
      const Eigen::Index column = 3 * members_[j] + static_cast<Eigen::Index>(l);
      q_[at(column)] += p;
      for (Eigen::Index i = 0; i < system_->points; ++i) {
        for (Eigen::Index k = 0; k < 3; ++k) {
          const double change = A(3 * i + k, column) * p;
          v_[at(3 * i + k)] += change;
          if (k == 2) scale_[at(i)] += std::abs(change);
        }
      }
    }
  }
}

void SimultaneousImpact::end_approach() {
  members_.clear();
  for (Eigen::Index i = 0; i < system_->points; ++i) members_.push_back(static_cast<int>(i));
  gather();
  if (!normal_.solve(part_.points, part_N_.data(), part_un_.data(), lambda_.data()))
    result_.converged = false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    part_p_[3 * i] = part_p_[3 * i + 1] = 0;
    part_p_[3 * i + 2] = lambda_[i];
  }
  add(1.0);
}

void SimultaneousImpact::reflections(double threshold) {
  start();
  const int limit = kPasses + 2 * static_cast<int>(system_->points);
  for (int pass = 0; find_approaching(threshold); ++pass) {
    if (faded_ || pass == limit) {
      if (!faded_) result_.converged = false;
      end_approach();
      return;
    }
    ++result_.passes;
    gather();
    compress();
    add(1.0);
    restore(threshold);
    add(1.0);
    // What that presses on inelastic points ends there.
    if (!find_approaching(threshold)) return;
    std::erase_if(members_, [&](int i) { return system_->restitution[i] >= threshold; });
    if (members_.empty()) continue;
    gather();
    compress();
    add(1.0);
  }
}

// Starts from the points that approach and takes in those that the impact presses on.
void SimultaneousImpact::inelastic() {
  start();
  is_member_.assign(at(system_->points), 0);
  for (int growth = 0; find_approaching(kNoneHeld); ++growth) {
    if (frictionless_) {
      end_approach();
      return;
    }
    bool grown = false;
    for (const int i : members_) {
      grown = grown || !is_member_[at(i)];
      is_member_[at(i)] = 1;
    }
    if (!grown) {
      end_approach();
      return;
    }
    if (growth == kGrowths) std::fill(is_member_.begin(), is_member_.end(), char{1});
    members_.clear();
    for (Eigen::Index i = 0; i < system_->points; ++i)
      if (is_member_[at(i)]) members_.push_back(static_cast<int>(i));
    start();
    gather();
    compress();
    add(1.0);
  }
}

SimultaneousImpact::Result SimultaneousImpact::resolve(const ImpactSystem& system,
                                                       std::span<double> p) {
  system_ = &system;
  result_ = {};
  const Eigen::Index n = system.points;
  frictionless_ =
      std::all_of(system.friction, system.friction + n, [](double f) { return f <= 0; });
  levels_.assign(system.restitution, system.restitution + n);
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  std::fill(p.begin(), p.end(), 0.0);
  start();
  if (!find_approaching(kNoneHeld)) return result_;
  double below = 0;
  for (const double level : levels_) {
    if (level <= 0) continue;
    reflections(level);
    for (std::size_t k = 0; k < p.size(); ++k) p[k] += (level - below) * q_[k];
    below = level;
  }
  if (below < 1) {
    inelastic();
    for (std::size_t k = 0; k < p.size(); ++k) p[k] += (1 - below) * q_[k];
  }
  return result_;
}

}  // namespace poinsot
