#include "poinsot/scene/shape.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr double kUlp = 4 * std::numeric_limits<double>::epsilon();

TEST(BoundingRadius, ReachesTheFarthestPointOfEachShape) {
  EXPECT_DOUBLE_EQ(bounding_radius(Sphere{2}), 2);
  EXPECT_NEAR(bounding_radius(Box{Vec3(2, 4, 4)}), 3, 3 * kUlp);            // a corner
  EXPECT_DOUBLE_EQ(bounding_radius(Capsule{1, 3}), 2.5);                    // the end of a cap
  EXPECT_DOUBLE_EQ(bounding_radius(Cylinder{3, 8}), 5);                     // the rim
  EXPECT_DOUBLE_EQ(bounding_radius(Cone{3, 8}), 5);                         // the rim, not the apex
  EXPECT_DOUBLE_EQ(bounding_radius(Cone{0.001, 8}), std::hypot(0.001, 4));  // nor in a needle
  EXPECT_DOUBLE_EQ(bounding_radius(Ellipsoid{Vec3(1, 3, 2)}), 3);
  const Vec3 points[] = {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5, 1, 0), Vec3(5, 0, 1)};
  EXPECT_DOUBLE_EQ(bounding_radius(convex_hull(points)), 6);  // about the origin, not the middle
  EXPECT_TRUE(std::isinf(bounding_radius(HalfSpace{})));
}

TEST(ShapeName, IsThatOfTheVariant) {
  EXPECT_EQ(shape_name(Sphere{}), "sphere");
  EXPECT_EQ(shape_name(Cone{}), "cone");
  EXPECT_EQ(shape_name(HalfSpace{}), "half_space");
}

}  // namespace
}  // namespace poinsot
