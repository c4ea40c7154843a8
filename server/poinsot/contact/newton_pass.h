// One proximal pass of the convex solver: Newton's method with an exact line search.
//
// Minimises over the change x of velocities since the last pass
//
//   ½ xᵀM x + xᵀJᵀλ₀ + Σ ½ λᵀR λ,   λ = nearest in the cone to λ₀ − R⁻¹(u₀ + J x − goal)
//
// which is convex and once differentiable; its Hessian M + JᵀGJ is factorised by blocks of bodies.
// Everything is relative to λ₀ and the velocities u₀ that go with it: near the solution nothing
// cancels, however stiff R⁻¹ is.

#pragma once

#include <array>
#include <vector>

#include "poinsot/contact/block_ldlt.h"
#include "poinsot/contact/newton_problem.h"

namespace poinsot {

class NewtonPass {
 public:
  int iterations = 0, factorisations = 0;  // since load

  void load(const NewtonProblem& problem);

  // One step of Newton's from the accepted impulses, in the regions that impulses and velocities
  // suggest when weighed alike: what an active-set method would do. Leaves the impulses it leads
  // to, brought into the cones, as the problem's trial.
  SolveResidual guess(NewtonProblem& problem);

  // The pass proper. Ends when what bodies and impulses disagree by is no velocity above
  // `tolerance` [m/s] at a body's points, or when the impulses that a step predicts, brought into
  // the cones, are within `enough` [m/s] of the law, or when these predictions have settled. Leaves
  // impulses as the problem's trial; may leave the problem softer.
  SolveResidual run(NewtonProblem& problem, double enough, double tolerance, int max_iterations);

 private:
  struct Group {
    int a, b;        // moving bodies, a < b; a may be kFixed
    int coupling;    // pair of the factorisation, kFixed if only one body moves
    Vec3 reference;  // [m] that its points' arms are summed about
    BlockLdlt::Block sum;
  };
  struct Key {
    int a, b, point;
  };

  void group_points();
  double find_gradient(const NewtonProblem& problem);
  bool is_stale(const NewtonProblem& problem) const;
  void assemble(NewtonProblem& problem);
  void find_step(NewtonProblem& problem);
  void predict(NewtonProblem& problem) const;
  double slope(NewtonProblem& problem, double length);
  double curvature(const NewtonProblem& problem) const;
  double search(NewtonProblem& problem);

  void start(NewtonProblem& problem);
  SolveResidual take_step(NewtonProblem& problem);

  BlockLdlt system_;
  std::vector<Key> keys_, sorted_;
  std::vector<Group> groups_;
  std::vector<int> group_of_;  // of a point
  std::vector<std::array<int, 2>> pairs_;
  std::vector<double> change_, gradient_, step_;  // 6 per body
  std::vector<ConeImpulse> factorised_;           // cones of the factorisation at hand
  double factorised_softness_ = 0;
  double inertia_slope_ = 0, inertia_curvature_ = 0;  // along the step, of ½ xᵀM x
  double descent_ = 0;                                // slope at zero length
};

}  // namespace poinsot
