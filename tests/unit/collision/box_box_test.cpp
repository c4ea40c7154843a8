#include "poinsot/collision/box_box.h"

#include <gtest/gtest.h>

#include "poinsot/collision/proximity.h"
#include "support/fcl_oracle.h"
#include "support/geometry.h"

namespace poinsot::test {
namespace {

double least_gap(const Manifold& m) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < m.count; ++k)
    least = std::min(least, m.points[static_cast<std::size_t>(k)].gap);
  return least;
}

Manifold manifold_of(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b,
                     double margin) {
  Manifold m;
  find_manifold(collider(a, 0), pose_a, collider(b, 1), pose_b, margin, m);
  return m;
}

// The 15 axes, written with nothing but the definition.
double fifteen_axes(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b) {
  const Mat3 A = pose_a.q.toRotationMatrix(), B = pose_b.q.toRotationMatrix();
  const Vec3 c = pose_b.c - pose_a.c;
  double best = -std::numeric_limits<double>::infinity();
  const auto test = [&](const Vec3& axis) {
    if (axis.norm() < 1e-6) return;
    const Vec3 n = axis.normalized();
    best = std::max(best, std::abs(c.dot(n)) - 0.5 * a.size.dot((A.transpose() * n).cwiseAbs()) -
                              0.5 * b.size.dot((B.transpose() * n).cwiseAbs()));
  };
  for (int i = 0; i < 3; ++i) {
    test(A.col(i));
    test(B.col(i));
    for (int j = 0; j < 3; ++j) test(A.col(i).cross(B.col(j)));
  }
  return best;
}

TEST(BoxBox, DepthIsThatOfTheFifteenAxes) {
  Random random(1);
  int overlaps = 0, edges = 0;
  for (int i = 0; i < 100000; ++i) {
    const Box a = std::get<Box>(random_shape(kBox, random)),
              b = std::get<Box>(random_shape(kBox, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 2) * random.direction(), random.rotation()};
    const double exact = fifteen_axes(a, pose_a, b, pose_b);
    if (exact > 0) continue;
    ++overlaps;
    const Manifold m = manifold_of(a, pose_a, b, pose_b, 0.01);
    ASSERT_GE(m.count, 1) << "case " << i;
    // Faces may be preferred by kEdgeAdvantage of the smaller radius.
    ASSERT_NEAR(least_gap(m), exact, 2e-6) << "case " << i;
    ASSERT_NEAR(separation(a, pose_a, b, pose_b, m.normal), exact, 2e-6);
    edges += m.count == 1;
  }
  EXPECT_GT(overlaps, 50000);
  EXPECT_GT(edges, 1000);
}

TEST(BoxBox, DepthNeverExceedsFcls) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Box a = std::get<Box>(random_shape(kBox, random)),
              b = std::get<Box>(random_shape(kBox, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 2) * random.direction(), random.rotation()};
    const double depth = -least_gap(manifold_of(a, pose_a, b, pose_b, 0));
    const double fcl = fcl_box_depth(a, pose_a, b, pose_b);
    if (fcl == 0) {
      ASSERT_LE(depth, 1e-12) << "case " << i;
      continue;
    }
    ASSERT_LE(depth, fcl + 1e-12) << "case " << i;
    ASSERT_GE(depth, fcl / 1.0501) << "case " << i;  // FCL prefers faces by 5 %
  }
}

TEST(BoxBox, LeastGapWithinTheMarginIsTheDistance) {
  Random random(3);
  int found = 0, none = 0;
  for (int i = 0; i < 20000; ++i) {
    const Box a = std::get<Box>(random_shape(kBox, random)),
              b = std::get<Box>(random_shape(kBox, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(1, 3) * random.direction(), random.rotation()};
    const Gap gap = find_gap(collider(a), pose_a, collider(b), pose_b);
    if (gap.value < 0) continue;
    constexpr double kMargin = 0.3;
    const Manifold m = manifold_of(a, pose_a, b, pose_b, kMargin);
    if (gap.lower > kMargin) {
      ++none;
      ASSERT_EQ(m.count, 0) << "case " << i << " gap " << gap.value;
    } else {
      ++found;
      ASSERT_GE(m.count, 1) << "case " << i << " gap " << gap.value;
      ASSERT_NEAR(least_gap(m), gap.value, 3e-6) << "case " << i;
      for (int k = 0; k < m.count; ++k)
        ASSERT_LE(m.points[static_cast<std::size_t>(k)].gap, kMargin + 1e-12);
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 1000);
}

TEST(BoxBox, TiltedFacesKeepFourPointsWithExactGaps) {
  const Box lower{{2, 2, 1}}, upper{{1, 1, 1}};
  for (const double tilt : {0.0, 1e-12, 1e-8, 1e-4, 1e-3, 1e-2}) {
    for (const double turn : {0.0, 0.3, 0.785}) {
      for (const double gap : {-1e-3, 0.0, 1e-3}) {
        const Quat q = Quat(Eigen::AngleAxisd(tilt, Vec3(0.8, 0.6, 0))) *
                       Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()));
        // The upper box's lowest corner is at height 0.5 + gap.
        double drop = 0;
        std::vector<Vec3> corners;
        for (const Vec3& c : {Vec3(1, 1, -1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, -1)}) {
          corners.push_back(q * Vec3(0.5 * c));
          drop = std::min(drop, corners.back().z());
        }
        const Pose pose{{0.1, -0.2, 0.5 + gap - drop}, q};
        const Manifold m = manifold_of(lower, {}, upper, pose, 0.02);
        ASSERT_EQ(m.count, 4) << "tilt " << tilt << " turn " << turn;
        EXPECT_NEAR(m.normal.z(), -1, 1e-4);
        EXPECT_NEAR(least_gap(m), gap, 1e-15);
        for (int k = 0; k < 4; ++k) {
          const ManifoldPoint& p = m.points[static_cast<std::size_t>(k)];
          double nearest = 1;
          for (const Vec3& c : corners) {
            const Vec3 corner = pose.c + c;
            const double height = corner.z() - 0.5;
            if ((p.point - Vec3(corner.x(), corner.y(), 0.5 + 0.5 * height)).norm() > 2e-4)
              continue;
            nearest = std::min(nearest, std::abs(p.gap - height));
          }
          EXPECT_LT(nearest, tilt > 1e-3 ? 1e-6 : 1e-14) << "point " << k << " tilt " << tilt;
        }
      }
    }
  }
}

TEST(BoxBox, EqualBoxesExactlyStackedTouchAtTheirFourCorners) {
  const Box box{{1, 1, 1}};
  for (const double gap : {-1e-3, 0.0, 1e-3}) {
    const Manifold m = manifold_of(box, {}, box, {{0, 0, 1 + gap}, Quat::Identity()}, 0.02);
    ASSERT_EQ(m.count, 4);
    for (int k = 0; k < 4; ++k) {
      const ManifoldPoint& p = m.points[static_cast<std::size_t>(k)];
      EXPECT_NEAR(p.gap, gap, 1e-15);
      EXPECT_NEAR(std::abs(p.point.x()), 0.5, 1e-12);
      EXPECT_NEAR(std::abs(p.point.y()), 0.5, 1e-12);
      EXPECT_NEAR(p.point.z(), 0.5 + 0.5 * gap, 1e-15);
    }
  }
}

TEST(BoxBox, AnEighthTurnStackKeepsFourOfEightPointsAllAround) {
  const Box box{{1, 1, 1}};
  const Quat eighth(Eigen::AngleAxisd(0.78539816339744831, Vec3::UnitZ()));
  const Manifold m = manifold_of(box, {}, box, {{0, 0, 0.999}, eighth}, 0.02);
  ASSERT_EQ(m.count, 4);
  Vec3 middle = Vec3::Zero();
  for (int k = 0; k < 4; ++k) middle += 0.25 * m.points[static_cast<std::size_t>(k)].point;
  EXPECT_LT(middle.head<2>().norm(), 0.15);
}

TEST(BoxBox, CrossedEdgesTouchWhereTheyCross) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    // Two rods, each turned by an eighth about its axis, so that an edge looks at the other.
    const Box a{{2, 0.2, 0.2}}, b{{0.2, 2, 0.2}};
    const Quat qa(Eigen::AngleAxisd(0.78539816339744831, Vec3::UnitX()));
    const Quat qb(Eigen::AngleAxisd(0.78539816339744831, Vec3::UnitY()));
    const double gap = random.uniform(-0.01, 0.01);
    const Vec3 cross(random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8), 0);
    const double reach = 0.1 * std::sqrt(2.0);
    const Pose world{random.in_box(3), random.rotation()};
    const Pose pose_a = world * Pose{{0, cross.y(), reach + 0.5 * gap}, qa};
    const Pose pose_b = world * Pose{{cross.x(), 0, -reach - 0.5 * gap}, qb};
    const Manifold m = manifold_of(a, pose_a, b, pose_b, 0.02);
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(m.points[0].gap, gap, 1e-14);
    EXPECT_NEAR((m.points[0].point - world * cross).norm(), 0, 1e-13);
    EXPECT_NEAR(m.normal.dot(world.q * Vec3::UnitZ()), 1, 1e-14);
  }
}

TEST(BoxBox, SwappingTheArgumentsGivesTheSameBits) {
  Random random(5);
  for (int i = 0; i < 5000; ++i) {
    const Collider a = collider(random_shape(kBox, random), 3),
                   b = collider(random_shape(kBox, random), 8);
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 2) * random.direction(), random.rotation()};
    Manifold ab, ba;
    find_manifold(a, pose_a, b, pose_b, 0.1, ab);
    find_manifold(b, pose_b, a, pose_a, 0.1, ba);
    ASSERT_EQ(ab.count, ba.count);
    if (ab.count > 0) {
      ASSERT_EQ(ab.normal, Vec3(-ba.normal));
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(ab.count); ++k) {
      ASSERT_EQ(ab.points[k].point, ba.points[k].point);
      ASSERT_EQ(ab.points[k].gap, ba.points[k].gap);
    }
  }
}

TEST(BoxBox, PointsLieInBothBoxesUpToHalfTheirGap) {
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const Box a = std::get<Box>(random_shape(kBox, random)),
              b = std::get<Box>(random_shape(kBox, random));
    const Pose pose_a{random.in_box(1), random.rotation()};
    const Pose pose_b{pose_a.c + random.uniform(0, 2) * random.direction(), random.rotation()};
    const Manifold m = manifold_of(a, pose_a, b, pose_b, 0.02);
    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
      const double half = 0.5 * std::abs(m.points[k].gap) + 3e-6;
      ASSERT_LE(outside_by(a, pose_a.inverse() * m.points[k].point), half) << "case " << i;
      ASSERT_LE(outside_by(b, pose_b.inverse() * m.points[k].point), half) << "case " << i;
    }
  }
}

TEST(BoxBox, ASmallBoxOnAHugeGroundTouchesAtFourCorners) {
  const Box ground{{1e4, 1e4, 1e3}}, box{{0.01, 0.02, 0.01}};
  for (const double x : {0.0, 123.456, -4000.25}) {
    const Manifold m =
        manifold_of(ground, {}, box, {{x, 2 * x / 3, 500 + 0.005 - 1e-7}, Quat::Identity()}, 1e-4);
    ASSERT_EQ(m.count, 4);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].gap, -1e-7, 1e-12);
  }
}

TEST(BoxBox, ThinPlatesTouchOnTheirFacesNotTheirRims) {
  const Box plate{{1, 1, 1e-3}};
  const Manifold m =
      manifold_of(plate, {}, plate, {{0.3, 0.2, 1e-3 - 1e-5}, Quat::Identity()}, 0.05);
  ASSERT_EQ(m.count, 4);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(m.points[k].gap, -1e-5, 1e-16);
}

}  // namespace
}  // namespace poinsot::test
