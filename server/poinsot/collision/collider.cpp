#include "poinsot/collision/collider.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "poinsot/base/check.h"
#include "poinsot/collision/mesh_surface.h"

namespace poinsot {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};

Vec3 radial(const Vec3& d) {  // unit vector of d's part across z; x where there is none
  const double r = std::sqrt(d.x() * d.x() + d.y() * d.y());
  return r > 0 ? Vec3(d.x() / r, d.y() / r, 0) : Vec3(Vec3::UnitX());
}

double signed_half(double half, double component) {
  return component < 0 ? -half : half;
}

Vec3 farthest(std::span<const Vec3> points, const Vec3& d) {
  std::size_t best = 0;
  double most = points[0].dot(d);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double along = points[i].dot(d);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return points[best];
}

double smallest_extent(const Shape& shape) {
  return std::visit(
      Overloaded{[](const Sphere& s) { return 2 * s.radius; },
                 [](const Box& s) { return s.size.minCoeff(); },
                 [](const Capsule& s) { return 2 * s.radius; },
                 [](const Cylinder& s) { return std::min(2 * s.radius, s.length); },
                 [](const Cone& s) { return std::min(2 * s.radius, s.length); },
                 [](const Ellipsoid& s) { return 2 * s.semi_axes.minCoeff(); },
                 [](const Convex& s) {
                   double width = std::numeric_limits<double>::infinity();
                   for (const Convex::Face& face : s.faces)
                     width = std::min(
                         width, face.offset - farthest(s.vertices, -face.normal).dot(face.normal));
                   return width;
                 },
                 [](const HalfSpace&) { return std::numeric_limits<double>::infinity(); },
                 [](const Mesh& s) {
                   Aabb box;
                   for (const Vec3& v : s.vertices)
                     box = {box.low.cwiseMin(v), box.high.cwiseMax(v)};
                   return (box.high - box.low).maxCoeff();
                 }},
      shape);
}

double radius_of_core(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  return 0;
}

// Octagon in the circle of radius r at height z, counter-clockwise seen from outside (`up`: +z).
Feature cap(double r, double z, bool up) {
  constexpr double kHalfRoot = 0.70710678118654752440;
  const double side = up ? r : -r;
  const Vec3 x(r, 0, 0), y(0, side, 0), middle(0, 0, z);
  Feature f;
  std::size_t id = up ? 0 : 8;
  for (const Vec3& p : {x, Vec3(kHalfRoot * (x + y)), y, Vec3(kHalfRoot * (y - x)), Vec3(-x),
                        Vec3(kHalfRoot * (-x - y)), Vec3(-y), Vec3(kHalfRoot * (x - y))})
    f.add(p + middle, id++);
  return f;
}

Feature segment(const Vec3& a, const Vec3& b, double round_a, double round_b) {
  Feature f;
  f.add(a, 16);
  f.add(b, 17);
  f.round = {round_a, round_b};
  return f;
}

Feature point(const Vec3& p) {
  Feature f;
  f.add(p, 18);
  return f;
}

Feature box_face(const Vec3& half, const Vec3& d) {
  Eigen::Index axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double side = d[axis] < 0 ? -1 : 1;
  Feature f;
  for (const auto& [s, t] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    Vec3 p;
    p[axis] = side * half[axis];
    p[u] = s * half[u];
    p[v] = side * t * half[v];  // mirrored on the negative side: counter-clockwise from outside
    f.add(p, (p.x() > 0 ? 1u : 0u) + (p.y() > 0 ? 2u : 0u) + (p.z() > 0 ? 4u : 0u));
  }
  return f;
}

Feature convex_face(const Convex& convex, const Vec3& d) {
  const Convex::Face* best = &convex.faces[0];
  double most = best->normal.dot(d);
  for (const Convex::Face& face : convex.faces) {
    const double along = face.normal.dot(d);
    if (along <= most) continue;
    most = along;
    best = &face;
  }
  Feature f;  // a face of more corners is thinned evenly
  const std::size_t n = best->loop.size();
  const std::size_t kept = std::min<std::size_t>(n, Feature::kMaxCorners);
  for (std::size_t i = 0; i < kept; ++i) {
    const auto vertex = static_cast<std::size_t>(best->loop[i * n / kept]);
    f.add(convex.vertices[vertex], vertex);
  }
  return f;
}

// The face, turned over if it is looked at from behind; from the side an edge.
Feature triangle_feature(const Collider& collider, const Vec3& d) {
  constexpr double kFromAside = 0.94;  // cos(20°)
  POINSOT_ASSERT(collider.triangle >= 0);
  const auto& c = collider.surface->corners(collider.triangle);
  const double along = d.dot(collider.surface->normal(collider.triangle));
  if (std::abs(along) > kFromAside) {
    Feature f;
    for (const std::size_t k : {0, 1, 2}) f.add(c[along > 0 ? k : 2 - k], along > 0 ? k : 2 - k);
    return f;
  }
  std::size_t lowest = 0;  // the edge is across from it
  for (const std::size_t k : {1, 2})
    if (c[k].dot(d) < c[lowest].dot(d)) lowest = k;
  return segment(c[(lowest + 1) % 3], c[(lowest + 2) % 3], 0, 0);
}

}  // namespace

Collider::Collider(Eigen::Index body_, const Shape& shape_, const Pose& in_body_)
    : body(body_),
      shape(shape_),
      in_body(in_body_),
      core_radius(radius_of_core(shape)),
      bounding_radius(poinsot::bounding_radius(shape)),
      is_curved(std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape) ||
                std::holds_alternative<Ellipsoid>(shape)),
      size(smallest_extent(shape)) {
  if (const auto* mesh = std::get_if<Mesh>(&shape)) surface = std::make_shared<MeshSurface>(*mesh);
}

Collider::Collider(const Collider& mesh, int triangle_)
    : body(mesh.body),
      shape(Mesh{}),
      in_body(mesh.in_body),
      core_radius(0),
      bounding_radius(mesh.bounding_radius),
      is_curved(false),
      size(mesh.size),
      surface(mesh.surface),
      triangle(triangle_) {}

bool has_corners(const Collider& collider) {
  return std::holds_alternative<Box>(collider.shape) ||
         std::holds_alternative<Convex>(collider.shape) ||
         std::holds_alternative<HalfSpace>(collider.shape) ||
         std::holds_alternative<Mesh>(collider.shape);
}

Vec3 support(const Collider& collider, const Vec3& d) {
  return std::visit(
      Overloaded{[](const Sphere&) -> Vec3 { return Vec3::Zero(); },
                 [&](const Box& s) -> Vec3 {
                   return {signed_half(0.5 * s.size.x(), d.x()),
                           signed_half(0.5 * s.size.y(), d.y()),
                           signed_half(0.5 * s.size.z(), d.z())};
                 },
                 [&](const Capsule& s) -> Vec3 {
                   return {0, 0, signed_half(0.5 * s.length, d.z())};
                 },
                 [&](const Cylinder& s) -> Vec3 {
                   return s.radius * radial(d) + Vec3(0, 0, signed_half(0.5 * s.length, d.z()));
                 },
                 [&](const Cone& s) -> Vec3 {
                   const Vec3 apex(0, 0, 0.5 * s.length);
                   const Vec3 rim = s.radius * radial(d) - apex;
                   return apex.dot(d) > rim.dot(d) ? apex : rim;
                 },
                 [&](const Ellipsoid& s) -> Vec3 {
                   const Vec3 scaled = s.semi_axes.cwiseProduct(d);
                   const double length = scaled.norm();
                   return length > 0 ? Vec3(s.semi_axes.cwiseProduct(scaled) / length)
                                     : Vec3(s.semi_axes.x(), 0, 0);
                 },
                 [&](const Convex& s) -> Vec3 { return farthest(s.vertices, d); },
                 [](const HalfSpace&) -> Vec3 {
                   POINSOT_CHECK(!"a half-space has no support");
                   return Vec3::Zero();
                 },
                 [&](const Mesh& s) -> Vec3 {
                   return collider.triangle < 0
                              ? farthest(s.vertices, d)
                              : farthest(collider.surface->corners(collider.triangle), d);
                 }},
      collider.shape);
}

Aabb bounds(const Collider& collider, const Pose& pose) {
  const Mat3 R = pose.q.toRotationMatrix();
  if (const auto* box = std::get_if<Box>(&collider.shape)) {
    const Vec3 reach = R.cwiseAbs() * (0.5 * box->size);
    return {pose.c - reach, pose.c + reach};
  }
  if (collider.surface && collider.triangle < 0) {  // too many vertices to look at each
    const auto& root = collider.surface->bvh().root();
    const Vec3 middle = pose.c + R * (0.5 * (root.low + root.high));
    const Vec3 reach = R.cwiseAbs() * (0.5 * (root.high - root.low));
    return {middle - reach, middle + reach};
  }
  Aabb aabb;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 d = R.row(axis);
    aabb.low[axis] = pose.c[axis] + support(collider, -d).dot(d) - collider.core_radius;
    aabb.high[axis] = pose.c[axis] + support(collider, d).dot(d) + collider.core_radius;
  }
  return aabb;
}

Feature support_feature(const Collider& collider, const Vec3& d) {
  constexpr double kCap = 0.70710678118654752440;  // nearer the axis than 45°: a cap, else a side
  return std::visit(
      Overloaded{[](const Sphere&) { return point(Vec3::Zero()); },
                 [&](const Box& s) { return box_face(0.5 * s.size, d); },
                 [](const Capsule& s) {
                   return segment({0, 0, -0.5 * s.length}, {0, 0, 0.5 * s.length}, 0, 0);
                 },
                 [&](const Cylinder& s) {
                   const double z = 0.5 * s.length;
                   if (std::abs(d.z()) > kCap)
                     return cap(s.radius, signed_half(z, d.z()), d.z() > 0);
                   const Vec3 side = s.radius * radial(d);
                   return segment(side - Vec3(0, 0, z), side + Vec3(0, 0, z), s.radius, s.radius);
                 },
                 [&](const Cone& s) {
                   const Vec3 apex(0, 0, 0.5 * s.length);
                   if (d.z() < -kCap) return cap(s.radius, -apex.z(), false);
                   const double slope = s.radius / s.length;
                   return segment(s.radius * radial(d) - apex, apex,
                                  s.radius * std::sqrt(1 + slope * slope), 0);
                 },
                 [&](const Ellipsoid&) { return point(support(collider, d)); },
                 [&](const Convex& s) { return convex_face(s, d); },
                 [](const HalfSpace&) { return Feature{}; },
                 [&](const Mesh&) { return triangle_feature(collider, d); }},
      collider.shape);
}

}  // namespace poinsot
