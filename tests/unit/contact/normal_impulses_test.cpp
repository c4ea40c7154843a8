#include "poinsot/contact/normal_impulses.h"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace poinsot {
namespace {

// The law itself, relative to the magnitudes that cancel in w.
void expect_law(const Eigen::MatrixXd& N, const Eigen::VectorXd& u, const Eigen::VectorXd& lambda,
                double tolerance) {
  const Eigen::VectorXd w = u + N * lambda;
  const Eigen::VectorXd size = u.cwiseAbs() + N.cwiseAbs() * lambda;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    ASSERT_GE(lambda[i], 0);
    ASSERT_GE(w[i], -tolerance * size[i]);
    if (lambda[i] > 0) {
      ASSERT_LE(std::abs(w[i]), tolerance * size[i]);
    }
  }
}

TEST(NormalImpulses, AChainOfEqualBallsSharesAsTheProjectionSays) {
  // Three balls in a row, the first comes: all go on with a third of its speed.
  Eigen::MatrixXd N(2, 2);
  N << 2, -1, -1, 2;
  const Eigen::VectorXd u = Eigen::Vector2d(-3, 0);
  Eigen::VectorXd lambda(2);
  ASSERT_TRUE(NormalImpulses().solve(2, N.data(), u.data(), lambda.data()));
  EXPECT_NEAR(lambda[0], 2, 1e-14);
  EXPECT_NEAR(lambda[1], 1, 1e-14);
}

TEST(NormalImpulses, ManyPointsOnFewBodiesObeyTheLaw) {
  // N = J M⁻¹ Jᵀ of rank far below its size, masses over six decades.
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-3, 3);
  NormalImpulses solver;
  for (int sample = 0; sample < 500; ++sample) {
    const Eigen::Index n = 2 + sample % 60, rank = 1 + sample % 12;
    Eigen::MatrixXd J(n, rank);
    for (double& x : J.reshaped()) x = normal(random);
    Eigen::VectorXd inverse_mass(rank), v(rank), lambda(n);
    for (double& x : inverse_mass) x = std::pow(10, decades(random));
    for (double& x : v) x = normal(random);
    const Eigen::MatrixXd N = J * inverse_mass.asDiagonal() * J.transpose();
    const Eigen::VectorXd u = J * v;
    ASSERT_TRUE(solver.solve(n, N.data(), u.data(), lambda.data())) << sample;
    // Rounding of N itself: some n·ε of its row.
    expect_law(N, u, lambda, 1e-12);
  }
}

TEST(NormalImpulses, FourCornersOfABrickShareEqually) {
  // Vertical push and two turns of a unit cube: rank three.
  Eigen::MatrixXd J(4, 3);
  J << 1, 0.5, 0.5, 1, -0.5, 0.5, 1, 0.5, -0.5, 1, -0.5, -0.5;
  const Eigen::MatrixXd N = J * Eigen::Vector3d(1, 6, 6).asDiagonal() * J.transpose();
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(4, -1);
  Eigen::VectorXd lambda(4);
  ASSERT_TRUE(NormalImpulses().solve(4, N.data(), u.data(), lambda.data()));
  // What rounding leaves in a direction that N does not see: ε/shift.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(lambda[i], 0.25, 1e-6);
  expect_law(N, u, lambda, 1e-14);
}

TEST(NormalImpulses, AHeavyBodyOnALightOneIsCarried) {
  // The floor, 1 g, 1 t on top: both come to rest.
  const double light = 1e3, heavy = 1e-3;  // [1/kg]
  Eigen::MatrixXd N(2, 2);
  N << light, -light, -light, light + heavy;
  const Eigen::VectorXd u = Eigen::Vector2d(-1, 0);
  Eigen::VectorXd lambda(2);
  ASSERT_TRUE(NormalImpulses().solve(2, N.data(), u.data(), lambda.data()));
  EXPECT_NEAR(lambda[1], 1e3, 1e-6);
  EXPECT_NEAR(lambda[0], 1e3 + 1e-3, 1e-6);
}

}  // namespace
}  // namespace poinsot
