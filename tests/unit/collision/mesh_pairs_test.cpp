// Convex shapes against meshes, through the wall.

#include "poinsot/collision/mesh_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/allocation_counter.h"
#include "support/geometry.h"
#include "support/meshes.h"

namespace poinsot::test {
namespace {

class EveryShapeOnAMesh : public testing::TestWithParam<int> {
 protected:
  Shape shape(Random& random, double scale = 1) const {
    return random_shape(GetParam(), random, scale);
  }
};
INSTANTIATE_TEST_SUITE_P(Mesh, EveryShapeOnAMesh, testing::Range<int>(kSphere, kHalfSpace),
                         [](const auto& test) { return name_of(test.param); });

// Rounding of some twenty operations on coordinates of up to 30 m, in units in the last place.
constexpr double kRounded = 1e-13;
// find_gap's promise for round shapes: 1e-12 of their size, which is at most 2 m.
constexpr double kGapError = 4e-12;

std::vector<Manifold> manifolds(const Collider& a, const Pose& pose_a, const Collider& b,
                                const Pose& pose_b, double margin) {
  std::vector<Manifold> result;
  find_manifolds(a, pose_a, b, pose_b, margin, result);
  return result;
}

double least_gap(const std::vector<Manifold>& all) {
  double least = std::numeric_limits<double>::infinity();
  for (const Manifold& m : all)
    for (int i = 0; i < m.count; ++i)
      least = std::min(least, m.points[static_cast<std::size_t>(i)].gap);
  return least;
}

// Plane meshes are half-spaces --------------------------------------------------------------------

TEST_P(EveryShapeOnAMesh, AboveAPlaneMeshItsGapIsThatOfAHalfSpace) {
  const Collider mesh = collider(plane_mesh(10, 7), 1);
  const Collider plane = collider(HalfSpace{Vec3::UnitZ(), 0}, 1);
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    const Collider a = collider(shape(random), 0);
    const Pose world{random.in_box(10), random.rotation()};
    const Vec3 above(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0.1, 5));
    const Pose pose_a = world * Pose{above, random.rotation()};
    const Gap exact = find_gap(a, pose_a, plane, world);
    if (exact.value < 1e-9) continue;
    const Gap gap = find_gap(a, pose_a, mesh, world);
    ASSERT_NEAR(gap.value, exact.value, kGapError) << k;
    ASSERT_LE(gap.lower, exact.value + kRounded);
    ASSERT_GE(gap.lower, exact.value - kGapError);
    ASSERT_LT((gap.normal - exact.normal).norm(), 1e-5);
    ASSERT_NEAR((gap.point_a - gap.point_b).norm(), gap.value, kGapError);
    const Gap swapped = find_gap(mesh, world, a, pose_a);
    ASSERT_EQ(swapped.value, gap.value);
    ASSERT_EQ(swapped.normal, Vec3(-gap.normal));
    ASSERT_EQ(swapped.point_a, gap.point_b);
  }
}

TEST_P(EveryShapeOnAMesh, ThroughAPlaneMeshItsDepthIsThatOfAHalfSpace) {
  const Collider mesh = collider(plane_mesh(10, 7), 1);
  const Collider plane = collider(HalfSpace{Vec3::UnitZ(), 0}, 1);
  Random random(4);
  for (int k = 0; k < 300; ++k) {
    const Collider a = collider(shape(random), 0);
    const Pose world{random.in_box(10), random.rotation()};
    const Quat turn = random.rotation();
    // From barely in to half through.
    const Gap at_0 = find_gap(a, Pose{Vec3::Zero(), turn}, plane, {});
    const double depth = -at_0.value * std::pow(10, random.uniform(-6, 0));
    const Vec3 at(random.uniform(-5, 5), random.uniform(-5, 5), -at_0.value - depth);
    const Pose pose_a = world * Pose{at, turn};
    const Gap gap = find_gap(a, pose_a, mesh, world);
    ASSERT_NEAR(gap.value, -depth, kGapError) << k << " at depth " << depth;
    ASSERT_LT((gap.normal - world.q * Vec3::UnitZ()).norm(), 1e-9) << k << " at depth " << depth;
    const auto all = manifolds(a, pose_a, mesh, world, 0.02 * a.size);
    ASSERT_EQ(all.size(), 1u) << k << " at depth " << depth;
    ASSERT_NEAR(least_gap(all), -depth, std::max(kGapError, kSameGap * a.size));
  }
}

TEST_P(EveryShapeOnAMesh, RestingOnAPlaneMeshItHasOneManifoldAsOnAHalfSpace) {
  const Collider mesh = collider(plane_mesh(10, 9), 1);
  const Collider plane = collider(HalfSpace{Vec3::UnitZ(), 0}, 1);
  Random random(5);
  for (int k = 0; k < 100; ++k) {
    const Collider a = collider(shape(random), 0);
    const Quat turn = k % 2 == 0 ? Quat::Identity() : random.rotation();
    const double lift = -find_gap(a, Pose{Vec3::Zero(), turn}, plane, {}).value;
    const Vec3 at(random.uniform(-5, 5), random.uniform(-5, 5), lift + 1e-6);
    Manifold exact;
    find_manifold(a, {at, turn}, plane, {}, 1e-4, exact);
    const auto all = manifolds(a, {at, turn}, mesh, {}, 1e-4);
    ASSERT_EQ(all.size(), 1u) << k;
    ASSERT_LT((all[0].normal - Vec3::UnitZ()).norm(), 1e-9);
    ASSERT_GE(all[0].count, exact.count) << k;
    ASSERT_NEAR(least_gap(all), 1e-6, kSameGap * a.size);
    // As far apart as there. Eight corners of a cap leave a choice of four: the widest pair of any
    // spans at least cos(π/8) of the circle.
    const auto width = [](const Manifold& m) {
      double most = 0;
      for (int i = 0; i < m.count; ++i)
        for (int j = 0; j < i; ++j)
          most = std::max(most, (m.points[static_cast<std::size_t>(i)].point -
                                 m.points[static_cast<std::size_t>(j)].point)
                                    .norm());
      return most;
    };
    ASSERT_GE(width(all[0]), 0.92 * width(exact)) << k;
    ASSERT_LE(width(all[0]), width(exact) + 0.01) << k;
  }
}

TEST(MeshPairs, ABoxKeepsItsFourCornersOnManyTriangles) {
  const Collider box = collider(Box{{1, 0.8, 0.5}}, 0);
  for (const int n : {1, 8, 60}) {
    const Collider mesh = collider(plane_mesh(3, n), 1);
    const auto all = manifolds(box, {{0.13, 0.21, 0.25}, Quat::Identity()}, mesh, {}, 0.01);
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(all[0].count, 4);
    for (int i = 0; i < 4; ++i) {
      const Vec3 p = all[0].points[static_cast<std::size_t>(i)].point - Vec3(0.13, 0.21, 0);
      EXPECT_NEAR(std::abs(p.x()), 0.5, kRounded) << n;
      EXPECT_NEAR(std::abs(p.y()), 0.4, kRounded) << n;
    }
  }
}

// Convex surfaces are convex shapes ---------------------------------------------------------------

TEST_P(EveryShapeOnAMesh, OutsideOfAClosedSurfaceItsGapIsThatOfTheSolid) {
  Random random(6);
  for (int k = 0; k < 200; ++k) {
    const Collider a = collider(shape(random), 0);
    const Convex solid = std::get<Convex>(random_shape(kConvex, random));
    const Collider convex = collider(solid, 1), mesh = collider(surface_of(solid), 1);
    const Pose pose_a{random.in_box(2), random.rotation()};
    const double gap = std::pow(10, random.uniform(-7, 0));
    const Pose pose_b = pose_at_gap(a.shape, pose_a, solid, gap, random);
    const Gap exact = find_gap(a, pose_a, convex, pose_b);
    if (exact.value < 1e-9) continue;
    const Gap found = find_gap(a, pose_a, mesh, pose_b);
    ASSERT_NEAR(found.value, exact.value, kGapError) << k << " at " << exact.value;
    ASSERT_LE(found.lower, exact.value + kGapError);
    // Points of the manifold never claim that the shapes are nearer than they are.
    const auto all = manifolds(a, pose_a, mesh, pose_b, exact.value + 0.01);
    ASSERT_FALSE(all.empty()) << k;
    ASSERT_NEAR(least_gap(all), exact.value, kGapError + kSameGap * a.size) << k;
  }
}

TEST_P(EveryShapeOnAMesh, BarelyInAClosedSurfaceItsDepthIsThatOfTheSolid) {
  Random random(7);
  int found_right = 0, tried = 0;
  for (int k = 0; k < 200; ++k) {
    const Collider a = collider(shape(random), 0);
    const Convex solid = std::get<Convex>(random_shape(kConvex, random));
    const Collider convex = collider(solid, 1), mesh = collider(surface_of(solid), 1);
    const Pose pose_a{random.in_box(2), random.rotation()};
    const Pose pose_b = pose_at_gap(a.shape, pose_a, solid, -1e-4, random);
    const Gap exact = find_gap(a, pose_a, convex, pose_b);
    if (exact.value > -1e-5) continue;
    const Gap found = find_gap(a, pose_a, mesh, pose_b);
    // The depth of a single triangle, in directions that it can push: no less than the solid's.
    ++tried;
    ASSERT_LE(found.value, exact.value + 1e-9) << k;
    ASSERT_GE(found.value, 2 * exact.value) << k;
    found_right += std::abs(found.value - exact.value) < 0.01 * std::abs(exact.value);
  }
  EXPECT_GE(found_right, 0.95 * tried);
}

// Internal edges ----------------------------------------------------------------------------------

TEST(MeshPairs, ASphereRollsOverInternalEdgesWithoutNoticing) {
  const Collider mesh = collider(plane_mesh(2, 10), 1);
  const Collider sphere = collider(Sphere{0.3}, 0);
  for (const double gap : {-1e-3, -1e-9, 0.0, 1e-10, 1e-3})
    for (int k = 0; k <= 1000; ++k) {
      const double x = -1 + 0.002 * k;  // over edges, corners and diagonals
      const Pose pose{{x, 0.4 * x, 0.3 + gap}, Quat::Identity()};
      const Gap found = find_gap(sphere, pose, mesh, {});
      ASSERT_NEAR(found.value, gap, kRounded) << x;
      ASSERT_LT((found.normal - Vec3::UnitZ()).norm(), 1e-12) << x << " at " << gap;
      const auto all = manifolds(sphere, pose, mesh, {}, 0.01);
      ASSERT_EQ(all.size(), 1u) << x << " at " << gap;
      ASSERT_EQ(all[0].count, 1) << x << " at " << gap;
      ASSERT_LT((all[0].normal - Vec3::UnitZ()).norm(), 1e-12) << x << " at " << gap;
    }
}

TEST(MeshPairs, ABoxSlidesOverInternalEdgesWithoutNoticing) {
  const Collider mesh = collider(plane_mesh(2, 10), 1);
  const Collider box = collider(Box{{0.5, 0.3, 0.2}}, 0);
  for (const double gap : {-1e-4, -1e-9, 0.0, 1e-10, 1e-4})
    for (int k = 0; k <= 300; ++k) {
      const double x = -1 + 0.007 * k;
      const Quat turn(Eigen::AngleAxisd(0.01 * k, Vec3::UnitZ()));
      const auto all = manifolds(box, {{x, 0.3 * x, 0.1 + gap}, turn}, mesh, {}, 0.004);
      ASSERT_EQ(all.size(), 1u) << x << " at " << gap;
      ASSERT_EQ(all[0].count, 4) << x << " at " << gap;
      ASSERT_LT((all[0].normal - Vec3::UnitZ()).norm(), 1e-12) << x << " at " << gap;
      ASSERT_NEAR(least_gap(all), gap, kRounded) << x << " at " << gap;
    }
}

// Valleys and ridges ------------------------------------------------------------------------------

TEST(MeshPairs, AConcaveCornerGivesTwoNormals) {
  const Collider valley = collider(terrain(2, 4, [](double x, double) { return std::abs(x); }), 1);
  const Collider sphere = collider(Sphere{0.5}, 0);
  const double height = std::sqrt(2) * (0.5 + 1e-6);
  const auto all = manifolds(sphere, {{0, 0.3, height}, Quat::Identity()}, valley, {}, 0.01);
  ASSERT_EQ(all.size(), 2u);
  const double kHalfRoot = std::sqrt(0.5);
  for (const Manifold& m : all) {
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(m.points[0].gap, 1e-6, kRounded);
    EXPECT_NEAR(std::abs(m.normal.x()), kHalfRoot, kRounded);
    EXPECT_NEAR(m.normal.z(), kHalfRoot, kRounded);
  }
  EXPECT_LT(all[0].normal.x() * all[1].normal.x(), 0);
}

TEST(MeshPairs, ABoxInACornerTouchesFloorAndWall) {
  // Floor z = 0 for x < 0, wall x = 0 above it.
  const std::vector<Vec3> v = {{-3, -2, 0}, {0, -2, 0}, {0, 2, 0},
                               {-3, 2, 0},  {0, -2, 3}, {0, 2, 3}};
  const Collider mesh = collider(
      make_mesh(v, std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}), 1);
  const Collider box = collider(Box{{1, 1, 1}}, 0);
  for (const double gap : {-1e-6, 0.0, 1e-6}) {
    const auto all = manifolds(box, {{-0.5 - gap, 0, 0.5 + gap}, Quat::Identity()}, mesh, {}, 0.01);
    ASSERT_EQ(all.size(), 2u) << gap;
    for (const Manifold& m : all) {
      EXPECT_EQ(m.count, 4) << gap;
      EXPECT_NEAR(m.normal.cwiseAbs().maxCoeff(), 1, 1e-12) << m.normal.transpose();
    }
    EXPECT_NEAR(all[0].normal.dot(all[1].normal), 0, 1e-12);
    EXPECT_NEAR(least_gap(all), gap, kRounded);
  }
}

TEST(MeshPairs, ASphereOnARidgeIsPushedAlongTheLineToItsCentre) {
  const Collider ridge = collider(terrain(2, 4, [](double x, double) { return -std::abs(x); }), 1);
  const Collider sphere = collider(Sphere{0.5}, 0);
  for (const double gap : {-1e-3, -1e-9, 1e-9, 1e-3}) {
    const Vec3 n = Vec3(0.4, 0, 1).normalized();
    const Vec3 at = (0.5 + gap) * n + Vec3(0, 0.1, 0);
    const Gap found = find_gap(sphere, {at, Quat::Identity()}, ridge, {});
    EXPECT_NEAR(found.value, gap, kRounded);
    EXPECT_LT((found.normal - n).norm(), 1e-6);
    const auto all = manifolds(sphere, {at, Quat::Identity()}, ridge, {}, 0.01);
    ASSERT_EQ(all.size(), 1u) << gap;
    EXPECT_EQ(all[0].count, 1);
    EXPECT_LT((all[0].normal - n).norm(), 1e-6);
  }
}

// Sides -------------------------------------------------------------------------------------------

TEST(MeshPairs, StopsBodiesOnEitherSide) {
  const Mesh sheet = plane_mesh(2, 3);
  const Collider sphere = collider(Sphere{0.5}, 0);
  for (const Mesh& mesh : {sheet, turned(sheet)})
    for (const double side : {1.0, -1.0})
      for (const double gap : {1e-3, 1e-10, -1e-10}) {
        const Pose pose{{0.1, 0.2, side * (0.5 + gap)}, Quat::Identity()};
        const Gap found = find_gap(sphere, pose, collider(mesh, 1), {});
        EXPECT_NEAR(found.value, gap, kRounded);
        EXPECT_NEAR(found.normal.z(), side, 1e-12) << gap;
      }
}

TEST(MeshPairs, PushesWhatIsThroughToTheOutside) {
  const Mesh sheet = plane_mesh(2, 3);
  const Collider box = collider(Box{{1, 1, 1}}, 0);
  const Pose pose{{0.1, 0.2, -0.3}, Quat::Identity()};  // most of it behind
  EXPECT_NEAR(find_gap(box, pose, collider(sheet, 1), {}).value, -0.8, kRounded);
  EXPECT_NEAR(find_gap(box, pose, collider(sheet, 1), {}).normal.z(), 1, kRounded);
  EXPECT_NEAR(find_gap(box, pose, collider(turned(sheet), 1), {}).value, -0.2, kRounded);
  EXPECT_NEAR(find_gap(box, pose, collider(turned(sheet), 1), {}).normal.z(), -1, kRounded);
}

// The far side of a thin plate lies within the margin and must not take part.
TEST(MeshPairs, TheFarSideOfAThinPlateIsHidden) {
  const Collider plate = collider(surface_of(box_as_convex({4, 4, 0.002})), 1);
  const Collider box = collider(Box{{1, 1, 1}}, 0);
  for (const double gap : {-1e-4, 0.0, 1e-4}) {
    const auto all = manifolds(box, {{0.1, 0, 0.501 + gap}, Quat::Identity()}, plate, {}, 0.02);
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(all[0].count, 4);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(all[0].points[static_cast<std::size_t>(i)].gap, gap, kRounded);
  }
}

// Terrain -----------------------------------------------------------------------------------------

Mesh hills(int n) {
  return terrain(10, n, [](double x, double y) { return 0.5 * std::sin(x) * std::cos(1.3 * y); });
}

TEST_P(EveryShapeOnAMesh, OverHillsItsGapIsThatOfTheNearestTriangle) {
  const Mesh mesh = hills(32);  // 2048 triangles
  const Collider ground = collider(mesh, 1);
  Random random(8);
  for (int k = 0; k < 40; ++k) {
    const Collider a = collider(shape(random, 0.5), 0);
    const Pose pose_a{Vec3(random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(0, 2)),
                      random.rotation()};
    const Pose pose_b{random.in_box(0.5), Quat(Eigen::AngleAxisd(0.3, random.direction()))};
    const Gap found = find_gap(a, pose_a, ground, pose_b);
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      least = std::min(least, find_gap(a, pose_a, triangle_collider(ground, t), pose_b).value);
    ASSERT_NEAR(found.value, least, kGapError) << k;
    ASSERT_LE(found.lower, found.value);
  }
}

TEST_P(EveryShapeOnAMesh, SomePointOfAManifoldIsAsNearAsTheGapAndNoneNearer) {
  const Collider ground = collider(hills(32), 1);
  Random random(9);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const Collider a = collider(shape(random, 0.5), 0);
    const Pose high{Vec3(random.uniform(-8, 8), random.uniform(-8, 8), 3), random.rotation()};
    Pose pose_a = high;
    // Let down until 1 mm above.
    for (int i = 0; i < 60; ++i) pose_a.c.z() -= find_gap(a, pose_a, ground, {}).value - 1e-3;
    const double gap = find_gap(a, pose_a, ground, {}).value;
    if (std::abs(gap - 1e-3) > 1e-6) continue;  // it slides along a slope for ever
    ++touching;
    const auto all = manifolds(a, pose_a, ground, {}, 0.01);
    ASSERT_FALSE(all.empty()) << k;
    ASSERT_LE(all.size(), kMaxMeshManifolds);
    ASSERT_NEAR(least_gap(all), gap, 1e-9 + kSameGap * a.size) << k;
    for (const Manifold& m : all) EXPECT_GT(m.normal.z(), 0.3);  // slopes are below 45°
  }
  EXPECT_GT(touching, 200);
}

TEST(MeshPairs, TrianglesNearAreThoseWhoseBoxesAreNear) {
  const Mesh mesh = hills(32);
  const Collider ground = collider(mesh, 1);
  Random random(10);
  std::vector<int> near;
  for (int k = 0; k < 100; ++k) {
    const Pose pose{random.in_box(5), random.rotation()};
    const Vec3 c = pose * random.in_box(8), half = Vec3::Constant(random.uniform(0.1, 1));
    const Aabb box{c - half, c + half};
    triangles_near(ground, pose, box, near);
    ASSERT_TRUE(std::ranges::is_sorted(near));
    // None is missed, and most others are left out.
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      if (bounds(triangle_collider(ground, t), pose).overlaps(box) &&
          !std::ranges::binary_search(near, t)) {
        // A box about a turned box is larger: the triangle itself must be out of reach.
        const Collider probe = collider(Box{2 * half}, 0);
        ASSERT_GT(find_gap(probe, {c, Quat::Identity()}, triangle_collider(ground, t), pose).value,
                  0);
      }
    ASSERT_LT(near.size(), 500u);
  }
}

// Hostile -----------------------------------------------------------------------------------------

TEST_P(EveryShapeOnAMesh, FarFromTheOriginNothingIsLostButRounding) {
  const Collider mesh = collider(plane_mesh(10, 7), 1);
  Random random(11);
  const Vec3 far(1e5, -1e5, 1e5);
  for (int k = 0; k < 50; ++k) {
    const Collider a = collider(shape(random), 0);
    const Pose near{Vec3(random.uniform(-5, 5), random.uniform(-5, 5), 1.8), random.rotation()};
    const double gap = find_gap(a, near, mesh, {}).value;
    const Gap found = find_gap(a, {near.c + far, near.q}, mesh, {far, Quat::Identity()});
    // Positions of 1e5 m are known to 1.5e-11 m.
    ASSERT_NEAR(found.value, gap, 1e-10) << k;
    // The mesh far from its own origin: so are its corners.
    Mesh moved = plane_mesh(10, 7);
    for (Vec3& v : moved.vertices) v += far;
    const Collider distant = collider(moved, 1);
    ASSERT_NEAR(find_gap(a, {near.c + far, near.q}, distant, {}).value, gap,
                kRounding * (2 * far.norm() + distant.bounding_radius))
        << k;
  }
}

TEST_P(EveryShapeOnAMesh, FarAwayItsGapIsTheDistance) {
  const Collider mesh = collider(plane_mesh(10, 7), 1);
  Random random(12);
  const Collider a = collider(shape(random), 0);
  const Gap gap = find_gap(a, {{0, 0, 1e5}, Quat::Identity()}, mesh, {});
  EXPECT_NEAR(gap.value, 1e5 - support_width(a.shape, -Vec3::UnitZ()), 1e-6);
  EXPECT_TRUE(manifolds(a, {{0, 0, 1e5}, Quat::Identity()}, mesh, {}, 0.1).empty());
}

// Needles, slivers and tiny triangles beside large ones: an answer, and in time.
TEST_P(EveryShapeOnAMesh, ThinTrianglesAreMeasured) {
  Random random(13);
  for (int k = 0; k < 50; ++k) {
    std::vector<Vec3> v;
    std::vector<std::array<int, 3>> t;
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = random.in_box(1), along = random.direction();
      const double thin = std::pow(10, random.uniform(-10, 0));
      v.push_back(p);
      v.push_back(p + along);
      v.push_back(p + 0.5 * along + thin * random.direction());
      t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Collider mesh = collider(make_mesh(v, t), 1);
    const Collider a = collider(shape(random), 0);
    const Pose pose{random.in_box(3), random.rotation()};
    const Gap gap = find_gap(a, pose, mesh, {});
    ASSERT_TRUE(std::isfinite(gap.value));
    ASSERT_LE(gap.lower, gap.value);
    ASSERT_NEAR(gap.normal.norm(), 1, 1e-9);
    for (const Manifold& m : manifolds(a, pose, mesh, {}, 0.1)) {
      ASSERT_NEAR(m.normal.norm(), 1, 1e-9);
      for (int i = 0; i < m.count; ++i)
        ASSERT_TRUE(m.points[static_cast<std::size_t>(i)].point.allFinite());
    }
  }
}

TEST(MeshPairs, ACentreOnTheSurfaceHasAWayOut) {
  const Collider mesh = collider(plane_mesh(2, 4), 1);
  for (int kind = kSphere; kind < kHalfSpace; ++kind) {
    Random random(14);
    const Collider a = collider(random_shape(kind, random), 0);
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.1, 0.2, 0), Vec3(0.5, 0.5, 0), Vec3(2, 2, 0)}) {
      const Gap gap = find_gap(a, {at, Quat::Identity()}, mesh, {});
      EXPECT_LT(gap.value, 0) << name_of(kind) << at.transpose();
      EXPECT_NEAR(gap.normal.norm(), 1, 1e-9) << name_of(kind) << at.transpose();
    }
  }
}

TEST(MeshPairs, QueriesDoNotAllocateOnceWarm) {
  const Collider ground = collider(hills(32), 1);
  const Collider box = collider(Box{{1, 1, 1}}, 0);
  std::vector<Manifold> all;
  std::vector<int> near;
  const auto ask = [&](double x) {
    const Pose pose{{x, 0, 0.9}, Quat::Identity()};
    find_gap(box, pose, ground, {});
    find_manifolds(box, pose, ground, {}, 0.5, all);
    triangles_near(ground, {}, bounds(box, pose), near);
    find_gap(box, pose, triangle_collider(ground, near[0]), {});
  };
  for (double x = -5; x < 5; x += 0.1) ask(x);
  if (!can_count_allocations()) GTEST_SKIP() << "a sanitizer brings its own malloc";
  const std::size_t before = allocations();
  for (double x = -5; x < 5; x += 0.1) ask(x);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace poinsot::test
