#include "poinsot/math/inertia.h"

#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(Inertia, ParallelAxisIsThatOfAParticle) {
  const Vec3 r(1, 2, 3);
  Mat3 slide;  // the lesson's matrix
  slide << 13, -2, -3, -2, 10, -6, -3, -6, 5;
  EXPECT_TRUE(parallel_axis(2, r).isApprox(2 * slide, 1e-15));
}

TEST(Inertia, RotationKeepsPrincipalMoments) {
  const Mat3 J = Vec3(1, 2, 2.5).asDiagonal();
  const Mat3 R = Quat(0.9, 0.1, -0.2, 0.3).normalized().toRotationMatrix();
  EXPECT_NEAR((principal_moments(rotate_inertia(R, J)) - Vec3(1, 2, 2.5)).norm(), 0, 1e-14);
}

TEST(Inertia, KnowsWhatMatterCanHave) {
  auto diagonal = [](double a, double b, double c) { return Mat3(Vec3(a, b, c).asDiagonal()); };
  EXPECT_TRUE(is_physical_inertia(diagonal(1, 2, 2.5)));
  EXPECT_TRUE(is_physical_inertia(diagonal(1, 2, 3)));       // flat
  EXPECT_FALSE(is_physical_inertia(diagonal(1, 2, 3.001)));  // triangle inequality
  EXPECT_FALSE(is_physical_inertia(diagonal(1, -2, 2)));
  EXPECT_FALSE(is_physical_inertia(diagonal(0, 1, 1)));
  EXPECT_FALSE(is_physical_inertia(diagonal(1, 1, std::numeric_limits<double>::quiet_NaN())));
  Mat3 skewed = diagonal(2, 2, 2);
  skewed(0, 1) = 0.5;
  EXPECT_FALSE(is_physical_inertia(skewed));
}

}  // namespace
}  // namespace poinsot
