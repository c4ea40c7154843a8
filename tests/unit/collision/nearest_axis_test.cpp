#include "poinsot/collision/nearest_axis.h"

#include <gtest/gtest.h>

#include "support/coursed_pair.h"

namespace poinsot::test {
namespace {

// Two still shapes, b moved along −`normal` until the gap is `gap`.
BodyDef still(const Shape& shape, const Vec3& at, const Quat& q = Quat::Identity()) {
  return moving(shape, at, Vec3::Zero(), Vec3::Zero(), q);
}

struct Seen {
  NearestAxis axis;
  std::uint64_t gaps;
};
Seen look(const BodyDef& a, const BodyDef& b, const Vec3& hint = Vec3::Zero()) {
  const CoursedPair pair(a, b, 1);
  SearchWork work;
  PairMotion motion(pair.pair(), work);
  motion.go_to(0);
  const NearestAxis axis = nearest_axis(motion, hint);
  return {axis, work.gaps};
}

constexpr double kGaps[] = {0.3, 1e-3, 1e-6, 1e-9, 1e-12, 0, -1e-9, -1e-6};
const Vec3 kTilted = Vec3(0.03, -0.02, 1).normalized();

TEST(NearestAxis, CrossedEdgesKeepTheirNormalWhateverTheGap) {
  const Quat along_x(Eigen::AngleAxisd(0.7, Vec3::UnitX()));
  const Quat along_y(Eigen::AngleAxisd(0.8, Vec3::UnitY()));
  const Box box{{1, 1, 1}};
  const double reach_a = 0.5 * (std::cos(0.7) + std::sin(0.7));
  const double reach_b = 0.5 * (std::cos(0.8) + std::sin(0.8));
  for (const double gap : kGaps) {
    const Seen seen = look(still(box, {0.1, 0.2, reach_a + reach_b + gap}, along_x),
                           still(box, Vec3::Zero(), along_y), kTilted);
    EXPECT_NEAR(seen.axis.gap, gap, 1e-14) << gap;
    EXPECT_NEAR((seen.axis.n - Vec3::UnitZ()).norm(), 0, 1e-9) << gap;
  }
}

TEST(NearestAxis, ACornerOverAFaceKeepsTheFacesNormal) {
  const Box box{{1, 1, 1}};
  const Quat corner_down = Quat::FromTwoVectors(Vec3(-1, -1, -1), -Vec3::UnitZ());
  for (const double gap : kGaps) {
    const Seen seen = look(still(box, {0.1, 0.2, 0.5 + 0.5 * std::sqrt(3.0) + gap}, corner_down),
                           still(box, Vec3::Zero()), kTilted);
    EXPECT_NEAR(seen.axis.gap, gap, 1e-14) << gap;
    EXPECT_NEAR((seen.axis.n - Vec3::UnitZ()).norm(), 0, 1e-12) << gap;
    EXPECT_NEAR((seen.axis.middle - Vec3(0.1, 0.2, 0.5 + 0.5 * gap)).norm(), 0, 1e-9) << gap;
  }
}

TEST(NearestAxis, EllipsoidsKeepTheirNormalTo1em6) {
  const Ellipsoid a{{0.5, 0.4, 0.3}}, b{{0.6, 0.3, 0.5}};
  for (const double gap : kGaps) {
    const Seen seen = look(still(a, {0, 0, 0.8 + gap}), still(b, Vec3::Zero()), kTilted);
    EXPECT_NEAR(seen.axis.gap, gap, 1e-12) << gap;
    EXPECT_NEAR((seen.axis.n - Vec3::UnitZ()).norm(), 0, 3e-6) << gap;
  }
}

TEST(NearestAxis, OfSpheresAndHalfSpacesNeedsNoQuery) {
  const Seen balls = look(still(Sphere{0.5}, {0, 0, 2}), still(Sphere{1}, {0, 0, 0}));
  EXPECT_EQ(balls.gaps, 0u);
  EXPECT_EQ(balls.axis.n, Vec3::UnitZ());
  EXPECT_NEAR(balls.axis.gap, 0.5, 1e-15);
  EXPECT_NEAR((balls.axis.middle - Vec3(0, 0, 1.25)).norm(), 0, 1e-15);
  const Seen box = look(still(Box{{1, 1, 1}}, {0, 0, 2}), ground());
  EXPECT_EQ(box.gaps, 0u);
  EXPECT_EQ(box.axis.gap, 1.5);
  EXPECT_EQ(box.axis.middle.z(), 0.75);
}

TEST(NearestAxis, FirstAxisIsTheHintButForSpheresAndHalfSpaces) {
  const CoursedPair boxes(still(Box{{1, 1, 1}}, {0, 0, 2}), still(Sphere{1}, {0, 0, 0}), 1);
  SearchWork work;
  PairMotion motion(boxes.pair(), work);
  motion.go_to(0);
  EXPECT_EQ(first_axis(motion, Vec3::Zero()), Vec3::UnitZ());
  EXPECT_EQ(first_axis(motion, kTilted), kTilted);
  const CoursedPair plane(still(Sphere{1}, {0, 0, 2}), ground(), 1);
  PairMotion on_plane(plane.pair(), work);
  on_plane.go_to(0);
  EXPECT_EQ(first_axis(on_plane, kTilted), Vec3::UnitZ());
}

}  // namespace
}  // namespace poinsot::test
