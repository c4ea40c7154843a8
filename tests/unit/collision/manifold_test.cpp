#include "poinsot/collision/manifold.h"

#include <numbers>

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

const Quat kOnSide(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::UnitX()));

Manifold manifold_of(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                     double margin) {
  Manifold m;
  find_manifold(collider(a, 0), pose_a, collider(b, 1), pose_b, margin, m);
  return m;
}

double least_gap(const Manifold& m) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k)
    least = std::min(least, m.points[k].gap);
  return least;
}

// Area of the polygon of the points, taken around their middle, across z.
double area(const Manifold& m) {
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < m.count; ++k) middle += m.points[static_cast<std::size_t>(k)].point / m.count;
  std::vector<Vec3> ring;
  for (int k = 0; k < m.count; ++k)
    ring.push_back(m.points[static_cast<std::size_t>(k)].point - middle);
  std::sort(ring.begin(), ring.end(), [](const Vec3& p, const Vec3& q) {
    return std::atan2(p.y(), p.x()) < std::atan2(q.y(), q.x());
  });
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice += ring[k].cross(ring[(k + 1) % ring.size()]).z();
  return 0.5 * twice;
}

// The points of PointSet ------------------------------------------------------------------------

TEST(PointSet, KeepsTheDeepestAndSpansTheRest) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    PointSet set(Vec3::UnitZ(), 1e-9);
    const int n = 1 + random.below(40);
    double deepest = 1;
    for (int k = 0; k < n; ++k) {
      const double gap = random.uniform(-1, 0);
      deepest = std::min(deepest, gap);
      set.add({random.uniform(-1, 1), random.uniform(-1, 1), 0}, gap);
    }
    Manifold m;
    set.reduce_into(m);
    EXPECT_EQ(m.points[0].gap, deepest);
    EXPECT_LE(m.count, std::min(n, 4));
    EXPECT_GE(m.count, std::min(n, 3));
  }
}

TEST(PointSet, OverflowLosesTheShallowest) {
  PointSet set(Vec3::UnitZ(), 1e-9);
  for (int k = 0; k < 100; ++k) set.add({std::cos(k), std::sin(k), 0}, 0.01 * ((37 * k) % 100));
  EXPECT_EQ(set.count(), PointSet::kCapacity);
  EXPECT_EQ(set.least_gap(), 0);
}

TEST(PointSet, AFullRectangleKeepsItsCorners) {
  PointSet set(Vec3::UnitZ(), 1e-9);
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) set.add({0.2 * i, 0.4 * j, 0}, 0);
  Manifold m;
  set.reduce_into(m);
  ASSERT_EQ(m.count, 4);
  EXPECT_NEAR(area(m), 2, 1e-12);
}

TEST(PointSet, PointsOnALineBecomeItsEnds) {
  PointSet set(Vec3::UnitZ(), 1e-9);
  for (int i = 0; i <= 9; ++i) set.add({0.1 * i, 0.2 * i, 0}, 0);
  Manifold m;
  set.reduce_into(m);
  EXPECT_EQ(m.count, 2);
}

TEST(PointSet, RepeatedPointsCountOnce) {
  PointSet set(Vec3::UnitZ(), 1e-6);
  for (int i = 0; i < 4; ++i) set.add({1e-8 * i, 0, 0}, 0);
  Manifold m;
  set.reduce_into(m);
  EXPECT_EQ(m.count, 1);
}

// Faces -----------------------------------------------------------------------------------------

TEST(Manifold, CylinderStandsOnABoxOnItsRing) {
  for (const double tilt : {0.0, 1e-9, 1e-6, 1e-4, 1e-3}) {
    for (int turn = 0; turn < 12; ++turn) {
      for (const double gap : {-1e-3, -1e-6, 1e-6, 1e-3}) {
        const double angle = 0.2 * turn;
        const Quat q(Eigen::AngleAxisd(tilt, Vec3(std::cos(angle), std::sin(angle), 0)));
        const double height = 0.5 + 0.5 * std::cos(tilt) + 0.4 * std::sin(tilt);
        const Manifold m =
            manifold_of(Box{{3, 3, 1}}, {}, Cylinder{0.4, 1}, {{0.1, 0.2, height + gap}, q}, 0.02);
        ASSERT_EQ(m.count, 4) << "tilt " << tilt << " gap " << gap;
        EXPECT_NEAR(least_gap(m), gap, 2 * kSameGap) << "tilt " << tilt;
        EXPECT_NEAR(m.normal.z(), -1, 1e-6);
        for (std::size_t k = 0; k < 4; ++k) {
          const Vec3 beside = m.points[k].point - Vec3(0.1, 0.2, 0);
          EXPECT_NEAR(beside.head<2>().norm(), 0.4, 1e-3);
          // Midway between the box's face and the cylinder's.
          EXPECT_NEAR(m.points[k].point.z(), 0.5 + 0.5 * m.points[k].gap, 1e-8);
        }
        EXPECT_GT(area(m), 0.25);  // of the 0.32 m² of an inscribed square
      }
    }
  }
}

TEST(Manifold, LyingCylinderTouchesABoxAlongItsSide) {
  for (const double tilt : {0.0, 1e-6, 1e-4, 1e-3}) {
    for (const double gap : {-1e-4, 1e-4}) {
      const Quat q = Quat(Eigen::AngleAxisd(tilt, Vec3::UnitX())) * kOnSide;
      const double height = 0.5 + 0.2 * std::cos(tilt) + 0.5 * std::sin(tilt) + gap;
      const Manifold m =
          manifold_of(Box{{3, 3, 1}}, {}, Cylinder{0.2, 1}, {{0.3, 0, height}, q}, 0.02);
      ASSERT_EQ(m.count, 2) << "tilt " << tilt;
      EXPECT_NEAR(least_gap(m), gap, 1e-7);
      EXPECT_NEAR((m.points[0].point - m.points[1].point).norm(), 1, 1e-3);
      EXPECT_NEAR(m.points[0].point.x(), 0.3, 1e-6);
    }
  }
}

TEST(Manifold, LyingCylinderOverAnEdgeIsCutAtTheEdge) {
  const Manifold m =
      manifold_of(Box{{3, 3, 1}}, {}, Cylinder{0.2, 2}, {{0.3, 1.2, 0.7 - 1e-4}, kOnSide}, 0.02);
  ASSERT_EQ(m.count, 2);
  EXPECT_NEAR(std::max(m.points[0].point.y(), m.points[1].point.y()), 1.5, 1e-9);
  EXPECT_NEAR(std::min(m.points[0].point.y(), m.points[1].point.y()), 0.2, 1e-9);
}

TEST(Manifold, ParallelCapsulesAndCylindersTouchAtTwoPoints) {
  for (const Shape& a : {Shape(Capsule{0.2, 2}), Shape(Cylinder{0.2, 2})}) {
    for (const Shape& b : {Shape(Capsule{0.3, 1}), Shape(Cylinder{0.3, 1})}) {
      for (const double gap : {-1e-3, -1e-5, 1e-5, 1e-3}) {
        const Manifold m = manifold_of(a, {}, b, {{0.5 + gap, 0, 0.2}, Quat::Identity()}, 0.02);
        ASSERT_EQ(m.count, 2) << gap;
        EXPECT_NEAR(m.points[0].gap, gap, 1e-9);
        EXPECT_NEAR(m.points[1].gap, gap, 1e-9);
        EXPECT_NEAR(std::abs(m.points[0].point.z() - m.points[1].point.z()), 1, 1e-9);
        EXPECT_NEAR(m.points[0].point.x(), 0.2 + 0.5 * gap, 1e-9);
      }
    }
  }
}

TEST(Manifold, CapsulesThatCrossAtASmallAngleFallAwayFromEachOther) {
  const double angle = 0.015, half = 1, radii = 0.1;
  const Capsule capsule{0.05, 2 * half};
  const Quat q(Eigen::AngleAxisd(angle, Vec3::UnitX()));
  const Manifold m = manifold_of(capsule, {}, capsule, {{radii + 1e-4, 0, 0}, q}, 0.02);
  ASSERT_EQ(m.count, 3);  // where they cross, and both ends
  EXPECT_NEAR(m.points[0].gap, 1e-4, 1e-12);
  // An end is this far from the other's axis.
  const double end = std::hypot(radii + 1e-4, half * std::sin(angle)) - radii;
  EXPECT_NEAR(m.points[1].gap, end, 1e-7);
}

TEST(Manifold, CapsuleLiesOnABoxAndOnAPrism) {
  const Capsule capsule{0.1, 1};
  for (const Shape& base :
       {Shape(Box{{3, 3, 1}}), Shape(box_as_convex({3, 3, 1})), Shape(prism(12, 2, 1))}) {
    for (const double gap : {-1e-3, 1e-3}) {
      const Manifold m = manifold_of(base, {}, capsule, {{0.1, 0.2, 0.6 + gap}, kOnSide}, 0.02);
      ASSERT_EQ(m.count, 2);
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(m.points[k].gap, gap, 1e-13);
      // A convex comes after a capsule: then the normal is the other way round.
      EXPECT_NEAR(std::abs(m.normal.z()), 1, 1e-14);
    }
  }
}

TEST(Manifold, PrismsStackOnFourPointsWithExactGaps) {
  for (const int sides : {3, 4, 6, 12, 24, 48}) {
    const Convex p = prism(sides, 0.5, 1);
    for (const double tilt : {0.0, 1e-6, 1e-3}) {
      for (const double gap : {-1e-3, 1e-3}) {
        const Quat q = Quat(Eigen::AngleAxisd(tilt, Vec3(0.6, 0.8, 0))) *
                       Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
        double lowest = 0;
        for (const Vec3& v : p.vertices) lowest = std::min(lowest, (q * v).z());
        const Pose pose{{0.05, 0, 0.5 - lowest + gap}, q};
        for (const Shape& base : {Shape(Box{{3, 3, 1}}), Shape(prism(6, 1.5, 1))}) {
          const Manifold m = manifold_of(base, {}, p, pose, 0.02);
          ASSERT_GE(m.count, sides == 3 ? 3 : 4);
          EXPECT_NEAR(least_gap(m), gap, kSameGap) << sides << " tilt " << tilt;
          EXPECT_GT(area(m), sides == 3 ? 0.3 : 0.43);
          for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
            // The gap is the height of the prism's face above the plane z = 0.5 at this point.
            const Vec3 face = q * -Vec3::UnitZ();
            const Vec3 on_face = pose.c + 0.5 * face;
            const double height =
                on_face.z() - 0.5 -
                face.head<2>().dot((m.points[k].point - on_face).head<2>()) / face.z();
            EXPECT_NEAR(m.points[k].gap, height, 2e-6);
          }
        }
      }
    }
  }
}

TEST(Manifold, ConvexAndBoxOfTheSameFormAgree) {
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 size(random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1));
    const Box other = std::get<Box>(random_shape(kBox, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 1.5) * random.direction(), random.rotation()};
    const Manifold by_axes = manifold_of(other, pose_b, Box{size}, pose_a, 0.05);
    const Manifold general = manifold_of(other, pose_b, box_as_convex(size), pose_a, 0.05);
    ASSERT_EQ(by_axes.count > 0, general.count > 0) << "case " << i;
    if (by_axes.count > 0) {
      ASSERT_NEAR(least_gap(by_axes), least_gap(general), 3e-6) << "case " << i;
    }
  }
}

TEST(Manifold, ACylinderOnACylinderTouchesOnTheSmallerRing) {
  for (const double gap : {-1e-3, 1e-3}) {
    const Manifold m = manifold_of(Cylinder{0.5, 1}, {}, Cylinder{0.3, 1},
                                   {{0.02, 0, 1 + gap}, Quat::Identity()}, 0.02);
    ASSERT_EQ(m.count, 4);
    EXPECT_GT(area(m), 0.16);  // of 0.18 m²
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].gap, gap, 1e-9);
  }
}

TEST(Manifold, AConeStandsOnABoxOnItsRing) {
  const Manifold m =
      manifold_of(Box{{3, 3, 1}}, {}, Cone{0.4, 1}, {{0, 0, 1 + 1e-4}, Quat::Identity()}, 0.02);
  ASSERT_EQ(m.count, 4);
  EXPECT_NEAR(area(m), 0.32, 1e-3);
}

// A face of every kind on a face of every kind, shifted, turned and tilted: at least three points
// hold it, whichever shape comes first.
struct Standing {
  Shape shape;
  Quat q;       // that turns its face down
  double half;  // [m] from its centre to the face
};

std::vector<Standing> standing_shapes() {
  const Quat none = Quat::Identity(), over(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  return {{Box{{1, 0.8, 0.6}}, none, 0.3}, {prism(6, 0.5, 0.6), none, 0.3},
          {prism(3, 0.5, 0.6), over, 0.3}, {prism(40, 0.5, 0.6), none, 0.3},
          {Cylinder{0.5, 0.6}, none, 0.3}, {Cone{0.5, 0.6}, none, 0.3}};
}

TEST(Manifold, FacesOnFacesHaveThreePointsWhileTheyTilt) {
  Random random(11);
  const Quat over(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  for (const Standing& base : standing_shapes()) {
    for (const Standing& top : standing_shapes()) {
      for (const double tilt : {0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2}) {
        for (int i = 0; i < 24; ++i) {
          const double gap = (i % 2 ? 1 : -1) * random.log_uniform(1e-8, 1e-3);
          const Pose world{random.in_box(3), random.rotation()};
          const Quat about(Eigen::AngleAxisd(random.uniform(0, 6), Vec3::UnitZ()));
          const double angle = random.uniform(0, 6);
          const Quat tilted(Eigen::AngleAxisd(tilt, Vec3(std::cos(angle), std::sin(angle), 0)));
          const Vec3 aside(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0);
          const Pose pose_a = world * Pose{{0, 0, -base.half}, over * base.q};
          Pose pose_b = world * Pose{aside + Vec3(0, 0, top.half + 0.01), tilted * about * top.q};
          const Collider a = collider(base.shape, 4), b = collider(top.shape, 9);
          // Moved along the plane's normal until the gap is as wanted.
          for (int k = 0; k < 3; ++k) {
            const Gap now = find_gap(a, pose_a, b, pose_b);
            pose_b.c += (gap - now.value) * (world.q * Vec3::UnitZ());
          }
          Manifold m;
          find_manifold(a, pose_a, b, pose_b, 0.025, m);
          ASSERT_GE(m.count, 3) << shape_name(top.shape) << " on " << shape_name(base.shape)
                                << " tilt " << tilt << " gap " << gap;
          for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k)
            for (std::size_t l = 0; l < k; ++l) ASSERT_NE(m.points[k].feature, m.points[l].feature);
          const double now = find_gap(a, pose_a, b, pose_b).value;
          EXPECT_NEAR(least_gap(m), now, 1e-6)
              << shape_name(top.shape) << " on " << shape_name(base.shape) << " tilt " << tilt
              << " gap " << gap;
          // Crossed edges may be nearest: their normal leans more than the faces.
          EXPECT_GT(std::abs((world.q.conjugate() * m.normal).z()), std::cos(0.02));
        }
      }
    }
  }
}

TEST(Manifold, FacesOnAHalfSpaceHaveThreePointsWhileTheyTilt) {
  Random random(12);
  const Collider ground = collider(HalfSpace{}, 9);
  for (const Standing& top : standing_shapes()) {
    for (const double tilt : {0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2}) {
      for (const double gap : {-1e-3, 1e-3}) {
        const Pose world{random.in_box(3), random.rotation()};
        const double angle = random.uniform(0, 6);
        const Quat tilted(Eigen::AngleAxisd(tilt, Vec3(std::cos(angle), std::sin(angle), 0)));
        const Collider a = collider(top.shape, 4);
        Pose pose = world * Pose{Vec3::Zero(), tilted * top.q};
        const Vec3 up = world.q * Vec3::UnitZ();
        pose.c += (gap - find_gap(a, pose, ground, world).value) * up;
        Manifold m;
        find_manifold(a, pose, ground, world, 0.025, m);
        ASSERT_GE(m.count, 3) << shape_name(top.shape) << " tilt " << tilt;
        EXPECT_NEAR(least_gap(m), gap, 1e-7);
      }
    }
  }
}

TEST(Manifold, SettledPointsDoNotJumpWithTheLastBits) {
  Random random(7);
  const Box base{{3, 3, 1}};
  for (const Shape& shape :
       {Shape(Cylinder{0.4, 1}), Shape(prism(12, 0.4, 1)), Shape(Box{{1, 1, 1}})}) {
    const Manifold before =
        manifold_of(base, {}, shape, {{0.1, 0.2, 1 - 1e-5}, Quat::Identity()}, 0.02);
    for (int i = 0; i < 200; ++i) {
      const Quat q(Eigen::AngleAxisd(random.uniform(0, 1e-8), random.direction()));
      const Manifold m = manifold_of(base, {}, shape, {{0.1, 0.2, 1 - 1e-5}, q}, 0.02);
      ASSERT_EQ(m.count, before.count);
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_NEAR((m.points[k].point - before.points[k].point).norm(), 0, 1e-6)
            << shape_name(shape);
        ASSERT_EQ(m.points[k].feature, before.points[k].feature) << shape_name(shape);
      }
    }
  }
}

}  // namespace
}  // namespace poinsot::test
