// A triangle mesh prepared for queries: corners, normals, what lies beyond each edge and corner,
// and a tree of boxes. Lengths in metres, in the frame of the mesh.
//
// Bodies meet a mesh triangle by triangle. A single triangle's nearest point may lie on an edge
// that the surface goes on behind: its direction is then one that nobody can feel on the surface.
// may_push() tells those apart: a direction pushes from a point if, from there, the surface goes
// nowhere along it. Both sides count; seen from behind, valleys are ridges.
//
// Source: the polar cone of the surface at a face, an edge or a corner, which is its Voronoi region
// (Ericson, Real-Time Collision Detection, ch. 9).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "poinsot/collision/mesh_bvh.h"
#include "poinsot/scene/shape.h"

namespace poinsot {

class MeshSurface {
 public:
  explicit MeshSurface(const Mesh& mesh);

  int size() const { return static_cast<int>(triangles_.size()); }
  const std::array<Vec3, 3>& corners(int t) const { return triangles_[index(t)].corners; }
  const Vec3& normal(int t) const { return triangles_[index(t)].normal; }  // unit, outward
  const MeshBvh& bvh() const { return bvh_; }
  double extent() const { return extent_; }  // [m] the longest side of its box

  // Whether `direction`, a unit vector, pushes away from the point of triangle t that is `point`
  // [m]. On the inside of a triangle only its normal and the opposite do.
  bool may_push(int t, const Vec3& point, const Vec3& direction) const;

  // Calls visit(normal) for the triangles across the edges of t that bend away from the side that
  // `side` (±1) times its normal points to: the other faces of ridges.
  template <class Visit>
  void across_ridges(int t, double side, Visit&& visit) const {
    for (const int edge : triangles_[index(t)].edges)
      for (const Wing& wing : wings_of(edge))
        if (wing.triangle != t && side * wing.inward.dot(normal(t)) < -kFlat)
          visit(normal(wing.triangle));
  }

 private:
  static constexpr double kFlat = 1e-6;    // [-] sine of an angle that counts as none
  static constexpr double kOnEdge = 1e-3;  // [-] of a triangle's height: as near is on the edge

  struct Triangle {
    std::array<Vec3, 3> corners;
    Vec3 normal;
    std::array<int, 3> vertices;
    std::array<int, 3> edges;  // from each corner to the next
  };
  // A triangle at an edge: the unit vector across the edge into it.
  struct Wing {
    int triangle;
    Vec3 inward;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  std::span<const Wing> wings_of(int edge) const {
    const std::size_t first = wing_row_[index(edge)];
    return {wings_.data() + first, wing_row_[index(edge) + 1] - first};
  }
  std::span<const Vec3> spokes_of(int vertex) const {
    const std::size_t first = spoke_row_[index(vertex)];
    return {spokes_.data() + first, spoke_row_[index(vertex) + 1] - first};
  }
  void find_edges();
  void find_spokes(std::size_t vertices);

  std::vector<Triangle> triangles_;
  std::vector<Wing> wings_;             // edge by edge
  std::vector<std::size_t> wing_row_;   // per edge: where its wings begin
  std::vector<Vec3> spokes_;            // vertex by vertex: unit vectors along the edges from there
  std::vector<std::size_t> spoke_row_;  // per vertex
  MeshBvh bvh_;
  double extent_ = 0;
};

}  // namespace poinsot
