// The convex solver and Coulomb's law.

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "poinsot/contact/convex_newton.h"
#include "support/contact_oracle.h"
#include "support/contact_scenes.h"

namespace poinsot {
namespace {

using namespace test;

constexpr double kRounded = 1e-12;  // [m/s] speeds of some m/s, solved to rounding

// A flat block of 1 kg on four corners, its velocity before the solve.
ContactProblem block(const Vec3& v, double friction) {
  ContactProblem problem;
  problem.add_ground();
  problem.add_box(1, {1, 1, 0.2}, {0, 0, 0.1}, v);
  problem.add_square(1, 0, Vec3::Zero(), 0.5, 0.5, friction);
  return problem;
}

SolveResidual solve_to_rounding(ContactProblem& problem) {
  ConvexNewton solver;
  solver.tolerance = 1e-13;
  return solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
}

TEST(ConvexNewton, ASlidingBlockDoesNotFloat) {
  for (const double friction : {0.1, 0.3, 1.0, 2.0}) {
    ContactProblem problem = block({5, 0, -kGravity * kStep}, friction);
    const ContactProblem before = problem;
    ConvexNewton solver;
    const SolveResidual result =
        solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
    EXPECT_TRUE(result.converged);
    const ContactBody& body = problem.bodies[1];
    for (const Contact& contact : problem.contacts) {
      const Vec3 v = body.v + body.omega.cross(contact.point - body.c);
      if (contact.normal_impulse > 0) {
        EXPECT_LE(v.z(), 1e-10);
      }
      EXPECT_GE(v.z(), -1e-10);
    }
    const SolveResidual judged =
        measure_residual(before.bodies, problem.bodies, problem.contacts, problem.target);
    EXPECT_LE(judged.worst(), 1e-10);
  }
}

TEST(ConvexNewton, FrictionOpposesTheSlipAlikeInEveryDirection) {
  constexpr double kFriction = 0.3, kSpeed = 5;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    ContactProblem problem;  // a puck: one point right below its centre of mass
    problem.add_ground();
    problem.add_box(1, {1, 1, 0.2}, Vec3::Zero(),
                    kSpeed * along - kGravity * kStep * Vec3::UnitZ());
    problem.add_point(1, 0, Vec3::Zero(), Vec3::UnitZ(), kFriction);
    EXPECT_TRUE(solve_to_rounding(problem).converged);
    const Vec3 expected = (kSpeed - kFriction * kGravity * kStep) * along;
    EXPECT_LE((problem.bodies[1].v - expected).norm(), kRounded);
    const Contact& contact = problem.contacts[0];
    EXPECT_LE((contact.friction_impulse + kFriction * contact.normal_impulse * along).norm(),
              kRounded);
  }
}

TEST(ConvexNewton, ABlockOnASlopeSticksUpToTheThresholdAndSlidesBeyond) {
  for (int i = 0; i < 24; ++i)
    for (const double friction : {0.2, 0.577, 0.9}) {
      const double angle = 2 * std::numbers::pi * i / 24;
      const Vec3 downhill(std::cos(angle), std::sin(angle), 0);
      for (const double excess : {-1e-7, 1e-7, 0.5}) {
        const double slope = std::atan(friction * (1 + excess));
        const Vec3 pull =
            kGravity * kStep * (std::sin(slope) * downhill - std::cos(slope) * Vec3::UnitZ());
        ContactProblem problem = block(pull, friction);
        EXPECT_TRUE(solve_to_rounding(problem).converged);
        const double speed =
            kGravity * kStep * std::max(0.0, std::sin(slope) - friction * std::cos(slope));
        EXPECT_LE((problem.bodies[1].v - speed * downhill).norm(), kRounded);
        EXPECT_LE(problem.bodies[1].omega.norm(), kRounded);
      }
    }
}

TEST(ConvexNewton, AgreesWithSweepsWhereFrictionActs) {
  int compared = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    // No more contacts than bodies: impulses and velocities are unique at moderate friction.
    const int bodies = 1 + static_cast<int>(seed % 4);
    ContactProblem problem = random_contacts(seed, bodies, bodies, 0.3);
    const auto expected = sweep_with_friction(problem);
    ConvexNewton solver;
    const SolveResidual result =
        solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
    EXPECT_TRUE(result.converged);
    if (!expected) continue;
    ++compared;
    for (std::size_t i = 1; i < problem.bodies.size(); ++i) {
      EXPECT_LE((problem.bodies[i].v - (*expected)[i].v).norm(), 1e-8);
      EXPECT_LE((problem.bodies[i].omega - (*expected)[i].omega).norm(), 1e-8);
    }
  }
  EXPECT_GE(compared, 50);
}

TEST(ConvexNewton, RandomProblemsObeyTheLaw) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int bodies = 1 + static_cast<int>(seed % 4);
    ContactProblem problem = random_contacts(seed, bodies, 3 * bodies, 0.4);
    const ContactProblem before = problem;
    ConvexNewton solver;
    const SolveResidual result =
        solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
    const SolveResidual judged =
        measure_residual(before.bodies, problem.bodies, problem.contacts, problem.target);
    EXPECT_LE(judged.balance, 1e-12);
    EXPECT_NEAR(judged.worst(), result.worst(), 1e-12 + 1e-9 * result.worst());
    EXPECT_TRUE(result.converged) << seed;
  }
}

TEST(ConvexNewton, ImpulsesAddNoKineticEnergy) {
  for (const double friction : {0.0, 0.3, 1.0, 2.0})
    for (unsigned seed = 0; seed < 100; ++seed) {
      ContactProblem problem = random_contacts(seed, 3, 6, friction, true);
      const double before = problem.kinetic_energy();
      ConvexNewton solver;
      solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
      EXPECT_LE(problem.kinetic_energy(), before * (1 + 1e-12)) << friction << " " << seed;
    }
}

// A rod of 2 m that leans by an angle and slides on its lower end: at much friction, the normal
// impulse presses the end into the ground (Painlevé).
TEST(ConvexNewton, ALeaningRodStaysFiniteAndGainsNoEnergy) {
  for (const double friction : {0.3, 1.0, 1.4, 2.0})
    for (int degrees = 10; degrees <= 80; degrees += 5)
      for (const double speed : {-3.0, -0.1, 0.1, 3.0}) {
        const double angle = degrees * std::numbers::pi / 180;
        const Vec3 arm(std::cos(angle), 0, std::sin(angle));
        ContactProblem problem;
        problem.add_ground();
        problem.add_box(1, {0.01, 0.01, 2}, arm, {speed, 0, -kGravity * kStep});
        problem.bodies[1].inv_J_W = Vec3(3, 3, 3).asDiagonal();
        problem.add_point(1, 0, Vec3::Zero(), Vec3::UnitZ(), friction);
        const double before = problem.kinetic_energy();
        ConvexNewton solver;
        const SolveResidual result =
            solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
        EXPECT_TRUE(result.converged) << friction << " " << degrees << " " << speed;
        EXPECT_TRUE(std::isfinite(problem.contacts[0].normal_impulse));
        EXPECT_LE(problem.kinetic_energy(), before * (1 + 1e-12));
      }
}

}  // namespace
}  // namespace poinsot
