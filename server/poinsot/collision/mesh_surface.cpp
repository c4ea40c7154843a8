#include "poinsot/collision/mesh_surface.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace poinsot {
namespace {

constexpr std::size_t next(std::size_t k) {
  return (k + 1) % 3;
}

}  // namespace

MeshSurface::MeshSurface(const Mesh& mesh) : bvh_(mesh.vertices, mesh.triangles) {
  triangles_.reserve(mesh.triangles.size());
  for (const auto& loop : mesh.triangles) {
    Triangle t;
    t.vertices = loop;
    for (std::size_t k = 0; k < 3; ++k) t.corners[k] = mesh.vertices[index(loop[k])];
    const Vec3 ab = t.corners[1] - t.corners[0], ac = t.corners[2] - t.corners[0];
    t.normal = ab.cross(ac).stableNormalized();
    t.edges = {-1, -1, -1};
    triangles_.push_back(t);
  }
  find_edges();
  find_spokes(mesh.vertices.size());
  extent_ = (bvh_.root().high - bvh_.root().low).maxCoeff();
}

// Sides of triangles between the same two vertices are one edge.
void MeshSurface::find_edges() {
  struct Side {
    std::pair<int, int> ends;
    int triangle;
    std::size_t k;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (int t = 0; t < size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = triangles_[index(t)].vertices;
      sides.push_back({std::minmax({v[k], v[next(k)]}), t, k});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.ends, s.triangle, s.k); });
  wings_.reserve(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].ends != sides[i - 1].ends) wing_row_.push_back(wings_.size());
    Triangle& t = triangles_[index(sides[i].triangle)];
    const std::size_t k = sides[i].k;
    t.edges[k] = static_cast<int>(wing_row_.size()) - 1;
    const Vec3 along = t.corners[next(k)] - t.corners[k];
    wings_.push_back({sides[i].triangle, t.normal.cross(along).stableNormalized()});
  }
  wing_row_.push_back(wings_.size());
}

void MeshSurface::find_spokes(std::size_t vertices) {
  struct Spoke {
    int from, to;
    Vec3 along;
  };
  std::vector<Spoke> spokes;
  spokes.reserve(6 * triangles_.size());
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 along = (t.corners[next(k)] - t.corners[k]).stableNormalized();
      spokes.push_back({t.vertices[k], t.vertices[next(k)], along});
      spokes.push_back({t.vertices[next(k)], t.vertices[k], -along});
    }
  std::ranges::stable_sort(spokes, {}, [](const Spoke& s) { return std::pair(s.from, s.to); });
  spoke_row_.reserve(vertices + 1);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    while (spoke_row_.size() <= index(spokes[i].from)) spoke_row_.push_back(spokes_.size());
    if (i == 0 || spokes[i].from != spokes[i - 1].from || spokes[i].to != spokes[i - 1].to)
      spokes_.push_back(spokes[i].along);
  }
  while (spoke_row_.size() <= vertices) spoke_row_.push_back(spokes_.size());
}

bool MeshSurface::may_push(int t, const Vec3& point, const Vec3& direction) const {
  const Triangle& triangle = triangles_[index(t)];
  // Heights over the edges: which of them the point is on.
  std::array<bool, 3> on;
  int count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = triangle.corners[next(k)] - triangle.corners[k];
    const Vec3 inward = triangle.normal.cross(along).stableNormalized();
    const double height = inward.dot(triangle.corners[next(next(k))] - triangle.corners[k]);
    on[k] = inward.dot(point - triangle.corners[k]) <= kOnEdge * height;
    count += on[k] ? 1 : 0;
  }
  if (count == 0) return std::abs(direction.dot(triangle.normal)) >= 1 - kFlat * kFlat;
  if (count == 1) {
    const auto k = static_cast<std::size_t>(std::ranges::find(on, true) - on.begin());
    return std::ranges::all_of(wings_of(triangle.edges[k]), [&](const Wing& wing) {
      return wing.inward.dot(direction) <= kFlat;
    });
  }
  // On two edges: their common corner. On three, by rounding, none is better than the other.
  const std::size_t corner = on[0] && on[1] ? 1 : on[1] && on[2] ? 2 : 0;
  return std::ranges::all_of(spokes_of(triangle.vertices[corner]),
                             [&](const Vec3& spoke) { return spoke.dot(direction) <= kFlat; });
}

}  // namespace poinsot
