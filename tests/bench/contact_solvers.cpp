// The accurate contact solver over single steps: time of a solve from nothing and from its own
// impulses, what it took, and how far the result is from the law and from statics.
//
//   bench_contact_solvers

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "poinsot/contact/convex_newton.h"
#include "support/contact_scenes.h"

namespace {

using namespace poinsot;
using namespace poinsot::test;

using Seconds = std::chrono::duration<double>;

constexpr double kLeastTime = 0.05;  // [s] of measuring

struct Timed {
  double us = 0;
  SolveResidual result;
  ContactProblem solved;
};

Timed time_solves(const ContactProblem& problem) {
  Timed timed;
  ConvexNewton solver;
  timed.solved = problem;
  double total = 0;
  int runs = 0;
  while (runs < 3 || (total < kLeastTime && runs < 10000)) {
    timed.solved.bodies = problem.bodies;
    timed.solved.contacts = problem.contacts;
    timed.solved.joints = problem.joints;
    const auto start = std::chrono::steady_clock::now();
    timed.result = solver.solve(timed.solved.bodies, timed.solved.contacts, problem.target,
                                timed.solved.joints);
    const double took = Seconds(std::chrono::steady_clock::now() - start).count();
    if (runs++ > 0) total += took;  // the first one orders the bodies
  }
  timed.us = 1e6 * total / (runs - 1);
  return timed;
}

void show(const char* what, const Timed& timed) {
  const SolveResidual& r = timed.result;
  std::printf(" | %s %8.1f us %2d it %2d f %2d p %8.1e%s", what, timed.us, r.iterations,
              r.factorisations, r.passes, r.worst(), r.converged ? " " : "!");
}

void run(const std::string& name, const ContactProblem& problem,
         const std::function<double(const ContactProblem&)>& error = {}) {
  std::printf("%-28s %4zu b %5zu c", name.c_str(), problem.bodies.size() - 1,
              problem.contacts.size() + problem.joints.size());
  const Timed cold = time_solves(problem);
  show("cold", cold);
  ContactProblem warm = problem;
  warm.contacts = cold.solved.contacts;
  warm.joints = cold.solved.joints;
  show("warm", time_solves(warm));
  // The next step of something that goes on: impulses a little off.
  for (Contact& contact : warm.contacts) {
    contact.normal_impulse *= 1.01;
    contact.friction_impulse *= 0.97;
  }
  for (PointJoint& joint : warm.joints) joint.impulse *= 1.01;
  const Timed near = time_solves(warm);
  show("near", near);
  const SolveResidual judged = measure_residual(
      problem.bodies, cold.solved.bodies, cold.solved.contacts, problem.target, cold.solved.joints);
  std::printf(" | judged %8.1e", judged.worst());
  if (error) std::printf(" statics %8.1e", error(cold.solved));
  std::printf("\n");
}

void run_tower(const std::string& name, std::vector<double> masses) {
  run(name, tower(masses),
      [&](const ContactProblem& solved) { return tower_force_error(solved, masses); });
}

std::vector<double> alternating(int count, double heavy) {
  std::vector<double> masses;
  for (int i = 0; i < count; ++i) masses.push_back(i % 2 == 0 ? 1.0 : heavy);
  return masses;
}

std::vector<double> topped(int count, double top) {
  std::vector<double> masses(static_cast<std::size_t>(count), 1.0);
  masses.back() = top;
  return masses;
}

}  // namespace

int main() {
  for (const int n : {1, 10, 30, 100}) run_tower("tower " + std::to_string(n), topped(n, 1));
  for (const double top : {100.0, 1000.0})
    run_tower("tower 10, top " + std::to_string(static_cast<int>(top)), topped(10, top));
  run_tower("tower 30, top 1000", topped(30, 1000));
  run_tower("alternating 30, 1:1000", alternating(30, 1e3));
  run_tower("alternating 30, 1:10000", alternating(30, 1e4));
  run_tower("1, 10, 100, 1000", {1, 10, 100, 1000});
  run("wall 10 x 10 x 3", wall(10, 10, 3));
  run("wall 10 x 1 x 10", wall(10, 1, 10));
  for (const double friction : {0.3, 1.0}) {
    ContactProblem block;
    block.add_ground();
    block.add_box(1, {1, 1, 0.2}, {0, 0, 0.1}, {5, 0, 0});
    block.add_square(1, 0, Vec3::Zero(), 0.5, 0.5, friction);
    block.fall();
    run("sliding block, mu " + std::to_string(friction).substr(0, 3), block);
  }
  run("chain 20, end 1000", chain(20, 1000));
}
