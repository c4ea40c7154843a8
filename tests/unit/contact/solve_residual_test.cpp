#include "poinsot/contact/solve_residual.h"

#include <gtest/gtest.h>

#include "support/contact_scenes.h"

namespace poinsot {
namespace {

using test::ContactProblem;

// A ball of 2 kg whose lowest point touches the ground; contacts act through its centre.
struct Ball {
  ContactProblem problem;
  std::vector<ContactBody> after;

  explicit Ball(const Vec3& v, double friction) {
    problem.add_ground();
    problem.add_box(2, Vec3::Ones(), Vec3::Zero(), v);
    problem.add_point(1, 0, Vec3::Zero(), Vec3::UnitZ(), friction);
    after = problem.bodies;
  }
  void push(double normal, const Vec3& friction) {
    problem.contacts[0].normal_impulse = normal;
    problem.contacts[0].friction_impulse = friction;
    after[1].v = problem.bodies[1].v + 0.5 * (normal * Vec3::UnitZ() + friction);
  }
  SolveResidual residual() const {
    return measure_residual(problem.bodies, after, problem.contacts, problem.target);
  }
};

TEST(SolveResidual, IsZeroForSticking) {
  Ball ball({0.3, 0, -1}, 0.5);
  ball.push(2, {-0.6, 0, 0});
  EXPECT_LE(ball.residual().worst(), 1e-15);
}

TEST(SolveResidual, IsZeroForSliding) {
  Ball ball({3, 0, -1}, 0.5);
  ball.push(2, {-1, 0, 0});
  EXPECT_LE(ball.residual().worst(), 1e-15);
}

TEST(SolveResidual, IsZeroForParting) {
  Ball ball({3, 0, 1}, 0.5);
  ball.push(0, Vec3::Zero());
  EXPECT_EQ(ball.residual().worst(), 0);
}

TEST(SolveResidual, SeesWhatApproachesAndWhatFloats) {
  Ball ball({0, 0, -1}, 0.5);
  ball.push(1.5, Vec3::Zero());
  EXPECT_NEAR(ball.residual().normal, 0.25, 1e-15);
  ball.push(2.5, Vec3::Zero());
  EXPECT_NEAR(ball.residual().normal, 0.25, 1e-15);
  ball.push(-0.5, Vec3::Zero());
  EXPECT_NEAR(ball.residual().normal, 1.25, 1e-15);
}

TEST(SolveResidual, SeesFrictionThatIsOffTheSlip) {
  Ball ball({3, 0, -1}, 0.5);
  ball.push(2, {-0.8, 0, 0});
  EXPECT_NEAR(ball.residual().friction, 0.5 * 0.2, 1e-15);
  ball.push(2, {-1.2, 0, 0});  // out of the cone
  EXPECT_NEAR(ball.residual().friction, 0.5 * 0.2, 1e-15);
  ball.push(2, {0, 1, 0});
  EXPECT_GT(ball.residual().friction, 0.5);
}

TEST(SolveResidual, SeesVelocitiesThatAreNotOfTheImpulses) {
  Ball ball({0, 0, -1}, 0.5);
  ball.push(2, Vec3::Zero());
  ball.after[1].v.x() += 1e-3;
  EXPECT_NEAR(ball.residual().balance, 1e-3, 1e-15);
}

TEST(SolveResidual, SeesJointsThatPart) {
  ContactProblem problem;
  problem.add_ground();
  problem.add_box(1, Vec3::Ones(), Vec3::Zero(), {0.25, 0, 0});
  problem.add_joint(1, 0, Vec3::Zero());
  const SolveResidual residual = measure_residual(problem.bodies, problem.bodies, problem.contacts,
                                                  problem.target, problem.joints);
  EXPECT_EQ(residual.joint, 0.25);
  EXPECT_EQ(residual.worst(), 0.25);
}

}  // namespace
}  // namespace poinsot
