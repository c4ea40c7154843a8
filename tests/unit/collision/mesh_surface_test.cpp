#include "poinsot/collision/mesh_surface.h"

#include <gtest/gtest.h>

#include "support/geometry.h"
#include "support/meshes.h"

namespace poinsot::test {
namespace {

const double kHalfRoot = std::sqrt(0.5);

// Two unit squares of one triangle each that share the edge along y; the right one bends down by
// `slope`.
Mesh roof(double slope) {
  const std::vector<Vec3> v = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0, -slope}};
  return make_mesh(v, std::vector<std::array<int, 3>>{{0, 1, 2}, {1, 3, 2}});
}

TEST(MeshSurface, HasUnitNormalsThatPointOut) {
  const MeshSurface cube(surface_of(box_as_convex({2, 2, 2})));
  ASSERT_EQ(cube.size(), 12);
  for (int t = 0; t < cube.size(); ++t) {
    const Vec3 middle = (cube.corners(t)[0] + cube.corners(t)[1] + cube.corners(t)[2]) / 3;
    EXPECT_NEAR(cube.normal(t).norm(), 1, 1e-15);
    EXPECT_NEAR(cube.normal(t).dot(middle), 1, 1e-15);
  }
  EXPECT_EQ(cube.extent(), 2);
}

TEST(MeshSurface, InsideATriangleOnlyItsNormalsPush) {
  const MeshSurface flat(plane_mesh(1, 1));
  const Vec3 inside(0.3, -0.2, 0);
  EXPECT_TRUE(flat.may_push(0, inside, Vec3::UnitZ()));
  EXPECT_TRUE(flat.may_push(0, inside, -Vec3::UnitZ()));
  EXPECT_FALSE(flat.may_push(0, inside, Vec3(0.01, 0, 1).normalized()));
}

TEST(MeshSurface, AFlatEdgePushesLikeAFace) {
  const MeshSurface flat(roof(0));
  const Vec3 on_edge(0, 0.5, 0);
  EXPECT_TRUE(flat.may_push(0, on_edge, Vec3::UnitZ()));
  EXPECT_FALSE(flat.may_push(0, on_edge, Vec3(1e-5, 0, 1).normalized()));
  EXPECT_FALSE(flat.may_push(0, on_edge, Vec3(kHalfRoot, 0, kHalfRoot)));
}

TEST(MeshSurface, ARidgePushesBetweenItsFaces) {
  const MeshSurface ridge(roof(1));
  const Vec3 on_edge(0, 0.5, 0);
  for (const double angle : {0.0, 0.3, 0.785})
    EXPECT_TRUE(ridge.may_push(0, on_edge, {std::sin(angle), 0, std::cos(angle)})) << angle;
  for (const double angle : {-0.1, 0.8, 2.0})
    EXPECT_FALSE(ridge.may_push(0, on_edge, {std::sin(angle), 0, std::cos(angle)})) << angle;
  EXPECT_FALSE(ridge.may_push(0, on_edge, -Vec3::UnitZ()));  // a valley from there
}

TEST(MeshSurface, AValleyPushesOnlyFromBehind) {
  const MeshSurface valley(roof(-1));
  const Vec3 on_edge(0, 0.5, 0);
  EXPECT_FALSE(valley.may_push(0, on_edge, Vec3::UnitZ()));
  EXPECT_FALSE(valley.may_push(0, on_edge, Vec3(-0.3, 0, 1).normalized()));
  EXPECT_TRUE(valley.may_push(0, on_edge, Vec3(0.3, 0, -1).normalized()));
}

TEST(MeshSurface, AnOpenEdgePushesAside) {
  const MeshSurface flat(roof(0));
  const Vec3 on_edge(-0.5, 0.5, 0);  // of the first triangle, with nothing beyond
  EXPECT_TRUE(flat.may_push(0, on_edge, Vec3(-kHalfRoot, kHalfRoot, 0)));
  EXPECT_TRUE(flat.may_push(0, on_edge, Vec3(-0.3, 0.3, -1).normalized()));
  EXPECT_FALSE(flat.may_push(0, on_edge, Vec3(0.3, -0.3, 1).normalized()));
}

TEST(MeshSurface, ACornerPushesIntoItsOctant) {
  const MeshSurface cube(surface_of(box_as_convex({2, 2, 2})));
  for (int t = 0; t < cube.size(); ++t)
    for (const Vec3& corner : cube.corners(t)) {
      EXPECT_TRUE(cube.may_push(t, corner, corner / std::sqrt(3)));
      EXPECT_TRUE(cube.may_push(t, corner, cube.normal(t)));
      EXPECT_FALSE(cube.may_push(t, corner, -corner / std::sqrt(3)));
      const Vec3 aside = corner.cwiseProduct(Vec3(1, 1, -0.1)).normalized();
      EXPECT_FALSE(cube.may_push(t, corner, aside));
    }
}

TEST(MeshSurface, KnowsTheOtherFacesOfRidges) {
  const auto count = [](const MeshSurface& surface, int t, double side) {
    int ridges = 0;
    surface.across_ridges(t, side, [&](const Vec3&) { ++ridges; });
    return ridges;
  };
  EXPECT_EQ(count(MeshSurface(roof(0)), 0, 1), 0);
  EXPECT_EQ(count(MeshSurface(roof(1)), 0, 1), 1);
  EXPECT_EQ(count(MeshSurface(roof(1)), 0, -1), 0);
  EXPECT_EQ(count(MeshSurface(roof(-1)), 0, 1), 0);
  EXPECT_EQ(count(MeshSurface(roof(-1)), 0, -1), 1);
  const MeshSurface cube(surface_of(box_as_convex({2, 2, 2})));
  for (int t = 0; t < cube.size(); ++t) EXPECT_EQ(count(cube, t, 1), 2);  // and a flat diagonal
}

}  // namespace
}  // namespace poinsot::test
