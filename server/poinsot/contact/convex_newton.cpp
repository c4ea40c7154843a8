#include "poinsot/contact/convex_newton.h"

#include <algorithm>
#include <cmath>

#include "poinsot/contact/newton_pass.h"
#include "poinsot/contact/newton_problem.h"
#include "poinsot/contact/shift_acceleration.h"

namespace poinsot {

struct ConvexNewton::Scratch {
  NewtonProblem problem;
  NewtonPass pass;
  ShiftAcceleration acceleration;
  std::vector<Vec3> best;
};

namespace {

constexpr double kInnerPart = 0.05;  // [-] of the residual, that ends the pass that starts from it
constexpr int kPatience = 8;         // passes without progress that end a solve

std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace

ConvexNewton::ConvexNewton() : scratch_(std::make_unique<Scratch>()) {}
ConvexNewton::~ConvexNewton() = default;
ConvexNewton::ConvexNewton(ConvexNewton&&) noexcept = default;
ConvexNewton& ConvexNewton::operator=(ConvexNewton&&) noexcept = default;

SolveResidual ConvexNewton::iterate() {
  NewtonProblem& problem = scratch_->problem;
  NewtonPass& pass = scratch_->pass;
  ShiftAcceleration& acceleration = scratch_->acceleration;
  std::vector<Vec3>& best = scratch_->best;
  acceleration.restart();
  pass.load(problem);
  best.resize(problem.points.size());
  SolveResidual now = problem.follow_trial(), least;
  int best_pass = 0;
  for (int k = 0;; ++k) {
    problem.accept_trial();
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
    least.converged = least.worst() <= std::max(tolerance, problem.rounding());
    if (least.converged || k >= max_passes || pass.iterations >= max_iterations ||
        k - best_pass > kPatience)
      break;
    acceleration.choose_shifts(problem);
    now = pass.run(problem, now.worst(), std::max(problem.rounding(), kInnerPart * std::min(now.worst(), tolerance * 1e3)),
             max_iterations - pass.iterations);
  }
  if (best_pass != least.passes) {
    for (std::size_t i = 0; i < best.size(); ++i) problem.points[i].trial = best[i];
    problem.follow_trial();
    problem.accept_trial();
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
