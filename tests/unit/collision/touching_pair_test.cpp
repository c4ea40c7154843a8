#include "poinsot/collision/touching_pair.h"

#include <gtest/gtest.h>

#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

constexpr double kGravity = 9.81;

struct Followed {
  Touching touching;
  double time, gap;
  std::uint64_t poses;
};
Followed follow(const BodyDef& a, const BodyDef& b, double g = kGravity) {
  const CoursedPair pair(a, b, 1, {0, 0, -g});
  SearchWork work;
  PairMotion motion(pair.pair(), work);
  motion.go_to(0);
  NearestAxis axis = nearest_axis(motion, Vec3::Zero());
  const Touching touching = follow_touching(motion, axis, 1, pair.touch());
  return {touching, motion.time(), axis.gap, work.poses};
}

BodyDef ball(double speed, double spin = 0) {
  return moving(Sphere{0.1}, {0, 0, 0.1}, {0, 0, speed}, {0, spin, 0});
}
BodyDef wheel(double speed, double spin) {  // its axis along y
  return moving(Cylinder{0.1, 0.2}, {0, 0, 0.1}, {0, 0, speed}, {0, spin, 0},
                Quat(Eigen::AngleAxisd(1.57079632679489661923, Vec3::UnitX())));
}
BodyDef box(double speed, const Vec3& omega = Vec3::Zero()) {
  return moving(Box{{0.2, 0.2, 0.2}}, {0, 0, 0.1}, {0, 0, speed}, omega);
}

TEST(TouchingPair, ApproachesLeavesOrIsPressed) {
  for (const double v : {-3.0, -1e-6, -1e-9})
    EXPECT_EQ(follow(ball(v), ground()).touching, Touching::approaches) << v;
  // Out of a touch of 2e-11 m: v² > 2 g touch, so v > 2e-5 m/s.
  for (const double v : {3.0, 1e-3, 3e-5})
    EXPECT_EQ(follow(ball(v), ground()).touching, Touching::leaves) << v;
  for (const double v : {1e-5, 1e-7, 0.0})
    EXPECT_EQ(follow(ball(v), ground()).touching, Touching::pressed) << v;
}

TEST(TouchingPair, LeavesToATimeAtWhichItIsProvenOut) {
  const Followed f = follow(ball(1), ground());
  EXPECT_NEAR(f.time, 1 / kGravity, 1e-15);  // the top of its flight
  EXPECT_NEAR(f.gap, 0.5 / kGravity, 1e-15);
  EXPECT_EQ(f.poses, 2u);
}

TEST(TouchingPair, StaysWithNothingToPressIt) {
  EXPECT_EQ(follow(ball(0), ground(), 0).touching, Touching::stays);
  EXPECT_EQ(follow(ball(0, 10), ground(), 0).touching, Touching::stays);
  EXPECT_EQ(follow(box(0), floor(), 0).touching, Touching::stays);
}

TEST(TouchingPair, ABoxThatTurnsOnItsFaceLands) {
  EXPECT_EQ(follow(box(0, {0, 1, 0}), ground()).touching, Touching::approaches);
}

TEST(TouchingPair, ACornerThatLiftsFastLeavesHoweverPessimisticTheBound) {
  // The corner above c rises as it turns past; r ω² is 1.7e4 m/s², v²/2A far below touch.
  const double root = std::sqrt(3.0) * 0.1;
  const BodyDef spinner = moving(Box{{0.2, 0.2, 0.2}}, {0, 0, root}, {0, 0, 1e-3}, {310, 0, 0},
                                 Quat::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ()));
  EXPECT_EQ(follow(spinner, ground()).touching, Touching::leaves);
}

TEST(TouchingPair, WhatLeavesATurningPlateDoesSoWhereItIs) {
  // The plate's far corners move at 2 m/s, the place below the box at 0.5 m/s.
  const Quat corner = Quat::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ());
  for (const double turn : {-1.0, 1.0}) {
    const BodyDef plate = moving(Box{{4, 4, 0.1}}, {0, 0, -0.05}, Vec3::Zero(), Vec3(0, turn, 0));
    for (const double v : {-0.1, 0.1}) {
      const BodyDef box = moving(Box{{0.2, 0.2, 0.2}}, {0.5, 0, std::sqrt(3.0) * 0.1},
                                 {0, 0, v - 0.5 * turn}, Vec3::Zero(), corner);
      EXPECT_EQ(follow(box, plate, 0).touching, v < 0 ? Touching::approaches : Touching::leaves);
    }
  }
}

TEST(TouchingPair, AWheelThatSpinsInPlaceEndsInBoundedWork) {
  const Followed f = follow(wheel(0, 10), floor(), 0);
  EXPECT_TRUE(f.touching == Touching::pressed || f.touching == Touching::stays);
  EXPECT_LE(f.poses, 70u);
}

}  // namespace
}  // namespace poinsot::test
