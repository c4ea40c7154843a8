#include "poinsot/collision/proximity.h"

#include <gtest/gtest.h>

#include "poinsot/collision/pair_table.h"
#include "support/allocation_counter.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

double least_gap(const Manifold& m) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k)
    least = std::min(least, m.points[k].gap);
  return least;
}

TEST(PairTable, HasNoHoleButWhatNoForceMoves) {
  for (std::size_t a = 0; a < kShapeCount; ++a) {
    for (std::size_t b = 0; b < kShapeCount; ++b) {
      const char kernel = kPairTable[a][b];
      if (b < a) {
        EXPECT_EQ(kernel, ' ');
      } else if (a >= kHalfSpace) {
        EXPECT_EQ(kernel, '-');
      } else if (b == kMesh) {
        EXPECT_EQ(kernel, 'M');
      } else {
        EXPECT_NE(std::string("FBGH").find(kernel), std::string::npos);
      }
    }
  }
}

class EachPair : public testing::TestWithParam<std::tuple<int, int>> {};
INSTANTIATE_TEST_SUITE_P(Proximity, EachPair,
                         testing::Combine(testing::Range<int>(kSphere, kHalfSpace),
                                          testing::Range<int>(kSphere, kHalfSpace + 1)),
                         [](const auto& p) {
                           return name_of(std::get<0>(p.param)) + "_" +
                                  name_of(std::get<1>(p.param));
                         });

// A random pair whose gap is about `gap`.
struct Placed {
  Collider a, b;
  Pose pose_a, pose_b;
};
Placed placed(int kind_a, int kind_b, double gap, Random& random) {
  const Collider a = collider(random_shape(kind_a, random), 4),
                 b = collider(random_shape(kind_b, random), 9);
  const Pose pose_a{random.in_box(2), random.rotation()};
  if (kind_b != kHalfSpace)
    return {a, b, pose_a, pose_at_gap(a.shape, pose_a, b.shape, gap, random)};
  const Pose pose_b{Vec3::Zero(), random.rotation()};
  const HalfSpace& plane = std::get<HalfSpace>(b.shape);
  const Vec3 n = pose_b.q * plane.normal;
  const double height = n.dot(pose_a.c) - support_width(a.shape, pose_a.q.conjugate() * -n);
  return {a, b, pose_a, {(height - plane.offset - gap) * n, pose_b.q}};
}

TEST_P(EachPair, LeastGapIsTheSignedDistance) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(100 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 60; ++i) {
    const Placed p = placed(kind_a, kind_b, random.uniform(-0.05, 0.05), random);
    const double size = std::min(p.a.size, p.b.size), margin = 0.2;
    Manifold m;
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, margin, m);
    ASSERT_GE(m.count, 1) << "case " << i;
    ASSERT_TRUE(m.normal.allFinite());
    ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
    const double least = least_gap(m);
    // The slab along the normal bounds the gap from below, whatever its sign, and no direction has
    // a wider one. (Points on both shapes bound it from above where they are apart: gjk_test.)
    const double slab = separation(p.a.shape, p.pose_a, p.b.shape, p.pose_b, m.normal);
    const double tolerance = 2 * kSameGap * size + 3e-6;  // box–box: kEdgeAdvantage
    EXPECT_NEAR(least, slab, tolerance) << "case " << i;
    const Gap gap = find_gap(p.a, p.pose_a, p.b, p.pose_b);
    EXPECT_NEAR(gap.value, least, tolerance);
    EXPECT_LE(gap.lower, gap.value);
    EXPECT_GE(gap.lower, gap.value - 2e-8);
    if (kind_b != kHalfSpace) {
      const double truth = sampled_gap(p.a.shape, p.pose_a, p.b.shape, p.pose_b);
      EXPECT_GE(least, truth - tolerance) << "case " << i;
      EXPECT_GE(gap.value, truth - 1e-12) << "case " << i;
      EXPECT_GE(gap.lower, truth - 2e-8) << "case " << i;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
      const double half =
          0.5 * std::abs(m.points[k].gap) + 5e-4;  // octagons, edges cut at an angle
      EXPECT_LE(outside_by(p.a.shape, p.pose_a.inverse() * m.points[k].point), half);
      EXPECT_LE(outside_by(p.b.shape, p.pose_b.inverse() * m.points[k].point), half);
      EXPECT_LE(m.points[k].gap, margin + 1e-12);
    }
    if (testing::Test::HasFailure()) FAIL() << "case " << i;
  }
}

// The certificate, checked with the shapes' own closed forms: points on the surfaces, as far apart
// as `value` says, and a slab along the normal as wide as `lower` says.
TEST_P(EachPair, GapBringsItsOwnProof) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(150 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  GapHint hint;
  for (int i = 0; i < 200; ++i) {
    const Placed p = placed(kind_a, kind_b, random.uniform(-0.05, 0.3), random);
    const Gap gap = find_gap(p.a, p.pose_a, p.b, p.pose_b, i % 2 ? &hint : nullptr);
    ASSERT_NEAR(gap.normal.norm(), 1, 1e-12);
    ASSERT_NEAR(separation(p.a.shape, p.pose_a, p.b.shape, p.pose_b, gap.normal), gap.lower, 1e-13)
        << "case " << i;
    if (gap.value > 0) {
      ASSERT_NEAR((gap.point_a - gap.point_b).norm(), gap.value, 1e-13) << "case " << i;
      ASSERT_LE(outside_by(p.a.shape, p.pose_a.inverse() * gap.point_a), 1e-13) << "case " << i;
      ASSERT_LE(outside_by(p.b.shape, p.pose_b.inverse() * gap.point_b), 1e-13) << "case " << i;
    }
    if (i % 2) {
      ASSERT_TRUE(hint.valid);
      ASSERT_EQ(hint.axis, gap.normal);
    }
  }
}

// b is moved along the normal until the gap is about as wanted.
Gap moved_to(Placed& p, double wanted) {
  for (int i = 0; i < 6; ++i) {
    const Gap gap = find_gap(p.a, p.pose_a, p.b, p.pose_b);
    if (std::abs(gap.value - wanted) < 0.5 * std::abs(wanted)) return gap;
    p.pose_b.c -= (wanted - gap.value) * gap.normal;
  }
  return find_gap(p.a, p.pose_a, p.b, p.pose_b);
}

// Relative to the smaller radius. A corner a nanometre beside a rim leaves Newton's method no
// curvature to go by; then the last search's own bounds hold, and the pose counts as rare.
// bench_gap_accuracy does the same with as many poses as wanted.
constexpr double kApartAccuracy = 1e-11, kRareAccuracy = 1e-9, kDepthAccuracy = 4e-9;

TEST_P(EachPair, GapIsKnownFromNanometresToTwoSizes) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(160 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  int reached = 0, rare = 0;
  for (const double size : {1.0, 1e-4, 1e4}) {
    const int poses = size == 1 ? 2000 : 200;
    for (int i = 0; i < poses; ++i) {
      const Collider a = collider(random_shape(kind_a, random, size), 4),
                     b = collider(random_shape(kind_b, random, size), 9);
      const double small = std::min(a.bounding_radius, b.bounding_radius);
      const double wanted = small * random.log_uniform(1e-9, 2);
      Placed p{a, b, {random.in_box(size), random.rotation()}, {Vec3::Zero(), random.rotation()}};
      p.pose_b.c = p.pose_a.c + 1.5 * size * random.direction();
      const Gap gap = moved_to(p, wanted);
      const double slab = separation(a.shape, p.pose_a, b.shape, p.pose_b, gap.normal);
      const double accuracy = gap.value > 0 ? kRareAccuracy : kDepthAccuracy;
      ASSERT_LE(gap.value - slab, accuracy * small) << "case " << i << " wanted " << wanted;
      if (gap.value <= 0) continue;
      rare += gap.value - slab > kApartAccuracy * small;
      ++reached;
      const double rounding = 1e-14 * size;
      ASSERT_NEAR((gap.point_a - gap.point_b).norm(), gap.value, rounding) << "case " << i;
      ASSERT_LE(outside_by(a.shape, p.pose_a.inverse() * gap.point_a), rounding) << "case " << i;
      ASSERT_LE(outside_by(b.shape, p.pose_b.inverse() * gap.point_b), rounding) << "case " << i;
    }
  }
  EXPECT_GT(reached, 2300);
  EXPECT_LE(rare, 1);
}

TEST_P(EachPair, NothingIsFoundBeyondTheMargin) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(200 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 60; ++i) {
    const Placed p = placed(kind_a, kind_b, random.uniform(0.01, 0.1), random);
    const double gap = find_gap(p.a, p.pose_a, p.b, p.pose_b).value;
    Manifold m;
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, gap - 1e-5, m);
    EXPECT_EQ(m.count, 0) << "case " << i;
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, gap + 1e-5, m);
    EXPECT_GE(m.count, 1) << "case " << i;
  }
}

TEST_P(EachPair, SwappingTheArgumentsGivesTheSameBits) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(300 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 100; ++i) {
    const Placed p = placed(kind_a, kind_b, random.uniform(-0.05, 0.05), random);
    Manifold ab, ba;
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, 0.1, ab);
    find_manifold(p.b, p.pose_b, p.a, p.pose_a, 0.1, ba);
    ASSERT_EQ(ab.count, ba.count);
    ASSERT_EQ(ab.normal, Vec3(-ba.normal));
    for (std::size_t k = 0; k < static_cast<std::size_t>(ab.count); ++k) {
      ASSERT_EQ(ab.points[k].point, ba.points[k].point);
      ASSERT_EQ(ab.points[k].gap, ba.points[k].gap);
      ASSERT_EQ(ab.points[k].feature, ba.points[k].feature);
    }
    const Gap one = find_gap(p.a, p.pose_a, p.b, p.pose_b),
              two = find_gap(p.b, p.pose_b, p.a, p.pose_a);
    ASSERT_EQ(one.value, two.value);
    ASSERT_EQ(one.lower, two.lower);
    ASSERT_EQ(one.normal, Vec3(-two.normal));
    ASSERT_EQ(one.point_a, two.point_b);
    ASSERT_EQ(one.point_b, two.point_a);
  }
}

TEST_P(EachPair, QueriesDoNotAllocate) {
  if (!can_count_allocations()) GTEST_SKIP() << "a sanitizer owns malloc";
  const auto [kind_a, kind_b] = GetParam();
  Random random(400);
  std::vector<Placed> cases;
  for (int i = 0; i < 30; ++i)
    cases.push_back(placed(kind_a, kind_b, random.uniform(-0.05, 0.05), random));
  Manifold m;
  find_manifold(cases[0].a, cases[0].pose_a, cases[0].b, cases[0].pose_b, 0.1, m);  // first use
  const std::size_t before = allocations();
  for (const Placed& p : cases) {
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, 0.1, m);
    find_gap(p.a, p.pose_a, p.b, p.pose_b);
  }
  EXPECT_EQ(allocations(), before);
}

// Spheres by FCL --------------------------------------------------------------------------------

class SphereAgainst : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Proximity, SphereAgainst, testing::Range<int>(kSphere, kCone),
                         [](const auto& p) { return name_of(p.param); });

TEST_P(SphereAgainst, ClosedFormEqualsTheGeneralKernel) {
  Random random(500 + static_cast<std::uint64_t>(GetParam()));
  int deep = 0;
  for (int i = 0; i < 4000; ++i) {
    const Collider a = collider(random_shape(kSphere, random), 0),
                   b = collider(random_shape(GetParam(), random), 1);
    const Pose pose_b{random.in_box(2), random.rotation()};
    const Pose pose_a{pose_b.c + random.uniform(0, 2.5) * random.direction(), random.rotation()};
    Manifold m;
    find_manifold(a, pose_a, b, pose_b, 0.5, m);
    const Gap gap = find_gap(a, pose_a, b, pose_b);
    if (gap.lower > 0.5) {
      ASSERT_EQ(m.count, 0);
      continue;
    }
    ASSERT_EQ(m.count, 1) << "case " << i << " gap " << gap.value;
    // A centre inside a cylinder has a whole ring of ways out: there the bound is the polytope's.
    const bool inside = outside_by(b.shape, pose_b.inverse() * pose_a.c) < 0;
    deep += inside;
    const double tolerance = inside && GetParam() == kCylinder ? 2e-6 : 1e-10;
    ASSERT_LE(m.points[0].gap, gap.value + tolerance) << "case " << i;
    ASSERT_GE(m.points[0].gap, gap.lower - tolerance) << "case " << i;
    ASSERT_NEAR(separation(a.shape, pose_a, b.shape, pose_b, m.normal), m.points[0].gap, 1e-12);
  }
  if (GetParam() != kSphere) {
    EXPECT_GT(deep, 300);
  }
}

TEST_P(SphereAgainst, CentresThatCoincidePartTheShortestWay) {
  Random random(600);
  for (int i = 0; i < 50; ++i) {
    const Collider a = collider(random_shape(kSphere, random), 0),
                   b = collider(random_shape(GetParam(), random), 1);
    const Pose pose{random.in_box(2), random.rotation()};
    for (const double along : {0.0, 0.1}) {
      // A capsule's or a cylinder's centre, and a point on its axis.
      const Pose pose_a = pose * Pose{{0, 0, along}, Quat::Identity()};
      Manifold m;
      find_manifold(a, pose_a, b, pose, 0.1, m);
      ASSERT_EQ(m.count, 1);
      ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
      ASSERT_NEAR(separation(a.shape, pose_a, b.shape, pose, m.normal), m.points[0].gap, 1e-13);
      ASSERT_GE(m.points[0].gap, sampled_gap(a.shape, pose_a, b.shape, pose) - 1e-9);
    }
  }
}

// Corner cases ----------------------------------------------------------------------------------

TEST_P(EachPair, CoincidentCentresGiveAFiniteManifold) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(700);
  for (int i = 0; i < 20; ++i) {
    const Collider a = collider(random_shape(kind_a, random), 0),
                   b = collider(random_shape(kind_b, random), 1);
    const Pose pose{random.in_box(2), random.rotation()};
    Manifold m;
    find_manifold(a, pose, b, pose, 0.01, m);
    if (kind_b != kHalfSpace) {
      ASSERT_GE(m.count, 1);
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
      ASSERT_TRUE(m.points[k].point.allFinite());
      ASSERT_TRUE(std::isfinite(m.points[k].gap));
    }
    ASSERT_NEAR(m.normal.norm(), 1, 1e-12);
  }
}

TEST_P(EachPair, AbsurdPosesEnd) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(750);
  const Collider a = collider(random_shape(kind_a, random), 0),
                 b = collider(random_shape(kind_b, random), 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& c : {Vec3(1e99, 0, 0), Vec3(1e200, -1e200, 0), Vec3(nan, nan, nan)}) {
    Manifold m;
    find_manifold(a, {}, b, {c, Quat::Identity()}, 0.01, m);
    find_gap(a, {}, b, {c, Quat::Identity()});
    EXPECT_LE(m.count, 4);
  }
}

TEST_P(EachPair, TinyShapesAreMeasuredLikeLargeOnes) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(800 + static_cast<std::uint64_t>(10 * kind_a + kind_b));
  for (int i = 0; i < 30; ++i) {
    const Placed p = placed(kind_a, kind_b, random.uniform(-0.05, 0.05), random);
    Manifold m;
    find_manifold(p.a, p.pose_a, p.b, p.pose_b, 0.1, m);
    for (const double k : {0x1p-13, 0x1p13}) {  // powers of two: rounding scales along
      const Collider a = collider(scaled(p.a.shape, k), 4), b = collider(scaled(p.b.shape, k), 9);
      Manifold small;
      find_manifold(a, {k * p.pose_a.c, p.pose_a.q}, b, {k * p.pose_b.c, p.pose_b.q}, 0.1 * k,
                    small);
      ASSERT_EQ(small.count, m.count) << "case " << i << " scale " << k;
      if (m.count > 0) {
        ASSERT_NEAR(least_gap(small) / k, least_gap(m), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace poinsot::test
