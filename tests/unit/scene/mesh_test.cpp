#include "poinsot/scene/mesh.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"

namespace poinsot {
namespace {

using Loop = std::array<int, 3>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string refusal(const std::vector<Vec3>& vertices, const std::vector<Loop>& triangles) {
  try {
    make_mesh(vertices, triangles);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(MakeMesh, KeepsTheOrderAndTheBits) {
  const Mesh mesh = make_mesh(kCorners, std::vector<Loop>{{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(mesh.vertices, kCorners);
  EXPECT_EQ(mesh.triangles, (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.left_out, 0);
}

TEST(MakeMesh, MakesOneVertexOfCornersAtOnePlace) {
  const std::vector<Vec3> soup = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0, 0, 0},
                                  {1, 1, 0}, {0, 1, 0}, {7, 7, 7}};
  const Mesh mesh = make_mesh(soup, std::vector<Loop>{{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(mesh.vertices, kCorners);  // and none that no triangle uses
  EXPECT_EQ(mesh.triangles, (std::vector<Loop>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(MakeMesh, LeavesOutAndCountsWhatHasNoArea) {
  std::vector<Vec3> vertices = kCorners;
  vertices.push_back({0.5, 0, 0});
  vertices.push_back({0.5, 1e-13, 0});
  vertices.push_back({0.5, 1e-9, 0});
  const Mesh mesh =
      make_mesh(vertices, std::vector<Loop>{{0, 1, 1}, {0, 4, 1}, {0, 5, 1}, {0, 6, 1}, {0, 1, 2}});
  EXPECT_EQ(mesh.left_out, 3);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(MakeMesh, RefusesWhatIsNoMesh) {
  EXPECT_EQ(refusal({}, {}), "a mesh needs a triangle that has an area");
  EXPECT_EQ(refusal(kCorners, {{0, 1, 1}}), "a mesh needs a triangle that has an area");
  EXPECT_EQ(refusal(kCorners, {{0, 1, 2}, {0, 4, 1}}), "triangle 2 of a mesh names vertex 5 of 4");
  EXPECT_EQ(refusal(kCorners, {{0, -1, 1}}), "triangle 1 of a mesh names vertex 0 of 4");
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), 2e9}) {
    std::vector<Vec3> vertices = kCorners;
    vertices[2].y() = bad;
    EXPECT_EQ(refusal(vertices, {{0, 1, 3}}),
              "vertex 3 of a mesh must be finite and at most 1e+09 m");
  }
}

TEST(MakeMesh, RefusesMoreThanFitsOnTheBus) {
  std::vector<Loop> triangles(kMaxTriangles + 1, Loop{0, 1, 2});
  EXPECT_EQ(refusal(kCorners, triangles),
            "a mesh has at most 131072 triangles and 65536 vertices, this one 131073 and 3");
}

}  // namespace
}  // namespace poinsot
