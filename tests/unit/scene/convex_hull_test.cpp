// convex_hull(): a polyhedron whatever the order, repetition and rounding of the points.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/scene/mass_properties.h"
#include "poinsot/scene/shape.h"

namespace poinsot {
namespace {

std::vector<Vec3> cube_corners() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, (i & 2) / 2, (i & 4) / 4);
  return points;
}

// What every hull must be: closed, convex, with all points inside up to `slack`.
void expect_hull_of(const Convex& hull, const std::vector<Vec3>& points, double slack) {
  std::map<std::pair<int, int>, int> edges;
  for (const Convex::Face& face : hull.faces) {
    EXPECT_NEAR(face.normal.norm(), 1, 1e-15);
    ASSERT_GE(face.loop.size(), 3u);
    for (std::size_t k = 0; k < face.loop.size(); ++k) {
      const int from = face.loop[k], to = face.loop[(k + 1) % face.loop.size()];
      ++edges[{from, to}];
      EXPECT_NEAR(face.normal.dot(hull.vertices[static_cast<std::size_t>(from)]), face.offset,
                  slack);
    }
    for (const Vec3& p : points) EXPECT_LE(face.normal.dot(p), face.offset + slack);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(hull.vertices.size() + hull.faces.size(), edges.size() / 2 + 2);  // Euler
}

bool same(const Convex& a, const Convex& b) {
  return a.vertices == b.vertices &&
         std::ranges::equal(a.faces, b.faces, [](const auto& f, const auto& g) {
           return f.loop == g.loop && f.normal == g.normal && f.offset == g.offset;
         });
}

TEST(ConvexHull, TakesAnyNumberOfRepeatedPoints) {
  std::vector<Vec3> points;
  for (int k = 0; k < 50'000; ++k)
    for (const Vec3& corner : cube_corners()) points.push_back(corner);
  const auto start = std::chrono::steady_clock::now();
  const Convex hull = convex_hull(points);
  // Time grows with the number of points, not with its square: that would be minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  EXPECT_TRUE(same(hull, convex_hull(cube_corners())));
}

TEST(ConvexHull, OfACubeHasSixSquaresCounterClockwiseSeenFromOutside) {
  const std::vector<Vec3> points = cube_corners();
  const Convex hull = convex_hull(points);
  EXPECT_EQ(hull.vertices, points);
  ASSERT_EQ(hull.faces.size(), 6u);
  for (const Convex::Face& face : hull.faces) {
    ASSERT_EQ(face.loop.size(), 4u);
    const auto corner = [&](int k) {
      return points[static_cast<std::size_t>(face.loop[static_cast<std::size_t>(k)])];
    };
    const Vec3 turn = (corner(1) - corner(0)).cross(corner(2) - corner(1));
    EXPECT_NEAR(turn.dot(face.normal), 1, 1e-15);
    EXPECT_GT(face.normal.dot(corner(0) - Vec3(0.5, 0.5, 0.5)), 0);
  }
  expect_hull_of(hull, points, 1e-15);
}

TEST(ConvexHull, DropsInnerRepeatedAndMidEdgePoints) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 6; ++i)
    for (int j = 0; j <= 6; ++j)
      for (int k = 0; k <= 6; ++k) points.emplace_back(i / 6.0, j / 6.0, k / 6.0);
  const std::vector<Vec3> again = points;
  points.insert(points.end(), again.begin(), again.end());
  const Quat turn =
      Quat(0.3, 0.5, -0.2, 0.7).normalized();  // so that nothing is exactly in a plane
  for (Vec3& p : points) p = turn * p;
  const Convex hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  EXPECT_EQ(hull.faces.size(), 6u);
  expect_hull_of(hull, points, 1e-14);
}

TEST(ConvexHull, KeepsTheOrderOfThePoints) {
  std::vector<Vec3> points = cube_corners();
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_EQ(convex_hull(points).vertices, points);
  }
  points.insert(points.begin() + 3, Vec3(0.5, 0.5, 0.5));  // an inner point shifts nothing
  const Convex hull = convex_hull(points);
  points.erase(points.begin() + 3);
  EXPECT_EQ(hull.vertices, points);
}

TEST(ConvexHull, IsTheSameEveryTime) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i)
    points.push_back(Vec3(normal(random), normal(random), normal(random)).normalized());
  const Convex hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 300u);  // all on a sphere, none inside
  EXPECT_EQ(hull.faces.size(), 596u);     // triangles: F = 2 V − 4
  expect_hull_of(hull, points, 1e-14);
  EXPECT_TRUE(same(hull, convex_hull(points)));
}

TEST(ConvexHull, MergesAFineCurveNoFurtherThanItsPlanes) {
  const int n = 720;
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (double z : {0.0, 1.0})
      points.emplace_back(std::cos(2 * std::numbers::pi * i / n),
                          std::sin(2 * std::numbers::pi * i / n), z);
  const Convex hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 2u * n);
  EXPECT_EQ(hull.faces.size(), n + 2u);
}

TEST(ConvexHull, SurvivesRoundingOfEverySize) {
  // Points of a small lattice, displaced by 1e-6 … 1e-17: near-repetitions, near-planes, slivers.
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> lattice(0, 3), count(8, 40);
  std::uniform_real_distribution<double> exponent(6, 17);
  int made = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double noise = std::pow(10, -exponent(random));
    std::vector<Vec3> points;
    const int n = count(random);
    for (int i = 0; i < n; ++i)
      points.push_back(Vec3(lattice(random), lattice(random), lattice(random)) +
                       noise * Vec3(normal(random), normal(random), normal(random)));
    try {
      const Convex hull = convex_hull(points);
      // Planes are fitted to points within 1e-9 of the diagonal (5.2 m) of a first triangle; small
      // triangles at the edge of a large face lever that up by the ratio of the sizes.
      expect_hull_of(hull, points, 5e-8);
      ++made;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("must not lie"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(made, 450);
}

TEST(ConvexHull, ScalesFromMicrometresToMegametres) {
  for (double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Vec3> points = cube_corners();
    for (Vec3& p : points) p *= scale;
    const Convex hull = convex_hull(points);
    EXPECT_EQ(hull.faces.size(), 6u);
    EXPECT_NEAR(volume(hull) / (scale * scale * scale), 1, 1e-14);
  }
}

std::string refusal(const std::vector<Vec3>& points) {
  try {
    convex_hull(points);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ConvexHull, RefusesWhatHasNoVolume) {
  const std::vector<Vec3> cube = cube_corners();
  EXPECT_EQ(refusal({cube.begin(), cube.begin() + 3}),
            "a convex shape needs at least 4 points, has 3");
  EXPECT_EQ(refusal({cube.begin(), cube.begin() + 4}),
            "a convex shape's points must not lie in a plane");
  EXPECT_EQ(refusal({cube[0], cube[1], cube[2], cube[1], cube[2]}),
            "a convex shape's points must not lie in a plane");  // three distinct ones
  EXPECT_EQ(refusal({Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(3, 6, 9)}),
            "a convex shape's points must not lie on a line");
  EXPECT_EQ(refusal(std::vector<Vec3>(5, Vec3(1, 1, 1))),
            "a convex shape's points must not all be one point");
  std::vector<Vec3> sheet = cube;
  for (Vec3& p : sheet) p.z() *= 1e-7;
  EXPECT_EQ(refusal(sheet), "a convex shape's points must not lie in a plane");
  std::vector<Vec3> broken = cube;
  broken[5].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(broken), "a convex shape's points must be finite");
}

}  // namespace
}  // namespace poinsot
