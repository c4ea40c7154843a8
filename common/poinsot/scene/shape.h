// Shapes: a closed set, as plain data. All lengths in metres, axes along z, centred at the origin
// of the shape's frame (a cone's centre is half-way up: apex at +length/2, base at −length/2).

#pragma once

#include <array>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "poinsot/math/types.h"

namespace poinsot {

struct Sphere {
  double radius = 0;  // [m]
};
struct Box {
  Vec3 size = Vec3::Zero();  // [m] full lengths
};
struct Capsule {
  double radius = 0;  // [m]
  double length = 0;  // [m] without the caps
};
struct Cylinder {
  double radius = 0;  // [m]
  double length = 0;  // [m]
};
struct Cone {
  double radius = 0;  // [m] of the base
  double length = 0;  // [m] from base to apex
};
struct Ellipsoid {
  Vec3 semi_axes = Vec3::Zero();  // [m]
};
// A convex polyhedron: the hull of some points, made by convex_hull() and by nothing else.
struct Convex {
  struct Face {
    Vec3 normal = Vec3::Zero();  // unit, outward
    double offset = 0;           // [m] normal·x = offset on the face
    std::vector<int> loop;       // indices into vertices, counter-clockwise seen from outside
  };
  std::vector<Vec3> vertices;  // [m]
  std::vector<Face> faces;     // coplanar triangles merged
};
// All points with normal·x ≤ offset. Static bodies only; has no mass.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  // unit, pointing out of the material
  double offset = 0;            // [m]
};
// A surface of triangles, made by make_mesh() and by nothing else. Their corners are
// counter-clockwise seen from outside. Static and kinematic bodies only; has no mass.
struct Mesh {
  std::vector<Vec3> vertices;  // [m] no two at one place
  std::vector<std::array<int, 3>> triangles;
  int left_out = 0;  // triangles that had no area
};

using Shape =
    std::variant<Sphere, Box, Capsule, Cylinder, Cone, Ellipsoid, Convex, HalfSpace, Mesh>;

// Names in the order of the variant: scene files, messages, the pair table and tests read them.
inline constexpr std::array<std::string_view, std::variant_size_v<Shape>> kShapeNames = {
    "sphere", "box", "capsule", "cylinder", "cone", "ellipsoid", "convex", "half_space", "mesh"};

inline std::string_view shape_name(const Shape& shape) {
  return kShapeNames[shape.index()];
}

// Radius about the shape's origin that holds every point of it [m]; infinite for a half-space.
double bounding_radius(const Shape& shape);

// The hull of at least four points that do not lie in a plane; throws Error otherwise. Vertices
// keep the order of the points, so the result does not depend on the hull code's own order.
Convex convex_hull(std::span<const Vec3> points);

}  // namespace poinsot
