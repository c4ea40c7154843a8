#include "poinsot/contact/convex_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "poinsot/contact/newton_pass.h"
#include "poinsot/contact/newton_problem.h"
#include "poinsot/contact/shift_acceleration.h"

namespace poinsot {

struct ConvexNewton::Scratch {
  NewtonProblem problem;
  NewtonPass pass;
  ShiftAcceleration acceleration;
  std::vector<Vec3> best;
  double hardening = 1;  // [-] of passes proper
  double hopeless = 0;   // [m/s] residual from which a guess led nowhere

  void keep();
  void restore();
  void clear();
};

namespace {

// [-] R beside inverse effective masses where active sets are guessed: every pass leaves this much
// of the error, times the condition of the contacts, of which the mass ratio is part. Not smaller
// than the factorisation bears.
constexpr double kHard = 1e-8, kHardest = 1e-12;
constexpr double kLeft = 1e-3;  // [-] of the error, beside what depth of stacks adds
// [-] the same for a pass proper, beside the residual's part of the loads: then points that change
// their regions do so over what is left to be moved, and Newton's method sees them in time.
constexpr double kSoftestPass = 1e-2, kHardestPass = 1e-5;
constexpr double kAccepted = 0.5;  // [-] of the residual, that a guess must come down to
// [-] of the residual at the last guess that led nowhere: then another one is made.
constexpr double kHope = 0.1;
constexpr double kMuchNearer = 0.1;   // [-] of the residual, that ends a pass before its own end
constexpr double kInnerPart = 0.05;   // [-] of the residual, to which a pass is solved …
constexpr double kInnerSpeed = 1e-8;  // [m/s] … but to this at least
// [-] R of the second attempt beside that of the first: what a softer pass leaves misleads the
// shifts where the normal impulse nearly drives a point into the ground.
constexpr double kSecondAttempt = 1e-2;
constexpr int kPatience = 15;  // passes without progress that end a solve
constexpr int kMany = 12;      // iterations after which what is acceptable is accepted, and
                               // with the fourth power of their number more

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void ConvexNewton::Scratch::keep() {
  best.resize(problem.points.size());
  for (std::size_t i = 0; i < best.size(); ++i) best[i] = problem.points[i].start;
}

void ConvexNewton::Scratch::restore() {
  for (std::size_t i = 0; i < best.size(); ++i) problem.points[i].trial = best[i];
  problem.follow_trial();
  problem.accept_trial();
}

void ConvexNewton::Scratch::clear() {
  for (NewtonPoint& p : problem.points) p.trial.setZero();
  problem.follow_trial();
  problem.accept_trial();
}

ConvexNewton::ConvexNewton() : scratch_(std::make_unique<Scratch>()) {}
ConvexNewton::~ConvexNewton() = default;
ConvexNewton::ConvexNewton(ConvexNewton&&) noexcept = default;
ConvexNewton& ConvexNewton::operator=(ConvexNewton&&) noexcept = default;

// From the accepted impulses to better ones, left as the problem's trial.
SolveResidual ConvexNewton::improve(double residual, bool first) {
  NewtonProblem& problem = scratch_->problem;
  NewtonPass& pass = scratch_->pass;
  scratch_->acceleration.choose_shifts(problem);
  const double hard = std::clamp(kLeft / problem.mass_ratio, kHardest, kHard);
  problem.set_softness(hard);
  SolveResidual next;
  const double load = problem.largest_load();
  const bool hopeful = residual <= kHope * scratch_->hopeless;
  if (hopeful) {
    next = pass.guess(problem);
    if (next.worst() <= kAccepted * residual) return next;
    scratch_->hopeless = residual;
  }
  if (first && load > 0) {
    // The start was of little use: nothing may be a better one.
    scratch_->clear();
    scratch_->acceleration.restart();
    scratch_->acceleration.choose_shifts(problem);
    next = pass.guess(problem);
    if (next.worst() <= kAccepted * residual) return next;
    scratch_->restore();
    scratch_->acceleration.restart();
    scratch_->acceleration.choose_shifts(problem);
  }
  problem.set_softness(load > 0 ? std::clamp(scratch_->hardening * residual / load,
                                             kHardestPass * scratch_->hardening, kSoftestPass)
                                : kSoftestPass);
  const double tolerable =
      std::max(problem.rounding(), std::min(kInnerPart * residual, kInnerSpeed));
  return pass.run(problem, kMuchNearer * residual, tolerable, max_iterations - pass.iterations);
}

double ConvexNewton::acceptable_after(int iterations) const {
  const double many = static_cast<double>(iterations) / kMany;
  return many < 1 ? 0 : acceptable * many * many * many * many;
}

SolveResidual ConvexNewton::iterate() {
  NewtonProblem& problem = scratch_->problem;
  NewtonPass& pass = scratch_->pass;
  scratch_->acceleration.load(problem.points.size());
  pass.load(problem);
  scratch_->hopeless = std::numeric_limits<double>::infinity();
  scratch_->hardening = 1;
  SolveResidual now = problem.follow_trial(), least;
  int best_pass = 0, stilled_pass = 0, k = 0;
  for (;; ++k) {
    problem.accept_trial();
    if (k == 0 || now.worst() < least.worst()) {
      least = now;
      best_pass = k;
      scratch_->keep();
    }
    const double asked = std::max(tolerance, acceptable_after(pass.iterations));
    least.converged = least.worst() <= std::max(asked, problem.rounding());
    if (least.converged || k >= max_passes || pass.iterations >= max_iterations ||
        k - std::max(best_pass, stilled_pass) > kPatience)
      break;
    if (k - best_pass >= kPatience / 2 && stilled_pass == 0) {
      // Sliding that its own friction ends within the impulse: no shift of a sliding point fits.
      scratch_->restore();
      scratch_->acceleration.restart(true);
      scratch_->hopeless = std::numeric_limits<double>::infinity();
      scratch_->hardening = kSecondAttempt;
      now = least;
      stilled_pass = k;
    }
    now = improve(now.worst(), k == 0);
  }
  if (best_pass != k) scratch_->restore();
  least.passes = k;
  least.iterations = pass.iterations;
  least.factorisations = pass.factorisations;
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
