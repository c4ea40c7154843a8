#include "poinsot/collision/half_space.h"

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

class EveryShapeOnAPlane : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(HalfSpace, EveryShapeOnAPlane, testing::Range<int>(kSphere, kHalfSpace),
                         [](const auto& p) { return name_of(p.param); });

const Collider& ground() {
  static const Collider plane = collider(HalfSpace{Vec3::UnitZ(), 0}, 1);
  return plane;
}

Manifold on_ground(const Shape& shape, const Pose& pose, double margin) {
  Manifold m;
  find_manifold(collider(shape), pose, ground(), {}, margin, m);
  return m;
}

TEST_P(EveryShapeOnAPlane, LeastGapIsTheHeightOfTheLowestPoint) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Shape shape = random_shape(GetParam(), random);
    const Pose plane_pose{random.in_box(5), random.rotation()};
    const HalfSpace plane{random.direction(), random.uniform(-1, 1)};
    const Pose pose{random.in_box(5), random.rotation()};
    const Vec3 n = plane_pose.q * plane.normal;
    const double height =
        n.dot(pose.c - plane_pose.c) - plane.offset - support_width(shape, pose.q.conjugate() * -n);
    Manifold m;
    const Collider a = collider(shape, 0), b = collider(plane, 1);
    find_manifold(a, pose, b, plane_pose, height + 0.01, m);
    ASSERT_GE(m.count, 1);
    double least = 1e9;
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
      const ManifoldPoint& p = m.points[k];
      least = std::min(least, p.gap);
      EXPECT_LE(p.gap, height + 0.01 + 1e-12);
      // Midway: as far above the plane as the shape's surface point is above it.
      EXPECT_NEAR(n.dot(p.point - plane_pose.c) - plane.offset, 0.5 * p.gap, 4e-14);
      const Vec3 on_shape = pose.inverse() * Vec3(p.point + 0.5 * p.gap * n);
      EXPECT_LE(outside_by(shape, on_shape), 3e-14);
      if (p.gap == height) {
        EXPECT_NEAR(outside_by(shape, on_shape), 0, 3e-14);
      }
    }
    EXPECT_NEAR(least, height, 2 * kSameGap * a.size + 1e-14) << "case " << i;
    EXPECT_NEAR((m.normal - n).norm(), 0, 1e-14);
    const Gap gap = find_gap(a, pose, b, plane_pose);
    EXPECT_NEAR(gap.value, height, 1e-14);
    EXPECT_EQ(gap.value, gap.lower);
    find_manifold(a, pose, b, plane_pose, height - 1e-6, m);
    EXPECT_EQ(m.count, 0);
  }
}

TEST(HalfSpace, ConeIsRightStandingLyingAndUpsideDown) {
  const Cone cone{0.5, 2};
  const Manifold standing = on_ground(cone, {{0, 0, 1.001}, Quat::Identity()}, 0.01);
  ASSERT_EQ(standing.count, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(standing.points[k].gap, 1e-3, 1e-15);

  const Quat over(Eigen::AngleAxisd(3.14159265358979312, Vec3::UnitX()));
  const Manifold inverted = on_ground(cone, {{0, 0, 0.999}, over}, 0.01);
  ASSERT_EQ(inverted.count, 1);
  EXPECT_NEAR(inverted.points[0].gap, -1e-3, 1e-15);
  EXPECT_NEAR(inverted.points[0].point.head<2>().norm(), 0, 1e-15);

  // On its side: the axis rises by the half angle, the centre is half-way up the axis.
  const double half_angle = std::atan2(0.5, 2.0);
  const Quat side(Eigen::AngleAxisd(0.5 * 3.14159265358979312 + half_angle, Vec3::UnitY()));
  const double height = std::sin(half_angle) * 1;  // of the middle of the axis above the generator
  const Manifold lying = on_ground(cone, {{0, 0, height}, side}, 0.01);
  ASSERT_EQ(lying.count, 2);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(lying.points[k].gap, 0, 1e-15);
  EXPECT_NEAR((lying.points[0].point - lying.points[1].point).norm(), std::sqrt(4.25), 1e-14);
}

TEST(HalfSpace, TiltedCylinderKeepsItsLowestRimPointAndItsRing) {
  const Cylinder cylinder{0.5, 1};
  for (const double tilt : {0.0, 1e-9, 1e-6, 1e-4, 1e-3}) {
    for (int turn = 0; turn < 16; ++turn) {
      const double angle = 0.13 * turn;
      const Quat q(Eigen::AngleAxisd(tilt, Vec3(std::cos(angle), std::sin(angle), 0)));
      const double height = 0.5 * std::cos(tilt) + 0.5 * std::sin(tilt);
      const Manifold m = on_ground(cylinder, {{0, 0, height}, q}, 0.02);
      ASSERT_EQ(m.count, 4) << "tilt " << tilt;
      double least = 1;
      Vec3 middle = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) {
        least = std::min(least, m.points[k].gap);
        middle += 0.25 * m.points[k].point;
        EXPECT_NEAR(m.points[k].point.head<2>().norm(), 0.5, 2e-3);
      }
      // The rim's lowest point may give way to a corner as low, and that to another.
      EXPECT_NEAR(least, 0, 2 * kSameGap);
      EXPECT_LT(middle.head<2>().norm(), 0.1);
    }
  }
}

TEST(HalfSpace, LyingCylinderAndCapsuleTouchAtTwoPoints) {
  const Quat side(Eigen::AngleAxisd(0.5 * 3.14159265358979312, Vec3::UnitX()));
  for (const Shape& shape : {Shape(Cylinder{0.2, 3}), Shape(Capsule{0.2, 3})}) {
    const Manifold m = on_ground(shape, {{0, 0, 0.2}, side}, 0.01);
    ASSERT_EQ(m.count, 2);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(m.points[k].gap, 0, 1e-15);
      EXPECT_NEAR(std::abs(m.points[k].point.y()), 1.5, 1e-15);
    }
  }
}

TEST(HalfSpace, AThinPlateTouchesWithItsLowerFaceOnly) {
  const Manifold m = on_ground(Box{{1, 1, 1e-3}}, {{0, 0, 0.5e-3}, Quat::Identity()}, 0.1);
  ASSERT_EQ(m.count, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].gap, 0, 1e-18);
}

TEST(HalfSpace, RestingPointsDoNotJumpWithTheLastBits) {
  Random random(2);
  const Cylinder cylinder{0.5, 1};
  const Manifold before = on_ground(cylinder, {{0, 0, 0.5}, Quat::Identity()}, 0.02);
  for (int i = 0; i < 100; ++i) {
    const Quat q(Eigen::AngleAxisd(random.uniform(0, 1e-8), random.direction()));
    const Manifold m = on_ground(cylinder, {{0, 0, 0.5}, q}, 0.02);
    ASSERT_EQ(m.count, before.count);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR((m.points[k].point - before.points[k].point).norm(), 0, 1e-7);
  }
}

}  // namespace
}  // namespace poinsot::test
