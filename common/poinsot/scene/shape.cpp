#include "poinsot/scene/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

double farthest(const std::vector<Vec3>& points) {
  double radius = 0;
  for (const Vec3& point : points) radius = std::max(radius, point.norm());
  return radius;
}

struct BoundingRadius {
  double operator()(const Sphere& s) const { return s.radius; }
  double operator()(const Box& s) const { return 0.5 * s.size.norm(); }
  double operator()(const Capsule& s) const { return s.radius + 0.5 * s.length; }
  double operator()(const Cylinder& s) const { return std::hypot(s.radius, 0.5 * s.length); }
  double operator()(const Cone& s) const { return std::hypot(s.radius, 0.5 * s.length); }
  double operator()(const Ellipsoid& s) const { return s.semi_axes.maxCoeff(); }
  double operator()(const Convex& s) const { return farthest(s.vertices); }
  double operator()(const HalfSpace&) const { return std::numeric_limits<double>::infinity(); }
  double operator()(const Mesh& s) const { return farthest(s.vertices); }
};

}  // namespace

double bounding_radius(const Shape& shape) {
  return std::visit(BoundingRadius(), shape);
}

}  // namespace poinsot
