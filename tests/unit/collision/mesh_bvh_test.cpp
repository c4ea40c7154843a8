#include "poinsot/collision/mesh_bvh.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "support/geometry.h"
#include "support/meshes.h"

namespace poinsot::test {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Box3 {
  Vec3 low, high;
};
Box3 box_of(const Mesh& mesh, int t) {
  Box3 box{Vec3::Constant(kInfinite), Vec3::Constant(-kInfinite)};
  for (const int i : mesh.triangles[static_cast<std::size_t>(t)]) {
    box.low = box.low.cwiseMin(mesh.vertices[static_cast<std::size_t>(i)]);
    box.high = box.high.cwiseMax(mesh.vertices[static_cast<std::size_t>(i)]);
  }
  return box;
}
double distance(const Box3& a, const Box3& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0).norm();
}

Mesh bumpy(int n) {
  return terrain(10, n, [](double x, double y) { return std::sin(x) * std::cos(1.3 * y); });
}

TEST(MeshBvh, FindsExactlyTheTrianglesWhoseBoxesOverlap) {
  const Mesh mesh = bumpy(20);
  const MeshBvh bvh(mesh.vertices, mesh.triangles);
  Random random(1);
  std::size_t total = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 c = random.in_box(11), half(random.uniform(0, 3), random.uniform(0, 3), 1);
    const Box3 box{c - half, c + half};
    std::vector<int> found, expected;
    bvh.overlapping(box.low, box.high, [&](int t) { found.push_back(t); });
    std::ranges::sort(found);
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      if (distance(box, box_of(mesh, t)) == 0) expected.push_back(t);
    ASSERT_EQ(found, expected);
    total += found.size();
  }
  EXPECT_GT(total, 500u);
}

TEST(MeshBvh, FindsTheNearestAndLooksAtFew) {
  const Mesh mesh = bumpy(32);
  const MeshBvh bvh(mesh.vertices, mesh.triangles);
  Random random(2);
  int visits = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 c = random.in_box(20) + Vec3(0, 0, 5);
    const Box3 box{c, c + Vec3::Constant(0.1)};
    const double found = bvh.nearest(box.low, box.high, kInfinite, [&](int t) {
      ++visits;
      return distance(box, box_of(mesh, t));
    });
    double least = kInfinite;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      least = std::min(least, distance(box, box_of(mesh, t)));
    ASSERT_EQ(found, least);
  }
  EXPECT_LT(visits, 200 * 64);  // of 2048
}

// Equal boxes leave nothing to split by: the tree must not become a list.
TEST(MeshBvh, ManyTrianglesAtOnePlaceAreNotDeep) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<int, 3>> same(100'000, {0, 1, 2});
  const MeshBvh bvh(corners, same);
  int count = 0;
  bvh.overlapping({0, 0, 0}, {1, 1, 1}, [&](int) { ++count; });
  EXPECT_EQ(count, 100'000);
}

// Sizes from 1e-300 m to 1e9 m: a split at the mean would part one triangle at a time.
TEST(MeshBvh, SizesOfAllOrdersAreNotDeep) {
  std::vector<Vec3> corners;
  std::vector<std::array<int, 3>> triangles;
  double at = 1e9;
  for (int k = 0; k < 1000; ++k, at *= 0.49) {
    for (const Vec3& p : {Vec3(at, 0, 0), Vec3(2 * at, 0, 0), Vec3(at, at, 0)})
      corners.push_back(p);
    triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const MeshBvh bvh(corners, triangles);
  int count = 0;
  bvh.overlapping({0, 0, 0}, {3e9, 3e9, 1}, [&](int) { ++count; });
  EXPECT_EQ(count, 1000);
}

}  // namespace
}  // namespace poinsot::test
