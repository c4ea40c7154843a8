// Geometry made to break kernels: needles, foils, specks against giants, far places, poses that are
// no poses. Every pair has to give a right answer, or say that it knows nothing.

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

constexpr double kThin = 1e-9, kLong = 1e4;

Convex plate(const Vec3& size) {
  return box_as_convex(size);
}

// Of every kind: an ordinary one, a foil, a needle, a giant, a speck.
std::vector<Shape> shapes_of(int kind) {
  switch (kind) {
    case kSphere:
      return {Sphere{0.5}, Sphere{kThin}, Sphere{kLong}, Sphere{1e-4}};
    case kBox:
      return {Box{{1, 0.7, 0.4}}, Box{{1, 1, kThin}}, Box{{1, 1e-4, 1e-4}}, Box{{kLong, 1, 1}},
              Box{{1e-4, 2e-4, 1e-4}}};
    case kCapsule:
      return {Capsule{0.3, 1}, Capsule{kThin, 1}, Capsule{1, kLong}, Capsule{1e-4, 1e-4}};
    case kCylinder:
      return {Cylinder{0.4, 1}, Cylinder{1, kThin}, Cylinder{1e-4, 1}, Cylinder{1, kLong},
              Cylinder{1e-4, 1e-4}};
    case kCone:
      return {Cone{0.4, 1}, Cone{1, kThin}, Cone{1e-4, 1}, Cone{1, kLong}, Cone{1e-4, 1e-4}};
    case kEllipsoid:
      return {Ellipsoid{{0.5, 0.3, 0.7}}, Ellipsoid{{1, 1, kThin}}, Ellipsoid{{1e-4, 1e-4, 1}},
              Ellipsoid{{kLong, 1, 1}}, Ellipsoid{{1e-4, 2e-4, 1e-4}}};
    case kConvex:
      return {plate({1, 0.7, 0.4}), plate({1, 1, 1e-4}), plate({0.001, 0.001, 1}),
              prism(64, 1, kLong), plate({1e-4, 2e-4, 1e-4})};
    default:
      return {HalfSpace{Vec3(0.6, 0, 0.8), 0.2}, HalfSpace{}};
  }
}

class HostilePair : public testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(Proximity, HostilePair,
                         testing::Combine(testing::Range<int>(kSphere, kHalfSpace),
                                          testing::Range<int>(kSphere, kHalfSpace + 1)),
                         [](const auto& p) {
                           return name_of(std::get<0>(p.param)) + "_" +
                                  name_of(std::get<1>(p.param));
                         });

double reach(const Shape& shape) {
  return std::holds_alternative<HalfSpace>(shape) ? 1 : bounding_radius(shape);
}

// [m] What a round foil's thickness may be lost of: nothing, unless it is thinner than 1e-8 radii.
double unresolved(const Collider& c) {
  return c.is_curved && c.size < 1e-8 * c.bounding_radius ? 4 * c.size : 0;
}

// The bounds against the shapes' own closed forms. `scale` [m]: of what coordinates are rounded to.
void expect_right(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                  double scale, const std::string& where) {
  const double rounding = 1e-14 * scale;
  const Gap gap = find_gap(a, pose_a, b, pose_b);
  ASSERT_TRUE(std::isfinite(gap.value) && std::isfinite(gap.lower)) << where;
  ASSERT_TRUE(gap.point_a.allFinite() && gap.point_b.allFinite()) << where;
  ASSERT_NEAR(gap.normal.norm(), 1, 1e-12) << where;
  const double slab = separation(a.shape, pose_a, b.shape, pose_b, gap.normal);
  EXPECT_NEAR(gap.lower, slab, rounding) << where;
  EXPECT_LE(gap.lower, gap.value) << where;
  if (gap.value > rounding) {
    const double foils = unresolved(a) + unresolved(b);
    const double small = std::min(a.bounding_radius, b.bounding_radius);
    EXPECT_LE(gap.value - gap.lower, 1e-11 * small + foils + 20 * rounding) << where;
    EXPECT_NEAR((gap.point_a - gap.point_b).norm(), gap.value, rounding) << where;
    EXPECT_LE(outside_by(a.shape, pose_a.inverse() * gap.point_a), rounding) << where;
    EXPECT_LE(outside_by(b.shape, pose_b.inverse() * gap.point_b), rounding) << where;
  }
  Manifold m;
  find_manifold(a, pose_a, b, pose_b, 0.1 * std::min(a.size, b.size), m);
  ASSERT_LE(m.count, Manifold::kMaxPoints) << where;
  ASSERT_NEAR(m.normal.norm(), 1, 1e-12) << where;
  for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
    ASSERT_TRUE(m.points[k].point.allFinite()) << where;
    ASSERT_TRUE(std::isfinite(m.points[k].gap)) << where;
  }
}

std::string place(std::size_t i, std::size_t j, int k) {
  return "shapes " + std::to_string(i) + ", " + std::to_string(j) + ", case " + std::to_string(k);
}

TEST_P(HostilePair, FoilsNeedlesSpecksAndGiantsAreMeasured) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(900 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  const std::vector<Shape> as = shapes_of(kind_a), bs = shapes_of(kind_b);
  for (std::size_t i = 0; i < as.size(); ++i) {
    for (std::size_t j = 0; j < bs.size(); ++j) {
      const Collider a = collider(as[i], 4), b = collider(bs[j], 9);
      const double both = reach(as[i]) + reach(bs[j]);
      for (int k = 0; k < 40; ++k) {
        const Pose pose_a{random.in_box(1), random.rotation()};
        Pose pose_b{pose_a.c + random.log_uniform(1e-3, 1.2) * both * random.direction(),
                    k % 4 ? random.rotation() : pose_a.q};
        expect_right(a, pose_a, b, pose_b, 2 * both + 2, place(i, j, k));
        if (HasFailure()) return;
      }
    }
  }
}

TEST_P(HostilePair, CoincidentCentresArePartedTheWayTheyCan) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(910);
  const std::vector<Shape> as = shapes_of(kind_a), bs = shapes_of(kind_b);
  for (std::size_t i = 0; i < as.size(); ++i) {
    for (std::size_t j = 0; j < bs.size(); ++j) {
      const Collider a = collider(as[i], 4), b = collider(bs[j], 9);
      for (int k = 0; k < 4; ++k) {
        const Pose pose{random.in_box(1), random.rotation()};
        const Pose other{pose.c, k % 2 ? pose.q : random.rotation()};
        expect_right(a, pose, b, other, 2 * (reach(as[i]) + reach(bs[j])) + 2, place(i, j, k));
        if (HasFailure()) return;
      }
    }
  }
}

TEST_P(HostilePair, NothingButRoundingIsLostFarFromTheOrigin) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(920 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  const Vec3 far(1e5, -1e5, 1e5);
  for (int k = 0; k < 100; ++k) {
    const Collider a = collider(random_shape(kind_a, random), 4),
                   b = collider(random_shape(kind_b, random), 9);
    const Pose pose_a{far, random.rotation()};
    Pose pose_b{far + random.uniform(0, 3) * random.direction(), random.rotation()};
    // Coordinates of 1e5 m are multiples of 1.5e-11 m: ours, and those of the judge.
    expect_right(a, pose_a, b, pose_b, 1e5, place(0, 0, k));
    const Gap there = find_gap(a, pose_a, b, pose_b);
    if (kind_b == kHalfSpace || there.value < 0) continue;
    const Gap here = find_gap(a, {Vec3::Zero(), pose_a.q}, b, {pose_b.c - far, pose_b.q});
    EXPECT_NEAR(there.value, here.value, 2e-15 * 3) << "case " << k;
  }
}

TEST_P(HostilePair, NoPoseGivesNoPointsAndNoBounds) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(930);
  const Collider a = collider(random_shape(kind_a, random), 4),
                 b = collider(random_shape(kind_b, random), 9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const Quat none = Quat::Identity();
  for (const Pose& bad :
       {Pose{{nan, 0, 0}, none}, Pose{{0, 0, infinite}, none}, Pose{{0, -1e200, 0}, none},
        Pose{Vec3::Zero(), Quat(nan, 0, 0, 0)}, Pose{Vec3::Zero(), Quat(1, 0, infinite, 0)},
        Pose{Vec3::Constant(nan), Quat(nan, nan, nan, nan)}}) {
    for (const bool first : {true, false}) {
      const Pose &pose_a = first ? bad : Pose{}, &pose_b = first ? Pose{} : bad;
      Manifold m;
      m.count = 3;
      find_manifold(a, pose_a, b, pose_b, 0.1, m);
      EXPECT_EQ(m.count, 0);
      GapHint hint;
      const Gap gap = find_gap(a, pose_a, b, pose_b, &hint);
      EXPECT_EQ(gap.value, infinite);
      EXPECT_EQ(gap.lower, -infinite);
      EXPECT_EQ(gap.normal.norm(), 1);
      EXPECT_TRUE(gap.point_a.allFinite() && gap.point_b.allFinite());
      EXPECT_FALSE(hint.valid);
    }
  }
}

TEST(HostileHull, FlatAndEmptyHullsAreRefused) {
  const auto hull = [](std::vector<Vec3> points) { return convex_hull(points); };
  EXPECT_ANY_THROW(hull({}));
  EXPECT_ANY_THROW(hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_ANY_THROW(hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_ANY_THROW(hull({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}));
}

TEST(HostileHull, DoubledAndInnerPointsChangeNothing) {
  Random random(940);
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) points.push_back(random.direction());
  const Convex clean = convex_hull(points);
  for (int i = 0; i < 40; ++i) {
    points.push_back(points[static_cast<std::size_t>(i)]);
    points.push_back(0.3 * random.direction());
  }
  const Convex crowded = convex_hull(points);
  const Collider box = collider(Box{{1, 1, 1}}, 0);
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random.uniform(0, 3) * random.direction(), random.rotation()};
    EXPECT_EQ(find_gap(box, {}, collider(clean, 1), pose).value,
              find_gap(box, {}, collider(crowded, 1), pose).value);
  }
}

}  // namespace
}  // namespace poinsot::test
