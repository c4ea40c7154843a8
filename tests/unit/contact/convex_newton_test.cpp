#include "poinsot/contact/convex_newton.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "support/allocation_counter.h"
#include "support/contact_oracle.h"
#include "support/contact_scenes.h"

namespace poinsot {
namespace {

using namespace test;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

SolveResidual solve(ContactProblem& problem, ConvexNewton& solver) {
  return solver.solve(problem.bodies, problem.contacts, problem.target, problem.joints);
}

// Solves and holds the result against the law by the independent measure.
SolveResidual solve_well(ContactProblem& problem) {
  const ContactProblem before = problem;
  ConvexNewton solver;
  const SolveResidual result = solve(problem, solver);
  EXPECT_TRUE(result.converged);
  const SolveResidual judged = measure_residual(before.bodies, problem.bodies, problem.contacts,
                                                problem.target, problem.joints);
  EXPECT_LE(judged.worst(), 1e-9);
  for (const Contact& contact : problem.contacts) {
    EXPECT_GE(contact.normal_impulse, 0);
    EXPECT_LE(contact.friction_impulse.norm(),
              contact.friction * contact.normal_impulse * (1 + 8 * kEpsilon));
  }
  return result;
}

std::vector<double> alternating(int count, double heavy) {
  std::vector<double> masses;
  for (int i = 0; i < count; ++i) masses.push_back(i % 2 == 0 ? 1.0 : heavy);
  return masses;
}

TEST(ConvexNewton, TowersOfAnyMassesCarryTheirWeight) {
  std::vector<double> uniform(10, 1.0), topped(10, 1.0);
  topped.back() = 1000;
  for (const std::vector<double>& masses :
       {uniform, topped, std::vector<double>(30, 1.0), alternating(30, 1e3), alternating(30, 1e4),
        std::vector<double>{1, 10, 100, 1000}, std::vector<double>{1e-3, 1e-1, 1e1, 1e3}}) {
    ContactProblem problem = tower(masses);
    solve_well(problem);
    // Every box may still fall with the tolerance: of the weight that an interface carries.
    const double tolerance = ConvexNewton().tolerance;
    const double count = static_cast<double>(masses.size());
    const double ratio = std::accumulate(masses.begin(), masses.end(), 0.0) / masses.back();
    EXPECT_LE(tower_force_error(problem, masses),
              std::min(1e-7, count * ratio * tolerance / (kGravity * kStep) + 100 * kEpsilon));
    for (std::size_t i = 1; i < problem.bodies.size(); ++i)
      EXPECT_LE(problem.bodies[i].v.norm(), static_cast<double>(i) * tolerance);
  }
}

TEST(ConvexNewton, AStartFromTheSolutionNeedsNoIteration) {
  ContactProblem problem = tower(alternating(30, 1e3));
  const std::vector<ContactBody> falling = problem.bodies;
  ConvexNewton solver;
  solve(problem, solver);
  problem.bodies = falling;
  EXPECT_EQ(solve(problem, solver).iterations, 0);
  for (Contact& contact : problem.contacts) contact.normal_impulse *= 1.01;
  problem.bodies = falling;
  EXPECT_LE(solve(problem, solver).iterations, 3);
}

TEST(ConvexNewton, ImpulsesThatStartOutOfTheConeDoNoHarm) {
  ContactProblem problem = tower(std::vector<double>(5, 1.0));
  for (Contact& contact : problem.contacts) {
    contact.normal_impulse = -3;
    contact.friction_impulse = {7, -2, 0};
  }
  problem.contacts[3].normal_impulse = std::numeric_limits<double>::infinity();
  solve_well(problem);
}

TEST(ConvexNewton, AgreesWithEnumerationWithoutFriction) {
  int compared = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const int bodies = 1 + static_cast<int>(seed % 4);
    ContactProblem problem = random_contacts(seed, bodies, 2 + static_cast<int>(seed % 6), 0);
    const auto expected = enumerate_frictionless(problem);
    solve_well(problem);
    if (!expected) continue;
    ++compared;
    for (std::size_t i = 1; i < problem.bodies.size(); ++i) {
      EXPECT_LE((problem.bodies[i].v - (*expected)[i].v).norm(), 1e-8);
      EXPECT_LE((problem.bodies[i].omega - (*expected)[i].omega).norm(), 1e-8);
    }
  }
  EXPECT_GE(compared, 50);
}

TEST(ConvexNewton, PushOutIsTheFrictionlessSolution) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    ContactProblem problem = random_contacts(seed, 3, 5, 0);
    for (std::size_t i = 0; i < problem.target.size(); ++i)
      problem.target[i] = 0.1 * static_cast<double>(i);
    for (ContactBody& body : problem.bodies) body.v = body.omega = Vec3::Zero();
    const auto expected = enumerate_frictionless(problem);
    if (!expected) continue;
    for (Contact& contact : problem.contacts) {
      contact.friction = 0.8;
      contact.normal_impulse = 5;
    }
    ConvexNewton solver;
    const SolveResidual result = solver.push_out(problem.bodies, problem.contacts, problem.target);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(problem.contacts[0].normal_impulse, 5);
    for (std::size_t i = 1; i < problem.bodies.size(); ++i)
      EXPECT_LE((problem.bodies[i].v - (*expected)[i].v).norm(), 1e-8);
  }
}

TEST(ConvexNewton, ConservesMomentum) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    ContactProblem problem = random_contacts(seed, 5, 8, 0.4);
    std::erase_if(problem.contacts, [](const Contact& c) { return c.a == 0 || c.b == 0; });
    problem.target.assign(problem.contacts.size(), 0.0);
    const Vec3 before = problem.momentum();
    ConvexNewton solver;
    solve(problem, solver);
    double size = before.norm();
    for (const Contact& contact : problem.contacts) size += contact.normal_impulse;
    EXPECT_LE((problem.momentum() - before).norm(), 32 * kEpsilon * size);
  }
}

TEST(ConvexNewton, AnyMassesAndSizesAreSolved) {
  for (const double mass : {1e-6, 1.0, 1e6})
    for (const double size : {1e-4, 1.0, 1e4}) {
      ContactProblem problem;
      problem.add_ground();
      const Vec3 s = size * Vec3::Ones();
      for (int i = 0; i < 3; ++i) {
        problem.add_box(i == 1 ? 100 * mass : mass, s, {0, 0, (i + 0.5) * size});
        problem.add_square(i + 1, i, {0, 0, i * size}, 0.5 * size, 0.5 * size, 0.5);
      }
      problem.fall();
      solve_well(problem);
    }
}

TEST(ConvexNewton, PointMassesAndPlanarBodiesAreSolved) {
  ContactProblem problem;
  problem.add_ground();
  problem.add_box(1, Vec3::Ones(), {0, 0, 0.5}, {0.2, 0, 0});
  problem.add_box(2, Vec3::Ones(), {3, 0, 0.5}, {0.2, 0, 0});
  problem.bodies[1].inv_J_W.setZero();
  problem.bodies[2].inv_J_W = Vec3(0, 6, 0).asDiagonal();
  problem.add_square(1, 0, Vec3::Zero(), 0.5, 0.5, 0.5);
  problem.add_square(2, 0, {3, 0, 0}, 0.5, 0.5, 0.5);
  problem.fall();
  solve_well(problem);
  EXPECT_EQ(problem.bodies[1].omega, Vec3::Zero());
  EXPECT_EQ(problem.bodies[2].omega.x(), 0);
}

// As if the ground moved the other way.
TEST(ConvexNewton, WhatAContactCarriesCountsAsItsVelocity) {
  ContactProblem problem, moved;
  const Vec3 carried(0.03, -0.02, 0.01);
  for (ContactProblem* p : {&problem, &moved}) {
    p->add_ground();
    p->add_box(1, {1, 1, 1}, {0, 0, 0.5});
    p->add_square(1, 0, Vec3::Zero(), 0.5, 0.5, 0.6);
    p->fall();
  }
  moved.bodies[0].v = -carried;
  for (Contact& contact : problem.contacts) contact.carried = carried;
  ConvexNewton solver;
  for (ContactProblem* p : {&problem, &moved})
    EXPECT_TRUE(solver.solve(p->bodies, p->contacts, p->target, p->joints).converged);
  EXPECT_LT((problem.bodies[1].v - moved.bodies[1].v).norm(), 1e-12);
  EXPECT_LT((problem.bodies[1].v + carried).norm(), 1e-10);
}

TEST(ConvexNewton, ASolveThatTakesLongEndsWithWhatIsAcceptable) {
  ContactProblem exact = wall(6, 1, 6);
  exact.fall();
  for (std::size_t k = 1; k < exact.bodies.size(); ++k)
    exact.bodies[k].v.x() += 0.1 * static_cast<double>(k % 3);
  ContactProblem loose = exact;
  ConvexNewton solver;
  const SolveResidual strict =
      solver.solve(exact.bodies, exact.contacts, exact.target, exact.joints);
  solver.acceptable = 1e-5;
  const SolveResidual eased =
      solver.solve(loose.bodies, loose.contacts, loose.target, loose.joints);
  EXPECT_TRUE(eased.converged);
  EXPECT_LE(eased.iterations, strict.iterations);
  const double many = std::max(1.0, eased.iterations / 12.0);
  EXPECT_LE(eased.worst(), 1e-5 * many * many * many * many);
}

TEST(ConvexNewton, ABodyOfInfiniteMassBringsItsVelocity) {
  ContactProblem problem;
  problem.add_ground();
  problem.bodies[0].v = {1, 0, 2};
  problem.bodies[0].omega = {0, 0, 3};
  problem.add_box(1, Vec3::Ones(), {0, 0, 0.5});
  problem.add_square(1, 0, Vec3::Zero(), 0.5, 0.5, 10);
  solve_well(problem);
  EXPECT_LE((problem.bodies[1].v - Vec3(1, 0, 2)).norm(), 1e-9);
  EXPECT_LE((problem.bodies[1].omega - Vec3(0, 0, 3)).norm(), 1e-9);
}

TEST(ConvexNewton, WhatIsNotFiniteIsLeftOut) {
  const ContactProblem clean = tower(std::vector<double>(3, 1.0));
  ContactProblem expected = clean, problem = clean;
  ConvexNewton solver;
  solve(expected, solver);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  problem.add_point(2, 1, {nan, 0, 1}, Vec3::UnitZ(), 0.5);
  problem.add_point(2, 1, {0, 0, 1}, Vec3::UnitZ(), nan);
  problem.add_point(2, 1, {0, 0, 1}, Vec3::UnitZ(), 0.5);
  problem.target.back() = nan;
  const int lost = problem.add_box(1, Vec3::Ones(), {0, 0, nan});
  problem.add_point(lost, 3, {0, 0, 3}, Vec3::UnitZ(), 0.5);
  solve(problem, solver);
  for (std::size_t i = 0; i < expected.bodies.size(); ++i)
    EXPECT_EQ(problem.bodies[i].v, expected.bodies[i].v);
  for (std::size_t i = expected.contacts.size(); i < problem.contacts.size(); ++i)
    EXPECT_EQ(problem.contacts[i].normal_impulse, 0);
}

TEST(ConvexNewton, NothingToSolveIsSolved) {
  ConvexNewton solver;
  ContactProblem empty;
  EXPECT_TRUE(solve(empty, solver).converged);
  empty.add_ground();
  empty.add_ground();
  empty.add_point(0, 1, Vec3::Zero(), Vec3::UnitZ(), 0.5);
  EXPECT_TRUE(solve(empty, solver).converged);
}

TEST(ConvexNewton, AChainKeepsItsJointsTogether) {
  for (const double last : {1.0, 1000.0}) {
    ContactProblem problem = chain(20, last);
    const SolveResidual result = solve_well(problem);
    EXPECT_LE(result.joint, 1e-10);
  }
}

TEST(ConvexNewton, AJointAndContactsHoldTogether) {
  // A lintel of 3 m on one box and on a hinge to the ground, and something heavy on it.
  ContactProblem problem;
  problem.add_ground();
  problem.add_box(1, Vec3::Ones(), {0, 0, 0.5});
  problem.add_box(3, {3, 1, 0.5}, {1.5, 0, 1.25});
  problem.add_box(500, Vec3::Ones(), {1, 0, 2});
  problem.add_square(1, 0, {0, 0, 0}, 0.5, 0.5, 0.4);
  problem.add_square(2, 1, {0, 0, 1}, 0.5, 0.5, 0.4);
  problem.add_square(3, 2, {1, 0, 1.5}, 0.5, 0.5, 0.4);
  problem.add_joint(2, 0, {3, 0, 1.25});
  problem.fall();
  solve_well(problem);
  for (const ContactBody& body : problem.bodies) EXPECT_LE(body.v.norm(), 1e-8);
  // Moments about the hinge: the box under the lintel carries (3·1.5 + 500·2)/3 of the weights.
  double sum = 0;
  for (std::size_t i = 4; i < 8; ++i)
    sum += problem.contacts[i].normal_impulse * (3 - problem.contacts[i].point.x());
  for (std::size_t i = 4; i < 8; ++i)
    sum -= 0.25 * problem.contacts[i].friction_impulse.x();  // acts 0.25 m below the hinge
  EXPECT_NEAR(sum / ((3 * 1.5 + 500 * 2) * kGravity * kStep), 1, 1e-7);
}

TEST(ConvexNewton, TheResultDoesNotDependOnWhatWasSolvedBefore) {
  ContactProblem fresh = tower(alternating(10, 100)), used = fresh;
  ContactProblem other = random_contacts(3, 8, 14, 0.6), longer = tower(alternating(12, 5));
  ConvexNewton one, two;
  solve(other, two);
  solve(longer, two);
  solve(fresh, one);
  solve(used, two);
  for (std::size_t i = 0; i < fresh.bodies.size(); ++i) {
    EXPECT_EQ(fresh.bodies[i].v, used.bodies[i].v);
    EXPECT_EQ(fresh.bodies[i].omega, used.bodies[i].omega);
  }
}

TEST(ConvexNewton, DoesNotAllocateForTheSameProblem) {
  if (!can_count_allocations()) GTEST_SKIP();
  for (const ContactProblem& problem :
       {tower(alternating(10, 1000)), random_contacts(1, 4, 9, 0.5), chain(10, 100)}) {
    ContactProblem first = problem, second = problem;
    ConvexNewton solver;
    solve(first, solver);
    const std::size_t before = allocations();
    solve(second, solver);
    EXPECT_EQ(allocations(), before);
  }
}

}  // namespace
}  // namespace poinsot
