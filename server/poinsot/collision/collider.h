// One shape of one body, prepared for geometry queries: what the narrow phase sees.
//
// A collider's frame S is the shape's own. Rounded shapes are a core and a radius: a sphere is a
// point, a capsule a segment, both swept by a ball. Queries run on cores, so rounding costs
// nothing. A mesh is a surface of triangles; each of them is a collider too, a flat convex core.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

class MeshSurface;

struct Collider {
  Collider(Eigen::Index body, const Shape& shape, const Pose& in_body);
  // One triangle of a mesh; its shape is an empty mesh. Does not allocate.
  Collider(const Collider& mesh, int triangle);

  Eigen::Index body;  // column
  Shape shape;
  Pose in_body;            // of S in the frame of the centre of mass
  double core_radius;      // [m] swept about the core; 0 for shapes with edges
  double bounding_radius;  // [m] about S's origin; infinite for a half-space
  bool is_curved;          // the core is: it has a cylinder's, cone's or ellipsoid's surface
  double size;             // [m] length that tolerances are relative to: the smallest extent, of a
                           // mesh and its triangles its largest
  std::shared_ptr<const MeshSurface> surface;  // of a mesh and its triangles
  int triangle = -1;                           // of a mesh: which; −1: not one of them
};

// Whether the points of a shape's contacts stay where they are on it; those of round ones roll.
bool has_corners(const Collider& collider);

// The point of the core farthest along d (any length), in S [m]. Not for half-spaces.
Vec3 support(const Collider& collider, const Vec3& d);

// Axis-aligned box of the shape (core and radius) at a pose of S in W [m].
struct Aabb {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool overlaps(const Aabb& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  bool contains(const Aabb& other) const {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
  Aabb grown(double by) const { return {low.array() - by, high.array() + by}; }

  template <class Archive>
  void archive(Archive& with) {
    with(low, high);
  }
};
Aabb bounds(const Collider& collider, const Pose& pose);

// A flat feature of the surface: a face (3 … kMaxCorners corners, counter-clockwise seen from
// outside), an edge (2) or a point (1), of the core.
struct Feature {
  static constexpr int kMaxCorners = 16;
  std::array<Vec3, kMaxCorners> corners;  // [m]
  int count = 0;
  std::array<std::uint16_t, kMaxCorners> id{};  // which corner of the shape, as long as it exists
  std::array<double, 2> round = {0, 0};  // [m] radius of the surface about an edge, at its ends

  void add(const Vec3& corner, std::size_t corner_id) {
    if (count == kMaxCorners) return;
    id[static_cast<std::size_t>(count)] = static_cast<std::uint16_t>(corner_id);
    corners[static_cast<std::size_t>(count++)] = corner;
  }
  const Vec3& operator[](int i) const { return corners[static_cast<std::size_t>(i)]; }
  double round_at(double t) const { return (1 - t) * round[0] + t * round[1]; }
};

// The face, edge or point of the core that looks most along the unit vector d, in S. Round caps are
// octagons in the circle, fixed to the body, so that their corners last from step to step; the
// deepest point of a tilted rim may lie between two of them.
Feature support_feature(const Collider& collider, const Vec3& d);

}  // namespace poinsot
