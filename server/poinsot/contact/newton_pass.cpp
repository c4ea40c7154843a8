#include "poinsot/contact/newton_pass.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

// [-] A factorisation serves on while directions of sliding differ by less from those it is of.
constexpr double kSameDirection = 1e-3;
constexpr double kSameStiffness = 0.1;  // [-] likewise, across the sliding
// [-] of the slope at the start, that ends a line search.
constexpr double kFlat = 1e-2;
constexpr int kMaxTrials = 40;
// [-] A step so short has met a point that is about to change its region and is too stiff to be
// passed: R grows for the rest of the pass, up to a limit beside inverse effective masses.
constexpr double kShortStep = 0.05, kSofter = 10, kSoftest = 1e-2;
// [-] of the residual: what predictions differ by when the pass has come to its end.
constexpr double kSettled = 1e-2;
constexpr double kWholeStep = 0.9;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

Mat3 skew(const Vec3& r) {
  Mat3 m;
  m << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0;
  return m;
}

// Rows of a wrench about `from` seen about a centre at from − d: [1 0; d× 1] block.
BlockLdlt::Block shift_rows(const BlockLdlt::Block& block, const Mat3& d) {
  BlockLdlt::Block result = block;
  result.bottomRows<3>().noalias() += d * block.topRows<3>();
  return result;
}

BlockLdlt::Block shift_columns(const BlockLdlt::Block& block, const Mat3& d) {
  BlockLdlt::Block result = block;
  result.rightCols<3>().noalias() -= block.leftCols<3>() * d;  // dᵀ = −d
  return result;
}

Vec3 place_of(const NewtonPoint& p, const NewtonProblem& problem) {
  return p.a != kFixed ? problem.bodies[at(p.a)].c + p.arm_a : problem.bodies[at(p.b)].c + p.arm_b;
}

// R λ₀ − (velocity − target). A sliding point's speed cancels its shift; what is left is found from
// their differences.
ConeArgument argument_of(const NewtonPoint& p, const ConeScale& scale, const Vec3& moved) {
  ConeArgument z;
  z.normal = scale.normal * p.start[0] - (p.velocity[0] - p.target[0]) - moved[0];
  const double change[2] = {scale.tangent * p.start[1] - moved[1],
                            scale.tangent * p.start[2] - moved[2]};
  for (int k = 0; k < 2; ++k) z.tangent[k] = change[k] - p.velocity[k + 1];
  z.shift = p.shift;
  const double length = std::sqrt(z.tangent[0] * z.tangent[0] + z.tangent[1] * z.tangent[1]);
  const double gained =
      change[0] * (z.tangent[0] - p.velocity[1]) + change[1] * (z.tangent[1] - p.velocity[2]);
  const double both = length + p.speed;
  z.excess = (both > 0 ? gained / both : 0.0) + (p.speed - p.shift);
  return z;
}

// Which region the point is in as impulses and velocities stand, each weighed alike; the impulse is
// that of the region's own law, be it in the cone or not.
ConeImpulse guess_of(const NewtonPoint& p) {
  const ConeScale alike = ConeScale::of(p.w_normal, p.w_tangent);
  const Vec3 still = Vec3::Zero();
  ConeImpulse cone = nearest_in_cone(argument_of(p, alike, still), p.friction, alike);
  const ConeArgument z = argument_of(p, p.scale, still);
  const double upright = z.normal - p.friction * z.shift;
  if (cone.region == ConeImpulse::Region::kStick)
    cone.impulse = Vec3(p.scale.inverse_normal * upright, p.scale.inverse_tangent * z.tangent[0],
                        p.scale.inverse_tangent * z.tangent[1]);
  if (cone.region != ConeImpulse::Region::kSlide) return cone;
  cone.along = 1 / (p.scale.normal + p.friction * p.friction * p.scale.tangent);
  const double length = std::sqrt(z.tangent[0] * z.tangent[0] + z.tangent[1] * z.tangent[1]);
  const double normal = (z.normal + p.friction * z.excess) * cone.along;
  cone.impulse[0] = normal;
  for (int k = 0; k < 2; ++k) {
    cone.direction[k] = length > 0 ? z.tangent[k] / length : 0.0;
    cone.impulse[k + 1] = p.friction * normal * cone.direction[k];
  }
  cone.across =
      length > 0 ? std::min(p.friction * p.start[0] / length, p.scale.inverse_tangent) : 0.0;
  return cone;
}

bool differs(const ConeImpulse& now, const ConeImpulse& then) {
  if (now.region != then.region) return true;
  if (now.region != ConeImpulse::Region::kSlide) return false;
  return std::abs(now.direction[0] - then.direction[0]) > kSameDirection ||
         std::abs(now.direction[1] - then.direction[1]) > kSameDirection ||
         std::abs(now.across - then.across) > kSameStiffness * then.across;
}

}  // namespace

void NewtonPass::load(const NewtonProblem& problem) {
  iterations = factorisations = 0;
  const std::size_t n = problem.bodies.size(), m = problem.points.size();
  bool same = keys_.size() == m;
  keys_.resize(m);
  for (std::size_t i = 0; i < m; ++i) {
    const NewtonPoint& p = problem.points[i];
    const Key key{std::min(p.a, p.b), std::max(p.a, p.b), static_cast<int>(i)};
    same = same && key.a == keys_[i].a && key.b == keys_[i].b;
    keys_[i] = key;
  }
  if (!same) group_points();
  for (std::size_t i = m; i-- > 0;)
    groups_[at(group_of_[i])].reference = place_of(problem.points[i], problem);
  system_.analyse(static_cast<int>(n), pairs_);
  change_.resize(6 * n);
  gradient_.resize(6 * n);
  step_.resize(6 * n);
  factorised_softness_ = 0;
}

void NewtonPass::group_points() {
  sorted_ = keys_;
  std::ranges::sort(sorted_, [](const Key& x, const Key& y) {
    return std::array{x.a, x.b, x.point} < std::array{y.a, y.b, y.point};
  });
  groups_.clear();
  pairs_.clear();
  group_of_.resize(keys_.size());
  for (const Key& key : sorted_) {
    if (groups_.empty() || groups_.back().a != key.a || groups_.back().b != key.b) {
      Group& group = groups_.emplace_back();
      group.a = key.a;
      group.b = key.b;
      group.coupling = kFixed;
      if (key.a != kFixed) {
        group.coupling = static_cast<int>(pairs_.size());
        pairs_.push_back({key.a, key.b});
      }
    }
    group_of_[at(key.point)] = static_cast<int>(groups_.size()) - 1;
  }
}

// M x − Jᵀ(λ − λ₀); returns the largest velocity it amounts to.
double NewtonPass::find_gradient(const NewtonProblem& problem) {
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const NewtonBody& body = problem.bodies[i];
    const Eigen::Map<const Vec6> x(change_.data() + 6 * i);
    Eigen::Map<Vec6> g(gradient_.data() + 6 * i);
    g.head<3>() = body.mass * x.head<3>();
    g.tail<3>().noalias() = body.J * x.tail<3>();
  }
  for (const NewtonPoint& p : problem.points) {
    const Vec3 impulse = p.frame * (p.cone.impulse - p.start);
    if (p.a != kFixed) {
      Eigen::Map<Vec6> g(gradient_.data() + 6 * at(p.a));
      g.head<3>() -= impulse;
      g.tail<3>() -= p.arm_a.cross(impulse);
    }
    if (p.b != kFixed) {
      Eigen::Map<Vec6> g(gradient_.data() + 6 * at(p.b));
      g.head<3>() += impulse;
      g.tail<3>() += p.arm_b.cross(impulse);
    }
  }
  double largest = 0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const NewtonBody& body = problem.bodies[i];
    const Eigen::Map<const Vec6> g(gradient_.data() + 6 * i);
    const Vec3 turn = body.inv_J * g.tail<3>();
    largest = std::max(largest, body.inv_mass * g.head<3>().norm() + body.reach * turn.norm());
  }
  return largest;
}

bool NewtonPass::is_stale(const NewtonProblem& problem) const {
  if (factorised_softness_ != problem.softness()) return true;
  for (std::size_t i = 0; i < factorised_.size(); ++i)
    if (differs(problem.points[i].cone, factorised_[i])) return true;
  return false;
}

void NewtonPass::assemble(NewtonProblem& problem) {
  ++factorisations;
  factorised_softness_ = problem.softness();
  factorised_.resize(problem.points.size());
  for (Group& group : groups_) group.sum.setZero();
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const NewtonPoint& p = problem.points[i];
    factorised_[i] = p.cone;
    Group& group = groups_[at(group_of_[i])];
    if (!p.joint && p.cone.region == ConeImpulse::Region::kOpen) continue;
    const Mat3 X = skew(place_of(p, problem) - group.reference);
    const Mat3 S =
        p.joint ? Mat3(p.scale.inverse_normal * Mat3::Identity())
                : Mat3(p.frame * p.cone.stiffness(p.scale, p.friction) * p.frame.transpose());
    const Mat3 XS = X * S;
    group.sum.topLeftCorner<3, 3>() += S;
    group.sum.bottomLeftCorner<3, 3>() += XS;
    group.sum.bottomRightCorner<3, 3>().noalias() -= XS * X;
  }
  system_.clear();
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    BlockLdlt::Map block = system_.diagonal(static_cast<int>(i));
    block.diagonal().head<3>().setConstant(problem.bodies[i].mass);
    block.bottomRightCorner<3, 3>() = problem.bodies[i].J;
  }
  for (Group& group : groups_) {
    group.sum.topRightCorner<3, 3>() = group.sum.bottomLeftCorner<3, 3>().transpose();
    const NewtonBody& b = problem.bodies[at(group.b)];
    const Mat3 d_b = skew(group.reference - b.c);
    const BlockLdlt::Block right = shift_columns(group.sum, d_b);
    system_.diagonal(group.b) += shift_rows(right, d_b);
    if (group.coupling == kFixed) continue;
    const NewtonBody& a = problem.bodies[at(group.a)];
    const Mat3 d_a = skew(group.reference - a.c);
    system_.add_coupling(group.coupling, -shift_rows(right, d_a));
    system_.diagonal(group.a) += shift_rows(shift_columns(group.sum, d_a), d_a);
  }
  system_.factorise();
}

void NewtonPass::find_step(NewtonProblem& problem) {
  std::ranges::transform(gradient_, step_.begin(), [](double g) { return -g; });
  system_.solve(step_);
  inertia_slope_ = inertia_curvature_ = descent_ = 0;
  for (std::size_t i = 0; i < problem.bodies.size(); ++i) {
    const NewtonBody& body = problem.bodies[i];
    const Eigen::Map<const Vec6> x(change_.data() + 6 * i), p(step_.data() + 6 * i);
    const Eigen::Map<const Vec6> g(gradient_.data() + 6 * i);
    const Vec3 turn = body.J * p.tail<3>();
    inertia_slope_ += body.mass * x.head<3>().dot(p.head<3>()) + x.tail<3>().dot(turn);
    inertia_curvature_ += body.mass * p.head<3>().squaredNorm() + p.tail<3>().dot(turn);
    descent_ += g.dot(p);
  }
  for (NewtonPoint& p : problem.points) {
    Vec3 relative = Vec3::Zero();
    if (p.a != kFixed) {
      const Eigen::Map<const Vec6> x(step_.data() + 6 * at(p.a));
      relative += x.head<3>() + x.tail<3>().cross(p.arm_a);
    }
    if (p.b != kFixed) {
      const Eigen::Map<const Vec6> x(step_.data() + 6 * at(p.b));
      relative -= x.head<3>() + x.tail<3>().cross(p.arm_b);
    }
    p.step.noalias() = p.frame.transpose() * relative;
  }
}

// Of the objective along the step; leaves the points' cones there.
double NewtonPass::slope(NewtonProblem& problem, double length) {
  double sum = inertia_slope_ + length * inertia_curvature_;
  for (NewtonPoint& p : problem.points) {
    const Vec3 moved = p.moved + length * p.step;
    if (p.joint)
      p.cone.impulse = p.start - p.scale.inverse_normal * (p.velocity - p.target + moved);
    else
      p.cone = nearest_in_cone(argument_of(p, p.scale, moved), p.friction, p.scale);
    sum += p.step.dot(p.start - p.cone.impulse);
  }
  return sum;
}

double NewtonPass::curvature(const NewtonProblem& problem) const {
  double sum = inertia_curvature_;
  for (const NewtonPoint& p : problem.points) {
    if (p.joint)
      sum += p.scale.inverse_normal * p.step.squaredNorm();
    else if (p.cone.region != ConeImpulse::Region::kOpen)
      sum += p.step.dot(p.cone.stiffness(p.scale, p.friction) * p.step);
  }
  return sum;
}

// The root of the slope, which grows with the length: Newton's method within a bracket.
double NewtonPass::search(NewtonProblem& problem) {
  const double flat = kFlat * std::abs(descent_);
  double low = 0, high = 0;  // high: 0 while unknown
  double length = 1;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    const double value = slope(problem, length);
    if (std::abs(value) <= flat) break;
    (value < 0 ? low : high) = length;
    double next = length - value / curvature(problem);
    if (high > 0 && !(next > low && next < high)) next = 0.5 * (low + high);
    if (high == 0) next = std::clamp(next, 1.1 * length, 4 * length);
    if (next == length) break;
    length = next;
  }
  return length;
}

// The trial impulses that go with the whole step if no region of a cone changed, normals first
// brought into the cones.
void NewtonPass::predict(NewtonProblem& problem) const {
  for (NewtonPoint& p : problem.points) {
    if (p.joint) {
      p.trial = p.cone.impulse - p.scale.inverse_normal * p.step;
      continue;
    }
    p.trial = p.cone.impulse;
    if (p.cone.region == ConeImpulse::Region::kOpen) continue;
    p.trial -= p.cone.stiffness(p.scale, p.friction) * p.step;
    p.trial[0] = std::max(0.0, p.trial[0]);
    const double limit = p.friction * p.trial[0];
    const double length = std::sqrt(p.trial[1] * p.trial[1] + p.trial[2] * p.trial[2]);
    if (length > limit) p.trial.tail<2>() *= limit / length;
  }
}

void NewtonPass::start(NewtonProblem& problem) {
  std::ranges::fill(change_, 0.0);
  for (NewtonPoint& p : problem.points) {
    p.moved.setZero();
    p.step.setZero();
  }
  inertia_slope_ = inertia_curvature_ = 0;
}

// Along minus the gradient; how far the predicted impulses are from the law.
SolveResidual NewtonPass::take_step(NewtonProblem& problem) {
  if (is_stale(problem)) assemble(problem);
  find_step(problem);
  ++iterations;
  predict(problem);
  return problem.follow_trial();
}

SolveResidual NewtonPass::guess(NewtonProblem& problem) {
  start(problem);
  for (NewtonPoint& p : problem.points) {
    if (p.joint)
      p.cone.impulse = p.start - p.scale.inverse_normal * (p.velocity - p.target);
    else
      p.cone = guess_of(p);
  }
  find_gradient(problem);
  return take_step(problem);
}

SolveResidual NewtonPass::run(NewtonProblem& problem, double enough, double tolerance,
                              int max_iterations) {
  start(problem);
  slope(problem, 0);
  double last = 0, length = 0;  // [m/s] residual of the last prediction; of the last step
  for (int k = 0; k < max_iterations && find_gradient(problem) > tolerance; ++k) {
    const SolveResidual predicted = take_step(problem);
    const double residual = predicted.worst();
    if (residual <= enough) return predicted;
    if (length > kWholeStep && std::abs(residual - last) <= kSettled * residual) return predicted;
    last = residual;
    if (!(descent_ < 0)) break;
    length = search(problem);
    for (std::size_t i = 0; i < change_.size(); ++i) change_[i] += length * step_[i];
    for (NewtonPoint& p : problem.points) p.moved += length * p.step;
    if (length < kShortStep && problem.softness() < kSoftest) {
      problem.set_softness(kSofter * problem.softness());
      slope(problem, 0);
    }
  }
  for (NewtonPoint& p : problem.points) p.trial = p.cone.impulse;
  return problem.follow_trial();
}

}  // namespace poinsot
