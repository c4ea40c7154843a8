#include "poinsot/collision/collider.h"

#include <gtest/gtest.h>

#include "support/geometry.h"

namespace poinsot::test {
namespace {

class EveryShape : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Collider, EveryShape, testing::Range<int>(kSphere, kHalfSpace),
                         [](const auto& p) { return name_of(p.param); });

// Points on the surface: where rays from the origin leave the shape, by bisection on membership.
std::vector<Vec3> surface(const Shape& shape, int n) {
  std::vector<Vec3> points;
  for (const Vec3& d : directions(n)) {
    double in = 0, out = 2 * bounding_radius(shape);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (in + out);
      (outside_by(shape, middle * d) <= 0 ? in : out) = middle;
    }
    points.push_back(in * d);
  }
  return points;
}

TEST_P(EveryShape, SupportLiesOnTheSurfaceAndNoPointIsFartherAlong) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Collider c = collider(random_shape(GetParam(), random));
    const std::vector<Vec3> points = surface(c.shape, 500);
    for (int k = 0; k < 100; ++k) {
      const Vec3 d = random.log_uniform(1e-8, 1e8) * random.direction();
      const Vec3 p = support(c, d) + c.core_radius * d.normalized();
      EXPECT_NEAR(outside_by(c.shape, p), 0, 1e-14);
      EXPECT_NEAR(p.dot(d), support_width(c.shape, d), 1e-14 * d.norm());
      for (const Vec3& q : points) ASSERT_LE(q.dot(d), p.dot(d) + 1e-13 * d.norm());
    }
  }
}

TEST_P(EveryShape, SupportAlongAnAxisIsFinite) {
  Random random(2);
  const Collider c = collider(random_shape(GetParam(), random));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0, 1e-300, 0.0}) {
      const Vec3 d = sign * Vec3::Unit(axis);
      const Vec3 p = support(c, d);
      EXPECT_TRUE(p.allFinite());
      EXPECT_LE(outside_by(c.shape, p), 1e-15);
    }
  }
}

TEST_P(EveryShape, BoundsAreTightAndContain) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Collider c = collider(random_shape(GetParam(), random));
    const Pose pose{random.in_box(10), random.rotation()};
    const Aabb box = bounds(c, pose);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Vec3 d = pose.q.conjugate() * Vec3(Vec3::Unit(axis));
      EXPECT_NEAR(box.high[axis], pose.c[axis] + support_width(c.shape, d), 1e-14);
      EXPECT_NEAR(box.low[axis], pose.c[axis] - support_width(c.shape, -d), 1e-14);
    }
    for (const Vec3& p : surface(c.shape, 50))
      EXPECT_TRUE(box.grown(1e-13).contains({pose * p, pose * p}));
  }
}

TEST_P(EveryShape, SizeIsTheSmallestExtent) {
  Random random(4);
  const std::vector<Vec3> around = directions(5000);
  for (int i = 0; i < 20; ++i) {
    const Collider c = collider(random_shape(GetParam(), random));
    const auto width = [&](const Vec3& d) {
      return support_width(c.shape, d) + support_width(c.shape, -d);
    };
    double along_axes = std::numeric_limits<double>::infinity(), least = along_axes;
    for (int axis = 0; axis < 3; ++axis) along_axes = std::min(along_axes, width(Vec3::Unit(axis)));
    for (const Vec3& d : around) least = std::min(least, width(d));
    // A cone is thinnest somewhat aslant, a polyhedron across a face or between two edges.
    const bool aslant = GetParam() == kCone || GetParam() == kConvex;
    if (!aslant) {
      EXPECT_NEAR(c.size, along_axes, 1e-15);
    }
    EXPECT_GE(least, c.size * (aslant ? 0.5 : 1 - 1e-12));
    EXPECT_LE(c.size, along_axes * 1.2);
  }
}

TEST_P(EveryShape, FeatureCornersLieOnTheCoreAndTurnCounterClockwise) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Collider c = collider(random_shape(GetParam(), random));
    const Vec3 d = i < 6 ? Vec3((i % 2 ? 1 : -1) * Vec3::Unit(i / 2)) : random.direction();
    const Feature f = support_feature(c, d);
    ASSERT_GE(f.count, 1);
    for (int k = 0; k < f.count; ++k) {
      if (c.core_radius > 0) {  // a sphere's or a capsule's core
        EXPECT_NEAR(outside_by(c.shape, f[k]), -c.core_radius, 1e-15);
      } else {
        EXPECT_NEAR(outside_by(c.shape, f[k]), 0, 1e-14);
      }
    }
    for (int k = 0; f.count > 2 && k < f.count; ++k) {
      const Vec3 side = f[(k + 1) % f.count] - f[k], next = f[(k + 2) % f.count] - f[k];
      EXPECT_GT(side.cross(next).dot(d), 0) << "corner " << k;
      EXPECT_GT(side.cross(next).dot(f[k]), 0) << "corner " << k;
    }
  }
}

TEST_P(EveryShape, FeatureOfAFaceNormalIsThatFace) {
  Random random(6);
  const Collider c = collider(random_shape(GetParam(), random));
  const Vec3 down = -Vec3::UnitZ();
  const Feature f = support_feature(c, down);
  const double low = -support_width(c.shape, down) + c.core_radius;
  const int expected[] = {1, 4, 2, 8, 8, 1, 3};
  EXPECT_EQ(f.count, expected[GetParam()]);
  if (GetParam() == kConvex || GetParam() == kCapsule) return;
  for (int k = 0; k < f.count; ++k) EXPECT_NEAR(f[k].z(), low, 1e-15);
}

TEST(Collider, FacesOfManyCornersAreThinned) {
  const Collider c = collider(prism(48, 1, 0.5));
  const Feature f = support_feature(c, Vec3::UnitZ());
  EXPECT_EQ(f.count, Feature::kMaxCorners);
  for (int k = 0; k < f.count; ++k) EXPECT_NEAR((f[k] - f[(k + 1) % f.count]).norm(), 0.39, 0.01);
}

TEST(Collider, ConeStandsOnItsBaseAndLiesOnItsSide) {
  const Collider c = collider(Cone{0.5, 2});
  const Feature side = support_feature(c, Vec3(2, 0, 0.5).normalized());
  ASSERT_EQ(side.count, 2);
  EXPECT_NEAR((side[0] - Vec3(0.5, 0, -1)).norm(), 0, 1e-15);
  EXPECT_NEAR((side[1] - Vec3(0, 0, 1)).norm(), 0, 1e-15);
  EXPECT_EQ(support(c, Vec3::UnitZ()), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace poinsot::test
