#include "poinsot/math/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr long double kRounding = 1.1e-19L;  // of 64 bits

// Largest deviation of J − A diag(I) Aᵀ, relative to the largest moment.
long double rebuilt_error(const Mat3& J, const PrincipalAxes& p) {
  long double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      long double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += p.axes[i][k] * p.moments[k] * p.axes[j][k];
      const double entry = J(static_cast<int>(i), static_cast<int>(j));
      worst = std::max(worst, std::abs(sum - static_cast<long double>(entry)));
    }
  return worst / p.moments[2];
}

long double orthonormality_error(const PrincipalAxes& p) {
  long double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      long double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += p.axes[k][i] * p.axes[k][j];
      worst = std::max(worst, std::abs(sum - (i == j ? 1 : 0)));
    }
  return worst;
}

long double determinant(const PrincipalAxes& p) {
  const auto& a = p.axes;
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

void expect_principal(const Mat3& J, const PrincipalAxes& p) {
  EXPECT_LE(p.moments[0], p.moments[1]);
  EXPECT_LE(p.moments[1], p.moments[2]);
  EXPECT_LE(std::abs(determinant(p) - 1), 60 * kRounding);
  // Some 6 sweeps of 3 rotations, each with a few roundings.
  EXPECT_LE(orthonormality_error(p), 60 * kRounding);
  EXPECT_LE(rebuilt_error(J, p), 60 * kRounding);
}

Mat3 rotated(const Vec3& moments, const Quat& q) {
  const Mat3 R = q.normalized().toRotationMatrix();
  const Mat3 J = R * moments.asDiagonal() * R.transpose();
  return (J + J.transpose()) / 2;
}

TEST(PrincipalAxes, AreExactForADiagonalTensorInEveryOrder) {
  std::array<double, 3> moments = {1.1, 2.3, 3.1};
  do {
    const Mat3 J = Vec3(moments[0], moments[1], moments[2]).asDiagonal();
    const PrincipalAxes p = principal_axes(J);
    EXPECT_EQ(p.moments[0], static_cast<long double>(1.1));
    EXPECT_EQ(p.moments[1], static_cast<long double>(2.3));
    EXPECT_EQ(p.moments[2], static_cast<long double>(3.1));
    EXPECT_EQ(rebuilt_error(J, p), 0);
    EXPECT_EQ(determinant(p), 1);
  } while (std::next_permutation(moments.begin(), moments.end()));
}

TEST(PrincipalAxes, RebuildRandomTensors) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  long double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double a = 0.1 + unit(random), b = 0.1 + unit(random);
    const double c = std::abs(a - b) + unit(random) * (a + b - std::abs(a - b));
    const Mat3 J =
        rotated({a, b, c}, Quat(normal(random), normal(random), normal(random), normal(random)));
    const PrincipalAxes p = principal_axes(J);
    expect_principal(J, p);
    worst = std::max(worst, rebuilt_error(J, p));
  }
  RecordProperty("worst_1e-19", std::to_string(static_cast<double>(worst * 1e19L)));
}

// The smallest moment of an oblique needle: forming J in double moves it by a few roundings of the
// largest one, whoever finds it.
TEST(PrincipalAxes, FindTheSmallMomentOfAnObliqueNeedle) {
  for (const double ratio : {1e3, 1e6}) {
    const Mat3 J = rotated({1 / ratio, 1, 1 + 0.5 / ratio}, Quat(0.9, 0.1, -0.2, 0.3));
    const PrincipalAxes p = principal_axes(J);
    expect_principal(J, p);
    constexpr double kForming = 4 * 2.2e-16;
    EXPECT_NEAR(static_cast<double>(p.moments[0]), 1 / ratio, kForming);
    EXPECT_NEAR(static_cast<double>(p.moments[2]), 1 + 0.5 / ratio, kForming);
  }
}

// Entries that are exact in double and oblique axes: a plane turned by (3 4)/5, with moments 25
// and 50.
TEST(PrincipalAxes, FindMomentsBeyondDouble) {
  Mat3 J = Mat3::Zero();  // 25 of (3 4)/5, 50 of (4 −3)/5
  J(0, 0) = 9 + 2 * 16;
  J(1, 1) = 16 + 2 * 9;
  J(0, 1) = J(1, 0) = 12 - 24;
  J(2, 2) = 40;
  const PrincipalAxes p = principal_axes(J);
  EXPECT_LE(std::abs(p.moments[0] - 25), 60 * kRounding * 25);
  EXPECT_LE(std::abs(p.moments[1] - 40), 60 * kRounding * 40);
  EXPECT_LE(std::abs(p.moments[2] - 50), 60 * kRounding * 50);
  EXPECT_LE(std::abs(std::abs(p.axes[0][0]) - 0.6L), 60 * kRounding);
}

TEST(PrincipalAxes, TakeTheSymmetricPart) {
  Mat3 J = Vec3(1, 2, 3).asDiagonal();
  J(0, 1) = 0.2;
  Mat3 symmetric = J;
  symmetric(0, 1) = symmetric(1, 0) = 0.1;
  EXPECT_EQ(principal_axes(J).moments, principal_axes(symmetric).moments);
}

TEST(PrincipalAxes, OfEqualMomentsAreSomeRotation) {
  const Mat3 J = rotated({2, 2, 2}, Quat(0.9, 0.1, -0.2, 0.3));
  expect_principal(J, principal_axes(J));
  expect_principal(Mat3::Identity(), principal_axes(Mat3::Identity()));
}

}  // namespace
}  // namespace poinsot
