#include "poinsot/collision/gjk.h"

#include <numbers>

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/fcl_oracle.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

// Every pair of shapes that have a core.
class EveryPair : public testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(Gjk, EveryPair,
                         testing::Combine(testing::Range<int>(kSphere, kHalfSpace),
                                          testing::Range<int>(kSphere, kHalfSpace)),
                         [](const auto& p) {
                           return name_of(std::get<0>(p.param)) + "_" +
                                  name_of(std::get<1>(p.param));
                         });

// Proves a separated result by itself: the points lie on the shapes, so the distance is no less
// than true; the slab along the normal is empty, so it is no more. `scale` [m]: of the coordinates.
void expect_proven(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                   const GjkResult& r, double scale, double gap) {
  const double radii = a.core_radius + b.core_radius, rounding = 20 * kRounding * scale;
  const Vec3 on_a = r.on_a - a.core_radius * r.normal;
  const Pose a_in_b = pose_b.inverse() * pose_a;
  const Vec3 on_b = a_in_b * Vec3(r.on_b + b.core_radius * r.normal);
  EXPECT_NEAR(outside_by(a.shape, on_a), 0, rounding + gap);
  EXPECT_NEAR(outside_by(b.shape, on_b), 0, rounding + gap);
  EXPECT_NEAR((r.on_a - r.on_b).norm(), r.distance, rounding);
  const double slab = separation(a.shape, pose_a, b.shape, pose_b, pose_a.q * r.normal) + radii;
  EXPECT_LE(r.lower, r.distance + rounding);
  EXPECT_LE(r.distance - gap, slab + rounding);
  EXPECT_LE(r.distance - r.lower, gap + rounding);
}

TEST_P(EveryPair, DistanceIsProvenByItsOwnPointsAndSlab) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(11 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  const double gap = kGjkGap;  // of radii up to 1.8 m
  int separated = 0;
  for (int i = 0; i < 1500; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const double reach = a.bounding_radius + b.bounding_radius;
    const Pose pose_b{pose_a.c + random.uniform(0.3, 1.2) * reach * random.direction(),
                      random.rotation()};
    const GjkResult r = gjk({a, pose_a, b, pose_b});
    EXPECT_LT(r.iterations, kGjkIterations);
    if (!r.separated) continue;
    ++separated;
    expect_proven(a, pose_a, b, pose_b, r, 2 * reach, 2 * gap);
    if (testing::Test::HasFailure()) FAIL() << "case " << i;
  }
  EXPECT_GT(separated, 200);
}

TEST_P(EveryPair, DistanceAgreesWithFcl) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(1100 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  // FCL stops on progress: its floor is 1e-5 of the size where a cylinder or a cone takes part.
  const bool exact = (kind_a == kBox || kind_a == kConvex) && (kind_b == kBox || kind_b == kConvex);
  const double tolerance = exact ? 1e-13 : 3e-5;
  for (int i = 0; i < 150; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const double reach = a.bounding_radius + b.bounding_radius;
    const Pose pose_b{pose_a.c + random.uniform(0.5, 1.2) * reach * random.direction(),
                      random.rotation()};
    const GjkResult r = gjk({a, pose_a, b, pose_b});
    const double gap = r.distance - a.core_radius - b.core_radius;
    if (!r.separated || gap < 1e-3) continue;
    ASSERT_NEAR(gap, fcl_distance(a.shape, pose_a, b.shape, pose_b), tolerance) << "case " << i;
  }
}

TEST_P(EveryPair, DistanceScalesFromTenthsOfMillimetresToTenKilometres) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(77 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (const double size : {1e-4, 1e-2, 1e4}) {
    for (int i = 0; i < 60; ++i) {
      const Collider a = collider(random_shape(kind_a, random, size));
      const Collider b = collider(random_shape(kind_b, random, size));
      const Pose pose_a{random.in_box(size), random.rotation()};
      const double reach = a.bounding_radius + b.bounding_radius;
      const Pose pose_b{pose_a.c + random.uniform(0.6, 1.2) * reach * random.direction(),
                        random.rotation()};
      const GjkResult r = gjk({a, pose_a, b, pose_b});
      if (!r.separated) continue;
      expect_proven(a, pose_a, b, pose_b, r, 2 * reach, 2 * kGjkGap * size);
      if (testing::Test::HasFailure()) FAIL() << "size " << size << " case " << i;
    }
  }
}

TEST_P(EveryPair, SmallAgainstHugeLosesOnlyRounding) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(78 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 100; ++i) {
    const Collider a = collider(random_shape(kind_a, random, 0.01));
    const Collider b = collider(random_shape(kind_b, random, 1000));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const double gap = random.log_uniform(1e-5, 1e-2);
    const Pose pose_b = pose_at_gap(a.shape, pose_a, b.shape, gap, random);
    const GjkResult r = gjk({a, pose_a, b, pose_b});
    if (!r.separated) continue;
    expect_proven(a, pose_a, b, pose_b, r, 4000, 0);  // the rounding of 1 km coordinates
    if (testing::Test::HasFailure()) FAIL() << "case " << i;
  }
}

TEST_P(EveryPair, NothingIsLostFarFromTheOrigin) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(79 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  const Vec3 far(1e6, -1e6, 1e6);
  for (int i = 0; i < 60; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{Vec3::Zero(), random.rotation()};
    const Pose pose_b{2 * random.direction(), random.rotation()};
    const GjkResult here = gjk({a, pose_a, b, pose_b});
    const GjkResult there = gjk({a, {far, pose_a.q}, b, {far + pose_b.c, pose_b.q}});
    ASSERT_EQ(here.separated, there.separated);
    if (!here.separated) continue;
    // Coordinates of 1e6 m are multiples of 1.2e-10 m.
    ASSERT_NEAR(here.distance, there.distance, 4e-10) << "case " << i;
  }
}

TEST_P(EveryPair, SwappingTheArgumentsSwapsTheAnswer) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(80 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 200; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{Vec3::Zero(), random.rotation()};
    const Pose pose_b{random.uniform(0.5, 2.5) * random.direction(), random.rotation()};
    const GjkResult ab = gjk({a, pose_a, b, pose_b}), ba = gjk({b, pose_b, a, pose_a});
    ASSERT_EQ(ab.separated, ba.separated) << "case " << i;
    if (!ab.separated) continue;
    ASSERT_NEAR(ab.distance, ba.distance, 4 * kGjkGap) << "case " << i;
  }
}

TEST_P(EveryPair, EarlyStopKeepsItsPromise) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(81 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 200; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{Vec3::Zero(), random.rotation()};
    const Pose pose_b{random.uniform(0.5, 2.5) * random.direction(), random.rotation()};
    const GjkResult full = gjk({a, pose_a, b, pose_b}), quick = gjk({a, pose_a, b, pose_b}, 0.1);
    ASSERT_EQ(full.separated, quick.separated);
    if (!full.separated) continue;
    ASSERT_LE(quick.lower, full.distance + 1e-14);
    ASSERT_GE(quick.distance, full.lower - 1e-14);
    if (full.distance <= 0.1) {
      ASSERT_EQ(quick.distance, full.distance);
    }
    if (quick.distance != full.distance) {
      ASSERT_GT(quick.lower, 0.1);
    }
    ASSERT_LE(quick.iterations, full.iterations);
  }
}

TEST_P(EveryPair, CoincidentCentresTouchAndEnd) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(82);
  for (int i = 0; i < 50; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose{random.in_box(1), random.rotation()};
    EXPECT_FALSE(gjk({a, pose, b, {pose.c, i % 2 ? pose.q : random.rotation()}}).separated);
  }
}

// Closed forms -----------------------------------------------------------------------------------

double distance_of(const Shape& a, const Shape& b, const Vec3& c,
                   const Quat& q = Quat::Identity()) {
  const Collider ca = collider(a), cb = collider(b);
  const GjkResult r = gjk({ca, {}, cb, {c, q}});
  return r.separated ? r.distance - ca.core_radius - cb.core_radius : -1;
}

TEST(Gjk, KnowsClosedForms) {
  const Quat quarter(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));
  const Quat eighth(Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitZ()));
  EXPECT_NEAR(distance_of(Sphere{0.5}, Sphere{0.25}, {1, 2, 2}), 2.25, 1e-15);
  EXPECT_NEAR(distance_of(Box{{2, 2, 2}}, Box{{2, 2, 2}}, {2.5, 0.3, -0.2}), 0.5, 1e-15);
  EXPECT_NEAR(distance_of(Box{{2, 2, 2}}, Box{{2, 2, 2}}, {3, 3, 3}), std::sqrt(3.0), 2e-15);
  EXPECT_NEAR(distance_of(Box{{2, 2, 2}}, Box{{2, 2, 2}}, {4, 0, 0}, eighth), 3 - std::sqrt(2.0),
              2e-15);
  EXPECT_NEAR(distance_of(Capsule{0.1, 2}, Capsule{0.2, 2}, {0, 0.5, 0}), 0.2, 1e-15);
  EXPECT_NEAR(distance_of(Capsule{0.1, 2}, Capsule{0.2, 2}, {0.5, 0, 0}, quarter), 0.2, 1e-15);
  EXPECT_NEAR(distance_of(Cylinder{0.5, 2}, Cylinder{0.25, 2}, {3, 4, 0.7}), 4.25, 1e-12);
  EXPECT_NEAR(distance_of(Cylinder{0.5, 2}, Cylinder{0.25, 2}, {0.1, 0.2, 2.5}), 0.5, 1e-12);
  EXPECT_NEAR(distance_of(Cylinder{0.5, 1}, Sphere{0.5}, {3.5, 0, 4.5}), 4.5, 1e-12);
  EXPECT_NEAR(distance_of(Cone{1, 1}, Sphere{0.1}, {0, 0, 2}), 1.4, 1e-12);
  EXPECT_NEAR(distance_of(Cone{1, 1}, Sphere{0.1}, {2, 0, 1.5}), 3 * std::sqrt(0.5) - 0.1, 1e-12);
  EXPECT_NEAR(distance_of(Cone{1, 1}, Sphere{0.1}, {1, 0, 0.5}), std::sqrt(0.5) - 0.1, 1e-12);
  EXPECT_NEAR(distance_of(Ellipsoid{{1, 2, 3}}, Ellipsoid{{3, 2, 1}}, {5, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(distance_of(Ellipsoid{{1, 2, 3}}, Sphere{1}, {0, 0, 5}), 1, 1e-12);
}

TEST(Gjk, ThinPlatesAndNeedlesKeepFullAccuracy) {
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const double thin = random.log_uniform(1e-6, 1e-2);
    const Shape plate = i % 2 ? Shape(Box{{1, 1, thin}}) : Shape(Cylinder{0.5, thin});
    const Shape needle = i % 4 < 2 ? Shape(Cylinder{thin, 2}) : Shape(Ellipsoid{{thin, thin, 1}});
    const Collider a = collider(plate), b = collider(needle);
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0.1, 1) * random.direction(), random.rotation()};
    const GjkResult r = gjk({a, pose_a, b, pose_b});
    if (!r.separated) continue;
    expect_proven(a, pose_a, b, pose_b, r, 4, kGjkGap);
    if (testing::Test::HasFailure()) FAIL() << "case " << i << " thickness " << thin;
  }
}

TEST(Gjk, FacesAtNanometreGapsAreMeasuredExactly) {
  const Collider box = collider(Box{{1, 1, 1}}), disc = collider(Cylinder{0.4, 1});
  for (const double gap : {1e-3, 1e-5, 1e-7, 1e-9}) {
    for (const double offset : {0.0, 0.1, 0.37}) {
      const Pose above{{offset, -0.2 * offset, 1 + gap}, Quat::Identity()};
      for (const Collider* other : {&box, &disc}) {
        const GjkResult r = gjk({box, {}, *other, above});
        ASSERT_TRUE(r.separated);
        EXPECT_NEAR(r.distance, gap, 1e-15);
        // A direction from two points `gap` apart, each rounded.
        EXPECT_NEAR(r.normal.z(), -1, 1e-12);
      }
    }
  }
}

TEST(Gjk, TouchingCoresAreNotSeparated) {
  const Collider box = collider(Box{{1, 1, 1}});
  for (const double offset : {0.0, 0.3, 1.0}) {
    EXPECT_FALSE(gjk({box, {}, box, {{offset, 0, 1}, Quat::Identity()}}).separated);
    EXPECT_FALSE(gjk({box, {}, box, {{offset, offset, 1}, Quat::Identity()}}).separated);
  }
  const Collider round = collider(Ellipsoid{{1, 1, 1}});
  EXPECT_FALSE(gjk({round, {}, round, {{2, 0, 0}, Quat::Identity()}}).separated);
}

}  // namespace
}  // namespace poinsot::test
