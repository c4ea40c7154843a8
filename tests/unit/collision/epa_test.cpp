#include "poinsot/collision/epa.h"

#include <gtest/gtest.h>

#include "support/geometry.h"

namespace poinsot::test {
namespace {

// The width of core(A) − core(B) along n, by the shapes' closed forms: what a translation along n
// has to be to part the cores.
double parting(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
               const Vec3& n) {
  return -separation(a.shape, pose_a, b.shape, pose_b, n) - a.core_radius - b.core_radius;
}

// What must hold of any answer, apart from being least: finite, on the shapes, parting.
void expect_sane(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                 const Penetration& p, double tolerance) {
  ASSERT_TRUE(std::isfinite(p.depth) && std::isfinite(p.lower));
  ASSERT_TRUE(p.normal.allFinite() && p.on_a.allFinite() && p.on_b.allFinite());
  EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
  EXPECT_LE(p.lower, p.depth);
  const Vec3 n = pose_a.q * p.normal;
  EXPECT_NEAR(parting(a, pose_a, b, pose_b, n), p.depth, tolerance);
  const Pose moved{pose_a.c + p.depth * n, pose_a.q};
  const GjkResult after = gjk({a, moved, b, pose_b});
  EXPECT_LE(after.separated ? after.distance : 0, 1e-4 * a.bounding_radius);
}

struct Case {
  Collider a, b;
  Pose pose_a, pose_b;
};

// Random overlapping cores; `depth` the largest relative depth wanted, roughly.
std::vector<Case> overlapping(int kind_a, int kind_b, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Case> cases;
  for (int tries = 0; static_cast<int>(cases.size()) < count && tries < 50 * count; ++tries) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 1.5) * random.direction(), random.rotation()};
    if (!gjk({a, pose_a, b, pose_b}).separated) cases.push_back({a, b, pose_a, pose_b});
  }
  return cases;
}

Penetration query(const Case& c) {
  const ConvexPair pair(c.a, c.pose_a, c.b, c.pose_b);
  return penetration(pair, gjk(pair));
}

TEST(Epa, PolytopesPartByTheLeastOfAllAxes) {
  const auto hull = [](const Shape& s) {
    const auto* box = std::get_if<Box>(&s);
    return box ? box_as_convex(box->size) : std::get<Convex>(s);
  };
  for (const auto& [kind_a, kind_b] :
       {std::pair{kBox, kBox}, {kBox, kConvex}, {kConvex, kConvex}}) {
    int inexact = 0;
    for (const Case& c : overlapping(kind_a, kind_b, 100, 3)) {
      const Penetration p = query(c);
      const double exact = -separating_axes(hull(c.a.shape), c.pose_a, hull(c.b.shape), c.pose_b);
      expect_sane(c.a, c.pose_a, c.b, c.pose_b, p, 1e-13);
      EXPECT_NEAR(p.depth, exact, 1e-12);
      EXPECT_NEAR(p.lower, exact, 1e-12);
      inexact += std::abs(p.depth - exact) > 1e-12;
    }
    EXPECT_EQ(inexact, 0) << name_of(kind_a) << " " << name_of(kind_b);
  }
}

class EveryDeepPair : public testing::TestWithParam<std::tuple<int, int>> {};

// Pairs whose cores have a volume between them: a point or a segment hardly meets a segment.
std::vector<std::tuple<int, int>> deep_pairs() {
  std::vector<std::tuple<int, int>> pairs;
  for (int a = kSphere; a < kHalfSpace; ++a)
    for (int b = kBox; b < kHalfSpace; ++b)
      if (b != kCapsule || (a != kSphere && a != kCapsule)) pairs.emplace_back(a, b);
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(Epa, EveryDeepPair, testing::ValuesIn(deep_pairs()), [](const auto& p) {
  return name_of(std::get<0>(p.param)) + "_" + name_of(std::get<1>(p.param));
});

TEST_P(EveryDeepPair, NoSampledDirectionPartsThemSooner) {
  const auto [kind_a, kind_b] = GetParam();
  double widest = 0;
  const std::vector<Case> cases = overlapping(kind_a, kind_b, 30, 21);
  ASSERT_GT(cases.size(), 20u);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const Penetration p = query(c);
    expect_sane(c.a, c.pose_a, c.b, c.pose_b, p, 1e-9);
    const double radii = c.a.core_radius + c.b.core_radius;
    const double sampled = -sampled_gap(c.a.shape, c.pose_a, c.b.shape, c.pose_b) - radii;
    EXPECT_LE(p.depth, sampled + 2e-9) << "case " << i;
    EXPECT_LE(p.lower, sampled + 1e-12) << "case " << i;
    widest = std::max(widest, p.depth - p.lower);
  }
  // The lower bound suffers where a whole ring of directions is all but equal.
  EXPECT_LE(widest, 2e-6);
}

TEST_P(EveryDeepPair, ShallowDepthIsAsSmallAsItIs) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(31);
  for (int i = 0; i < 60; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    Pose pose_b{pose_a.c + 4 * random.direction(), random.rotation()};
    const GjkResult apart = gjk({a, pose_a, b, pose_b});
    ASSERT_TRUE(apart.separated);
    // Along the normal until the nearest points pass each other by `deep`: the slab proves that no
    // more is needed, and a shallow overlap's least translation is close to it.
    const double deep = random.log_uniform(1e-12, 1e-4);
    pose_b.c += (apart.distance + deep) * (pose_a.q * apart.normal);
    const ConvexPair pair(a, pose_a, b, pose_b);
    const GjkResult near = gjk(pair);
    if (near.separated) {  // past a corner, but beside the shape
      EXPECT_GT(near.lower, 0);
      continue;
    }
    const Penetration p = penetration(pair, near);
    expect_sane(a, pose_a, b, pose_b, p, 1e-9);
    EXPECT_LE(p.depth, deep + 2e-9) << "case " << i << " depth " << deep;
    EXPECT_GE(p.depth, -2e-9) << "case " << i << " depth " << deep;
  }
}

TEST_P(EveryDeepPair, CoincidentAndAlignedShapesGetAFiniteAnswer) {
  const auto [kind_a, kind_b] = GetParam();
  Random random(41);
  for (int i = 0; i < 40; ++i) {
    const Collider a = collider(random_shape(kind_a, random)),
                   b = collider(random_shape(kind_b, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Vec3 aside = i % 4 == 0 ? Vec3(Vec3::Zero()) : Vec3(0.1 * Vec3::Unit(i % 3));
    const Pose pose_b = pose_a * Pose{aside, Quat::Identity()};
    const ConvexPair pair(a, pose_a, b, pose_b);
    const GjkResult r = gjk(pair);
    if (r.separated) continue;  // a point or a segment beside another
    const Penetration p = penetration(pair, r);
    expect_sane(a, pose_a, b, pose_b, p, 1e-9);
    const double radii = a.core_radius + b.core_radius;
    // Of directions that are all but equal some other may be better by this part of the size.
    EXPECT_LE(p.depth, -sampled_gap(a.shape, pose_a, b.shape, pose_b) - radii + 3e-4);
  }
}

TEST(Epa, CrossedSegmentsPartAcrossBoth) {
  const Collider a = collider(Capsule{0.1, 2}), b = collider(Capsule{0.2, 2});
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Quat turn(Eigen::AngleAxisd(random.uniform(0.1, 1.5), Vec3::UnitX()));
    const Pose pose_b{
        turn * Vec3(0, 0, random.uniform(-0.9, 0.9)) + Vec3(0, 0, random.uniform(-0.9, 0.9)), turn};
    const ConvexPair pair(a, {}, b, pose_b);
    const GjkResult r = gjk(pair);
    ASSERT_FALSE(r.separated);
    const Penetration p = penetration(pair, r);
    EXPECT_NEAR(p.depth, 0, 1e-15);
    EXPECT_NEAR(std::abs(p.normal.x()), 1, 1e-9);
    EXPECT_NEAR((p.on_a - p.on_b).norm(), 0, 1e-9);
  }
}

TEST(Epa, OverlappingParallelSegmentsPartAcrossTheirLine) {
  const Collider a = collider(Capsule{0.1, 2}), b = collider(Capsule{0.2, 2});
  for (const double along : {0.0, 0.3, 1.0, 2.0}) {
    const ConvexPair pair(a, {}, b, {{0, 0, along}, Quat::Identity()});
    const GjkResult r = gjk(pair);
    ASSERT_FALSE(r.separated);
    const Penetration p = penetration(pair, r);
    EXPECT_NEAR(p.depth, 0, 1e-15);
    EXPECT_NEAR(p.normal.z(), 0, 1e-12);
  }
}

TEST(Epa, PlatesAndNeedlesPartExactly) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double thin = random.log_uniform(1e-5, 1e-2);
    const Box plate{{1, 1, thin}}, needle{{thin, thin, 2}};
    const Collider a = collider(plate), b = collider(i % 2 ? Box{{1, 1, 1}} : needle);
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{
        pose_a.c + 0.3 * (pose_a.q * Vec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                          thin * random.uniform(-1, 1))),
        random.rotation()};
    const ConvexPair pair(a, pose_a, b, pose_b);
    const GjkResult r = gjk(pair);
    if (r.separated) continue;
    const Penetration p = penetration(pair, r);
    const double exact = -separating_axes(box_as_convex(plate.size), pose_a,
                                          box_as_convex(std::get<Box>(b.shape).size), pose_b);
    EXPECT_NEAR(p.depth, exact, 1e-13) << "case " << i << " thickness " << thin;
  }
}

}  // namespace
}  // namespace poinsot::test
