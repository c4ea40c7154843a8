#include "poinsot/collision/axis_bound.h"

#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/collision/pair_motion.h"
#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FirstRoot, IsThatOfTheFallingBranch) {
  EXPECT_DOUBLE_EQ(first_root(1, -2, 0), 0.5);
  EXPECT_DOUBLE_EQ(first_root(2, 0, -1), 2);
  EXPECT_DOUBLE_EQ(first_root(0, 3, -2), 3);
  EXPECT_DOUBLE_EQ(first_root(1, -3, 4), 0.5);  // the first of ½ and 1
  EXPECT_EQ(first_root(1, 2, 0), kInfinity);
  EXPECT_EQ(first_root(1, -1, 1), kInfinity);  // turns back at ½
  EXPECT_EQ(first_root(0, -1, 5), 0);
  EXPECT_EQ(first_root(0, 0, -1), 0);
  EXPECT_EQ(first_root(0, 0, 0), kInfinity);
}

TEST(FirstRoot, KeepsItsDigitsWhereRootsAreFarApart) {
  // 1e-9 − x − ½ 1e-9 x²: the root is 1e-9 (1 − 5e-19).
  EXPECT_DOUBLE_EQ(first_root(1e-9, -1, -1e-9), 1e-9);
  EXPECT_DOUBLE_EQ(first_root(1e-12, 1e6, -1), 2e6);
}

// A pair on its courses at a random moment, and an axis.
class BoundOfFlights : public testing::Test {
 protected:
  void for_each(auto&& check) {
    Random random(21);
    for (int i = 0; i < 300; ++i) {
      const FlyBy f =
          random_fly_by(random.below(kHalfSpace), random.below(kHalfSpace + 1), 30, random);
      const CoursedPair pair(f.a, f.b, 1, f.gravity);
      SearchWork work;
      PairMotion motion(pair.pair(), work);
      const double t = random.uniform(0, 0.5);
      motion.go_to(t);
      const Vec3 n = motion.has_plane() ? motion.plane_normal() : random.direction();
      check(motion, motion.bound_along(n), n, t);
    }
  }
};

TEST_F(BoundOfFlights, IsNeverAboveTheGapAlongTheAxis) {
  for_each([](PairMotion& motion, const AxisBound& bound, const Vec3& n, double t) {
    EXPECT_NEAR(bound.at(0), motion.gap_along(n), 1e-14);
    for (double x = 1e-6; x < 0.5; x *= 1.7) {
      motion.go_to(t + x);
      EXPECT_LE(bound.at(x), motion.gap_along(n) + 1e-13);
      EXPECT_LE(bound.central_z + x * (bound.v + 0.5 * bound.central_c * x),
                motion.gap_along(n) + 1e-13);
    }
  });
}

TEST_F(BoundOfFlights, IsExactToFirstOrder) {
  for_each([](PairMotion& motion, const AxisBound& bound, const Vec3& n, double t) {
    for (const double x : {1e-3, 1e-4, 1e-5}) {
      motion.go_to(t + x);
      // What is left out is at most twice the remainder, or a positive acceleration.
      const double second = 2 * (std::abs(bound.c) + 2 * std::abs(bound.central_c)) * x * x;
      EXPECT_LE(motion.gap_along(n) - bound.at(x), second + 1e-13);
    }
  });
}

TEST_F(BoundOfFlights, SlopeIsTheRateOfTheGap) {
  for_each([](PairMotion& motion, const AxisBound& bound, const Vec3& n, double t) {
    const double h = 1e-7;
    const double now = motion.gap_along(n);
    motion.go_to(t + h);
    const double rate = (motion.gap_along(n) - now) / h;
    // Curvature of the motion and of the shapes, and the difference quotient's rounding.
    EXPECT_NEAR(rate, bound.slope(), 1e4 * h + 1e-14 / h);
  });
}

TEST_F(BoundOfFlights, ClearTimesAreProvenAndNotShort) {
  int short_of_end = 0;
  for_each([&](PairMotion& motion, const AxisBound& bound, const Vec3& n, double t) {
    if (bound.at(0) <= 0) return;
    const double x = bound.clear_until(0.5);
    for (int i = 0; i <= 50; ++i) {
      motion.go_to(t + x * i / 50);
      EXPECT_GT(motion.gap_along(n), -1e-13);
    }
    if (x == 0.5) return;
    ++short_of_end;
    // A twentieth longer, and the bound is spent.
    EXPECT_LT(bound.at(1.06 * x), 0.06 * bound.at(0));
  });
  EXPECT_GT(short_of_end, 20);
}

TEST_F(BoundOfFlights, LeavesOnlyToWhereTheGapIsProven) {
  int left = 0;
  for_each([&](PairMotion& motion, const AxisBound& bound, const Vec3& n, double t) {
    const double gap = bound.at(0) + 1e-6;
    const double x = bound.leaves(gap, 0.5);
    if (x == 0) return;
    ++left;
    EXPECT_GT(bound.at(x), gap);
    motion.go_to(t + x);
    EXPECT_GT(motion.gap_along(n), gap - 1e-13);
  });
  EXPECT_GT(left, 20);
}

}  // namespace
}  // namespace poinsot::test
