#include "poinsot/scene/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

struct BoundingRadius {
  double operator()(const Sphere& s) const { return s.radius; }
  double operator()(const Box& s) const { return 0.5 * s.size.norm(); }
  double operator()(const Capsule& s) const { return s.radius + 0.5 * s.length; }
  double operator()(const Cylinder& s) const { return std::hypot(s.radius, 0.5 * s.length); }
  double operator()(const Cone& s) const { return std::hypot(s.radius, 0.5 * s.length); }
  double operator()(const Ellipsoid& s) const { return s.semi_axes.maxCoeff(); }
  double operator()(const Convex& s) const {
    double radius = 0;
    for (const Vec3& vertex : s.vertices) radius = std::max(radius, vertex.norm());
    return radius;
  }
  double operator()(const HalfSpace&) const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace

double bounding_radius(const Shape& shape) {
  return std::visit(BoundingRadius(), shape);
}

}  // namespace poinsot
