#include "poinsot/contact/friction_impulses.h"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace poinsot {
namespace {

struct Numbers {
  Eigen::MatrixXd A;
  Eigen::VectorXd u, friction;
  ImpactSystem system() const {
    return {friction.size(), A.data(), u.data(), nullptr, friction.data()};
  }
};

Numbers random_numbers(std::mt19937_64& random, Eigen::Index points, double largest_friction) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  Eigen::MatrixXd J(3 * points, 12);
  for (double& x : J.reshaped()) x = normal(random);
  Eigen::VectorXd v(12);
  for (double& x : v) x = normal(random);
  Numbers numbers{J * J.transpose(), J * v, Eigen::VectorXd(points)};
  for (double& x : numbers.friction) x = largest_friction * unit(random);
  return numbers;
}

TEST(FrictionImpulses, TheLawHoldsAtEveryPoint) {
  std::mt19937_64 random(1);
  FrictionImpulses solver;
  int found = 0, slipping = 0, sticking = 0;
  constexpr int kSamples = 500;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Eigen::Index n = 1 + sample % 8;
    const Numbers numbers = random_numbers(random, n, 1);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(3 * n);
    if (!solver.solve(numbers.system(), p.data())) continue;
    ++found;
    const Eigen::VectorXd u = numbers.u + numbers.A * p;
    const Eigen::VectorXd size = numbers.u.cwiseAbs() + numbers.A.cwiseAbs() * p.cwiseAbs();
    const double tolerance = 1e-8 * size.maxCoeff();  // 1e-9 by the promise, of three components
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Vector2d pt = p.segment<2>(3 * i), ut = u.segment<2>(3 * i);
      const double pn = p[3 * i + 2], un = u[3 * i + 2], limit = numbers.friction[i] * pn;
      ASSERT_GE(pn, 0);
      ASSERT_LE(pt.norm(), limit * (1 + 1e-14));
      ASSERT_GE(un, -tolerance);
      if (pn > 0) {
        ASSERT_LE(un, tolerance);
      }
      if (pn <= 0) continue;
      // Slip is opposed by all the friction there is: ut·pt = −μ pn |ut|.
      ASSERT_NEAR(ut.dot(pt), -limit * ut.norm(), tolerance * (1 + pn));
      ut.norm() > tolerance ? ++slipping : ++sticking;
    }
  }
  EXPECT_GE(found, kSamples * 98 / 100);
  EXPECT_GE(slipping, 100);
  EXPECT_GE(sticking, 100);
}

TEST(FrictionImpulses, GivenNormalImpulsesStayAndFrictionOpposesSlip) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  FrictionImpulses solver;
  for (int sample = 0; sample < 200; ++sample) {
    const Eigen::Index n = 1 + sample % 6;
    const Numbers numbers = random_numbers(random, n, 2);
    Eigen::VectorXd p = Eigen::VectorXd::Zero(3 * n);
    for (Eigen::Index i = 0; i < n; ++i) p[3 * i + 2] = unit(random);
    const Eigen::VectorXd given = p;
    ASSERT_TRUE(solver.solve_tangential(numbers.system(), p.data())) << sample;
    const Eigen::VectorXd u = numbers.u + numbers.A * p;
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_EQ(p[3 * i + 2], given[3 * i + 2]);
      const Eigen::Vector2d pt = p.segment<2>(3 * i), ut = u.segment<2>(3 * i);
      const double limit = numbers.friction[i] * p[3 * i + 2];
      EXPECT_LE(pt.norm(), limit * (1 + 1e-14));
      EXPECT_NEAR(ut.dot(pt), -limit * ut.norm(), 1e-7);
    }
  }
}

TEST(FrictionImpulses, ABlockPushedAlongStopsIfTheConeAllows) {
  // Unit mass, one point below its centre, no turning: |pt| = 0.3 of 1 needed.
  Numbers numbers{Eigen::MatrixXd::Identity(3, 3), Eigen::Vector3d(0.3, 0, -1),
                  Eigen::VectorXd::Constant(1, 0.4)};
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  ASSERT_TRUE(FrictionImpulses().solve(numbers.system(), p.data()));
  EXPECT_NEAR((p - Eigen::Vector3d(-0.3, 0, 1)).norm(), 0, 1e-14);
  numbers.friction[0] = 0.2;
  ASSERT_TRUE(FrictionImpulses().solve(numbers.system(), p.data()));
  EXPECT_NEAR((p - Eigen::Vector3d(-0.2, 0, 1)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace poinsot
