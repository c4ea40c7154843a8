#include "poinsot/collision/axis_turn.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

constexpr double kQuarter = 0.78539816339744830962;

// A pair in touch: the normal now and a little later, by the narrow phase.
void expect_turns_with_its_features(const BodyDef& a, const BodyDef& b) {
  const CoursedPair pair(a, b, 1);
  SearchWork work;
  PairMotion motion(pair.pair(), work);
  motion.go_to(0);
  const NearestAxis axis = nearest_axis(motion, Vec3::Zero());
  const Vec3 turn = axis_turn(motion, axis.n);
  EXPECT_NEAR(turn.dot(axis.n), 0, 1e-12);
  EXPECT_GT(turn.norm(), 0.1);
  const double rate = gap_rate(motion, axis);
  const double h = 1e-5;
  motion.go_to(h);
  const NearestAxis later = nearest_axis(motion, axis.n);
  // Second order in h: 50 rad²/s² and m/s².
  EXPECT_NEAR((turned_axis(axis.n, turn, h) - later.n).norm(), 0, 50 * h * h);
  EXPECT_NEAR((later.gap - axis.gap) / h, rate, 50 * h);
}

BodyDef slab(const Vec3& omega) {
  return moving(Box{{4, 4, 0.1}}, {0, 0, -0.05}, {0, 0, 0.1}, omega);
}

TEST(AxisTurn, ACornerOverAFaceTurnsTheAxisWithTheFace) {
  const Quat corner = Quat::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ());
  const BodyDef box = moving(Box{{0.2, 0.2, 0.2}}, {0.5, 0.3, std::sqrt(3.0) * 0.1 + 0.01},
                             {0, 0, -1}, {3, 1, 2}, corner);
  expect_turns_with_its_features(box, slab({0.3, -1, 0.5}));
  expect_turns_with_its_features(slab({0.3, -1, 0.5}), box);
  const BodyDef ball = moving(Sphere{0.1}, {0.5, 0.3, 0.11}, {0, 0, -1}, Vec3::Zero());
  expect_turns_with_its_features(ball, slab({0.3, -1, 0.5}));
}

TEST(AxisTurn, TwoEdgesTurnItPerpendicularToBoth) {
  const Quat about_x(Eigen::AngleAxisd(kQuarter, Vec3::UnitX()));
  const Quat about_y(Eigen::AngleAxisd(kQuarter, Vec3::UnitY()));
  const double reach = std::sqrt(0.02);
  expect_turns_with_its_features(
      moving(Box{{1, 0.2, 0.2}}, {0.1, 0, reach + 0.01}, {0, 0, -3}, {1, 2, 0.5}, about_x),
      moving(Box{{0.2, 1, 0.2}}, {0, 0.1, -reach}, Vec3::Zero(), {2, -1, 0.3}, about_y));
}

TEST(AxisTurn, BallsAndHalfSpacesDoNotTurnIt) {
  const BodyDef ball = moving(Sphere{0.5}, {0, 0, 2}, Vec3::Zero(), {1, 2, 3});
  const CoursedPair on_plane(ball, ground(), 1);
  const CoursedPair balls(ball, moving(Sphere{0.5}, {0, 0, 0}, {1, 0, 0}, {1, 2, 3}), 1);
  for (const CoursedPair* pair : {&on_plane, &balls}) {
    SearchWork work;
    PairMotion motion(pair->pair(), work);
    motion.go_to(0);
    EXPECT_EQ(axis_turn(motion, Vec3::UnitZ()), Vec3::Zero());
  }
}

TEST(AxisTurn, TheRateOfAFaceIsThatOfItsFastestCornerInTouch) {
  // Turning about y at 1 rad/s: of the box's face 0.2 m wide the corners at +x come at 0.1 m/s. Of
  // the slab, which reaches to 2 m, only what is below the box counts.
  const BodyDef box = moving(Box{{0.2, 0.2, 0.2}}, {0, 0, 0.1}, Vec3::Zero(), {0, 1, 0});
  BodyDef still = slab(Vec3::Zero());
  still.linear_velocity.setZero();
  const CoursedPair pair(box, still, 1);
  SearchWork work;
  PairMotion motion(pair.pair(), work);
  motion.go_to(0);
  EXPECT_NEAR(gap_rate(motion, nearest_axis(motion, Vec3::Zero())), -0.1, 1e-12);
  BodyDef spinning = slab({0, 1, 0});
  spinning.linear_velocity.setZero();
  const CoursedPair other(moving(Box{{0.2, 0.2, 0.2}}, {0, 0, 0.1}, Vec3::Zero(), Vec3::Zero()),
                          spinning, 1);
  PairMotion below(other.pair(), work);
  below.go_to(0);
  EXPECT_NEAR(gap_rate(below, nearest_axis(below, Vec3::Zero())), -0.1, 1e-12);
}

TEST(AxisTurn, TheBoundAlongATurningAxisHolds) {
  Random random(51);
  for (int i = 0; i < 300; ++i) {
    const FlyBy f = random_fly_by(random.below(kHalfSpace), random.below(kHalfSpace), 20, random);
    const CoursedPair pair(f.a, f.b, 1, f.gravity);
    SearchWork work;
    PairMotion motion(pair.pair(), work);
    const double t = random.uniform(0, 0.5), most = random.log_uniform(1e-3, 0.3);
    motion.go_to(t);
    const Vec3 n = random.direction();
    const Vec3 turn = random.uniform(0, 20) * n.cross(random.direction());
    const AxisBound bound = motion.bound_turning(n, turn, most);
    EXPECT_NEAR(bound.at(0), motion.gap_along(n), 1e-14);
    for (double x = 1e-6; x < most; x *= 1.7) {
      motion.go_to(t + x);
      EXPECT_LE(bound.at(x), motion.gap_along(turned_axis(n, turn, x)) + 1e-13);
      if (x < 1e-4) {
        EXPECT_LE(motion.gap_along(turned_axis(n, turn, x)) - bound.at(x),
                  2 * (std::abs(bound.c) + 20) * x * x + 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace poinsot::test
