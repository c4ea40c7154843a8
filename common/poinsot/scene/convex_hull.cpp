// The hull of a set of points: the one file that speaks to libqhull_r.
//
// qhull triangulates the hull; its order of facets and vertices is not ours. What leaves this file
// depends on the points alone: triangles in one plane are merged into a face, a point is a vertex
// if at least three faces meet there, vertices keep the order of the points and faces are sorted
// by their loops.
//
// All tests are made on points moved to the middle of their bounding box and scaled to its
// diagonal, so the tolerances below are relative to the size of the set.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "poinsot/base/error.h"
#include "poinsot/base/hash.h"
#include "poinsot/scene/shape.h"

namespace poinsot {
namespace {

constexpr double kPlaneTolerance = 1e-9;   // [-] points nearer to a plane than this lie in it
constexpr double kFlatness = 1e-6;         // [-] sets thinner than this are flat
constexpr double kRepeatTolerance = 1e-9;  // [-] points nearer to each other than this are one

using Triangle = std::array<int, 3>;
using Points = std::vector<Vec3>;

const Vec3& at(const Points& points, int i) {
  return points[static_cast<std::size_t>(i)];
}

Points normalized(std::span<const Vec3> points) {
  for (const Vec3& p : points)
    if (!p.allFinite()) throw Error("a convex shape's points must be finite");
  if (points.size() < 4)
    throw Error("a convex shape needs at least 4 points, has " + std::to_string(points.size()));
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double scale = (high - low).norm();
  if (!std::isfinite(scale)) throw Error("a convex shape's points are too far apart");
  if (!(scale > 0)) throw Error("a convex shape's points must not all be one point");
  Points result;
  for (const Vec3& p : points) result.push_back((p - (low + high) / 2) / scale);
  return result;
}

// The points that were kept so far, in cells so small that only a few of them fit into one.
class KeptPoints {
 public:
  explicit KeptPoints(const Points& points) : points_(points) {}

  bool has_one_near(const Vec3& p) const {
    const Cell low = cell(p.array() - kRepeatTolerance), high = cell(p.array() + kRepeatTolerance);
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z)
          if (has_one_near(p, {x, y, z})) return true;
    return false;
  }
  void keep(int i) { cells_[cell(at(points_, i))].push_back(i); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const {
      Hash64 hash;
      for (const std::int64_t i : c) hash.add(static_cast<std::uint64_t>(i));
      return static_cast<std::size_t>(hash.value());
    }
  };

  static Cell cell(const Vec3& p) {
    constexpr double kSide = 4 * kRepeatTolerance;
    return {std::llround(p.x() / kSide), std::llround(p.y() / kSide), std::llround(p.z() / kSide)};
  }
  bool has_one_near(const Vec3& p, const Cell& c) const {
    const auto found = cells_.find(c);
    return found != cells_.end() && std::ranges::any_of(found->second, [&](int i) {
             return (at(points_, i) - p).norm() <= kRepeatTolerance;
           });
  }

  const Points& points_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
};

// Indices of the points without repetitions; of equal points the first stays.
std::vector<int> distinct(const Points& points) {
  KeptPoints kept(points);
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (kept.has_one_near(at(points, i))) continue;
    kept.keep(i);
    result.push_back(i);
  }
  return result;
}

// Throws if the points lie on a line or in a plane: the farthest point from the first, then from
// their line, then from their plane.
void check_solid(const Points& points, const std::vector<int>& indices) {
  auto farthest = [&](auto distance) {
    double best = 0;
    int index = indices.front();
    for (int i : indices)
      if (const double d = distance(at(points, i)); d > best) best = d, index = i;
    return std::pair(best, at(points, index));
  };
  const Vec3 a = at(points, indices.front());
  const Vec3 b = farthest([&](const Vec3& p) { return (p - a).norm(); }).second;
  const Vec3 along = (b - a).normalized();
  const auto [width, c] = farthest([&](const Vec3& p) { return (p - a).cross(along).norm(); });
  if (!(width > kFlatness)) throw Error("a convex shape's points must not lie on a line");
  const Vec3 normal = along.cross(c - a).normalized();
  const double height = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - a)); }).first;
  if (!(height > kFlatness)) throw Error("a convex shape's points must not lie in a plane");
}

// qhull's state and message stream, released whatever happens.
class Qhull {
 public:
  Qhull() : errors_(open_memstream(&text_, &size_)) { qh_zero(&qh_, errors_); }
  ~Qhull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int unused_blocks = 0, unused_bytes = 0;
    qh_memfreeshort(&qh_, &unused_blocks, &unused_bytes);
    std::fclose(errors_);
    std::free(text_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  // Triangles of the hull, as positions in `coordinates`; all of one orientation.
  std::vector<Triangle> triangulate(std::vector<double>& coordinates) {
    std::string command = "qhull Qt";
    const int count = static_cast<int>(coordinates.size() / 3);
    if (qh_new_qhull(&qh_, 3, count, coordinates.data(), False, command.data(), nullptr, errors_))
      throw Error("a convex shape's hull cannot be made: its points are too close to a plane");
    qhT* qh = &qh_;  // the name that qhull's macros expect
    std::vector<Triangle> triangles;
    facetT* facet;
    FORALLfacets {
      setT* corners = qh_facet3vertex(qh, facet);
      Triangle triangle{};
      std::size_t k = 0;
      vertexT *vertex, **vertexp;
      FOREACHvertex_(corners) if (k < 3) triangle[k++] = qh_pointid(qh, vertex->point);
      qh_settempfree(qh, &corners);
      triangles.push_back(triangle);
    }
    return triangles;
  }

 private:
  qhT qh_{};
  char* text_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* errors_;
};

Vec3 double_area(const Points& points, const Triangle& t) {
  return (at(points, t[1]) - at(points, t[0])).cross(at(points, t[2]) - at(points, t[0]));
}

// Triangles over the indices of `points`, counter-clockwise seen from outside, in an order that
// depends on nothing but the triangles: smallest index first, then sorted.
std::vector<Triangle> hull_triangles(const Points& points, const std::vector<int>& indices) {
  std::vector<double> coordinates;
  for (int i : indices)
    coordinates.insert(coordinates.end(), at(points, i).begin(), at(points, i).end());
  std::vector<Triangle> triangles = Qhull().triangulate(coordinates);
  double volume = 0;
  const Vec3 inside = at(points, indices.front());
  for (Triangle& t : triangles) {
    for (int& i : t) i = indices[static_cast<std::size_t>(i)];
    volume += (at(points, t[0]) - inside).dot(double_area(points, t));
  }
  for (Triangle& t : triangles) {
    if (volume < 0) std::swap(t[1], t[2]);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// For each triangle the three that share its edges (k: from corner k to the next).
std::vector<Triangle> neighbours(const std::vector<Triangle>& triangles) {
  struct Edge {
    int from, to, triangle, side;
    auto key() const { return std::pair(from, to); }
    bool operator<(const Edge& other) const { return key() < other.key(); }
  };
  std::vector<Edge> edges;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(
          {triangles[t][k], triangles[t][(k + 1) % 3], static_cast<int>(t), static_cast<int>(k)});
  std::sort(edges.begin(), edges.end());
  std::vector<Triangle> result(triangles.size(), Triangle{-1, -1, -1});
  for (const Edge& edge : edges) {
    const auto other = std::lower_bound(edges.begin(), edges.end(), Edge{edge.to, edge.from, 0, 0});
    if (other == edges.end() || other->key() != std::pair(edge.to, edge.from))
      throw Error("a convex shape's hull is not closed: its points are too close to each other");
    result[static_cast<std::size_t>(edge.triangle)][static_cast<std::size_t>(edge.side)] =
        other->triangle;
  }
  return result;
}

// The face of each triangle. A face grows from its largest triangle over all connected ones whose
// corners lie in that triangle's plane: no drift along a finely curved surface, and slivers, whose
// own planes mean nothing, join a neighbour.
std::vector<int> group_by_plane(const Points& points, const std::vector<Triangle>& triangles,
                                const std::vector<Triangle>& adjacent) {
  auto area = [&](int t) {
    return double_area(points, triangles[static_cast<std::size_t>(t)]).squaredNorm();
  };
  std::vector<int> seeds(triangles.size());
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return area(a) > area(b); });

  std::vector<int> group(triangles.size(), -1);
  int groups = 0;
  for (int seed : seeds) {
    if (group[static_cast<std::size_t>(seed)] >= 0) continue;
    const Triangle& first = triangles[static_cast<std::size_t>(seed)];
    const Vec3 normal = double_area(points, first).normalized();
    std::vector<int> open = {seed};
    group[static_cast<std::size_t>(seed)] = groups;
    while (!open.empty()) {
      const auto t = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (int next : adjacent[t]) {
        const auto n = static_cast<std::size_t>(next);
        const bool in_plane = std::ranges::all_of(triangles[n], [&](int i) {
          return std::abs(normal.dot(at(points, i) - at(points, first[0]))) <= kPlaneTolerance;
        });
        if (group[n] >= 0 || !in_plane) continue;
        group[n] = groups;
        open.push_back(next);
      }
    }
    ++groups;
  }
  return group;
}

// The border of each group of triangles as a loop of corners: those points where at least three
// groups meet. A point inside a face belongs to one group, a point inside an edge to two.
std::vector<std::vector<int>> face_loops(std::size_t point_count,
                                         const std::vector<Triangle>& triangles,
                                         const std::vector<Triangle>& adjacent,
                                         const std::vector<int>& group) {
  std::vector<std::set<int>> groups_at(point_count);
  std::vector<std::vector<std::pair<int, int>>> border(triangles.size());  // per group: from, to
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      groups_at[static_cast<std::size_t>(from)].insert(group[t]);
      if (group[static_cast<std::size_t>(adjacent[t][k])] != group[t])
        border[static_cast<std::size_t>(group[t])].emplace_back(from, to);
    }
  }
  std::vector<std::vector<int>> loops;
  for (auto& edges : border) {
    if (edges.empty()) continue;
    std::sort(edges.begin(), edges.end());
    std::vector<int> loop;
    int corner = edges.front().first;
    for (std::size_t step = 0; step < edges.size(); ++step) {
      if (groups_at[static_cast<std::size_t>(corner)].size() >= 3) loop.push_back(corner);
      corner = std::lower_bound(edges.begin(), edges.end(), std::pair(corner, -1))->second;
    }
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops.push_back(loop);
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

// Plane of a loop by Newell's method (normal: sum of the edges' cross products about the middle).
Convex::Face make_face(const std::vector<Vec3>& vertices, std::vector<int> loop) {
  Vec3 middle = Vec3::Zero(), normal = Vec3::Zero();
  for (int i : loop) middle += at(vertices, i);
  middle /= static_cast<double>(loop.size());
  for (std::size_t k = 0; k < loop.size(); ++k)
    normal +=
        (at(vertices, loop[k]) - middle).cross(at(vertices, loop[(k + 1) % loop.size()]) - middle);
  normal.normalize();
  return {normal, normal.dot(middle), std::move(loop)};
}

}  // namespace

Convex convex_hull(std::span<const Vec3> points) {
  const Points unit = normalized(points);
  const std::vector<int> indices = distinct(unit);
  check_solid(unit, indices);
  const std::vector<Triangle> triangles = hull_triangles(unit, indices);
  const std::vector<Triangle> adjacent = neighbours(triangles);
  const std::vector<int> group = group_by_plane(unit, triangles, adjacent);
  const auto loops = face_loops(points.size(), triangles, adjacent, group);

  Convex result;
  std::vector<int> place(points.size(), -1);  // of a point among the vertices
  for (const auto& loop : loops)
    for (int i : loop) place[static_cast<std::size_t>(i)] = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(points[i]);
  }
  std::size_t corners = 0;
  for (std::vector<int> loop : loops) {
    for (int& i : loop) i = place[static_cast<std::size_t>(i)];
    corners += loop.size();
    result.faces.push_back(make_face(result.vertices, std::move(loop)));
  }
  // Euler: V − E + F = 2, and no edge without an area beside it.
  const bool closed = result.vertices.size() + result.faces.size() == corners / 2 + 2;
  const bool proper = std::ranges::all_of(result.faces, [](const Convex::Face& face) {
    return face.loop.size() >= 3 && face.normal.allFinite();
  });
  if (!closed || !proper)
    throw Error("a convex shape's points are too close to each other or to a plane");
  return result;
}

}  // namespace poinsot
