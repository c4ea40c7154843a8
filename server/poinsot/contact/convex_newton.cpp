#include "poinsot/contact/convex_newton.h"

#include <algorithm>
#include <cmath>

#include "poinsot/contact/newton_pass.h"
#include "poinsot/contact/newton_problem.h"

namespace poinsot {

struct ConvexNewton::Scratch {
  NewtonProblem problem;
  NewtonPass pass;
  std::vector<Vec3> best;
};

namespace {

constexpr double kInnerPart = 0.05;  // [-] of the residual, that ends the pass that starts from it
constexpr int kPatience = 8;         // passes without progress that end a solve

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double tangential(const Vec3& v) { return std::sqrt(v[1] * v[1] + v[2] * v[2]); }

// Of velocities and impulses `start`.
SolveResidual residual(const NewtonProblem& problem) {
  SolveResidual result;
  for (const NewtonPoint& p : problem.points) {
    const Vec3 beside = p.velocity - p.target;
    if (p.joint) {
      result.joint = std::max(result.joint, beside.norm());
      continue;
    }
    result.normal =
        std::max(result.normal, std::abs(std::min(p.start[0] * p.w_normal, beside[0])));
    const double y[2] = {p.w_tangent * p.start[1] - beside[1],
                         p.w_tangent * p.start[2] - beside[2]};
    const double length = std::sqrt(y[0] * y[0] + y[1] * y[1]);
    const double limit = p.w_tangent * p.friction * p.start[0];
    const double scale = length > limit ? limit / length : 1.0;
    const double e[2] = {p.w_tangent * p.start[1] - scale * y[0],
                         p.w_tangent * p.start[2] - scale * y[1]};
    result.friction = std::max(result.friction, std::sqrt(e[0] * e[0] + e[1] * e[1]));
  }
  return result;
}

}  // namespace

ConvexNewton::ConvexNewton() : scratch_(std::make_unique<Scratch>()) {}
ConvexNewton::~ConvexNewton() = default;
ConvexNewton::ConvexNewton(ConvexNewton&&) noexcept = default;
ConvexNewton& ConvexNewton::operator=(ConvexNewton&&) noexcept = default;

SolveResidual ConvexNewton::iterate() {
  NewtonProblem& problem = scratch_->problem;
  NewtonPass& pass = scratch_->pass;
  std::vector<Vec3>& best = scratch_->best;
  pass.load(problem);
  best.resize(problem.points.size());
  problem.follow_impulses();
  SolveResidual least;
  int best_pass = 0;
  for (int k = 0;; ++k) {
    SolveResidual now = residual(problem);
    const double goal = std::max(tolerance, problem.rounding());
    if (getenv("TRACE"))
      fprintf(stderr, "pass %d n %.3e t %.3e j %.3e rounding %.2e\n", k, now.normal, now.friction,
              now.joint, problem.rounding());
    if (k == 0 || now.worst() < least.worst()) {
      least = now;
      best_pass = k;
      for (std::size_t i = 0; i < best.size(); ++i) best[i] = problem.points[i].start;
    }
    least.passes = k;
    least.iterations = pass.iterations;
    least.factorisations = pass.factorisations;
    least.converged = least.worst() <= goal;
    if (least.converged || k >= max_passes || pass.iterations >= max_iterations ||
        k - best_pass > kPatience)
      break;
    for (NewtonPoint& p : problem.points)
      if (!p.joint) p.goal[0] = p.target[0] - p.friction * tangential(p.velocity);
    pass.run(problem, std::max(problem.rounding(), kInnerPart * std::min(now.worst(), tolerance * 1e3)),
             max_iterations - pass.iterations);
    for (NewtonPoint& p : problem.points) p.start = p.cone.impulse;
    problem.follow_impulses();
  }
  if (best_pass != least.passes) {
    for (std::size_t i = 0; i < best.size(); ++i) problem.points[i].start = best[i];
    problem.follow_impulses();
  }
  return least;
}

SolveResidual ConvexNewton::solve(std::span<ContactBody> bodies, std::span<Contact> contacts,
                                  std::span<const double> target, std::span<PointJoint> joints) {
  NewtonProblem& problem = scratch_->problem;
  problem.load(bodies, contacts, target, joints, true, true);
  const SolveResidual result = iterate();
  for (Contact& contact : contacts) {
    contact.normal_impulse = 0;
    contact.friction_impulse.setZero();
  }
  for (PointJoint& joint : joints) joint.impulse.setZero();
  for (const NewtonPoint& p : problem.points) {
    if (p.joint) {
      joints[at(p.source)].impulse = p.start;
      continue;
    }
    Contact& contact = contacts[at(p.source)];
    contact.normal_impulse = p.start[0];
    contact.friction_impulse = p.start[1] * p.frame.col(1) + p.start[2] * p.frame.col(2);
  }
  for (const NewtonBody& body : problem.bodies) {
    bodies[at(body.index)].v = body.v;
    bodies[at(body.index)].omega = body.omega;
  }
  return result;
}

SolveResidual ConvexNewton::push_out(std::span<ContactBody> bodies,
                                     std::span<const Contact> contacts,
                                     std::span<const double> target) {
  NewtonProblem& problem = scratch_->problem;
  problem.load(bodies, contacts, target, {}, false, false);
  const SolveResidual result = iterate();
  for (const NewtonBody& body : problem.bodies) {
    bodies[at(body.index)].v = body.v;
    bodies[at(body.index)].omega = body.omega;
  }
  return result;
}

}  // namespace poinsot
