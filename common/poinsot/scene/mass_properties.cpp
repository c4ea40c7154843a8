#include "poinsot/scene/mass_properties.h"

#include <numbers>

#include "poinsot/base/check.h"
#include "poinsot/math/inertia.h"

namespace poinsot {
namespace {

constexpr double kPi = std::numbers::pi;

Mat3 diagonal(double x, double y, double z) {
  return Vec3(x, y, z).asDiagonal();
}

// Volume, first and second moment of a polyhedron about a point: ∫ 1, ∫ r, ∫ r rᵀ dV.
struct Moments {
  double volume = 0;           // [m³]
  Vec3 first = Vec3::Zero();   // [m⁴]
  Mat3 second = Mat3::Zero();  // [m⁵]
};

// The tetrahedron (0, a, b, c): V = a·(b×c)/6, ∫ r = V s/4, ∫ r rᵀ = V (a aᵀ + b bᵀ + c cᵀ + s
// sᵀ)/20 with s = a + b + c; signed, so that a closed surface sums up to its inside.
void add_tetrahedron(Moments& sum, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double volume = a.dot(b.cross(c)) / 6;
  const Vec3 s = a + b + c;
  sum.volume += volume;
  sum.first += volume / 4 * s;
  sum.second +=
      volume / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
}

// A point inside, about which nothing cancels: a hull far from its origin loses no digits.
Vec3 vertex_mean(const Convex& convex) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& vertex : convex.vertices) sum += vertex;
  return sum / static_cast<double>(convex.vertices.size());
}

Moments moments_about(const Convex& convex, const Vec3& point) {
  Moments sum;
  for (const Convex::Face& face : convex.faces) {
    auto corner = [&](std::size_t k) -> Vec3 {
      return convex.vertices[static_cast<std::size_t>(face.loop[k])] - point;
    };
    for (std::size_t k = 2; k < face.loop.size(); ++k)
      add_tetrahedron(sum, corner(0), corner(k - 1), corner(k));
  }
  return sum;
}

struct Volume {
  double operator()(const Sphere& s) const { return 4 * kPi / 3 * s.radius * s.radius * s.radius; }
  double operator()(const Box& s) const { return s.size.prod(); }
  double operator()(const Capsule& s) const {
    return kPi * s.radius * s.radius * (s.length + 4 * s.radius / 3);
  }
  double operator()(const Cylinder& s) const { return kPi * s.radius * s.radius * s.length; }
  double operator()(const Cone& s) const { return kPi * s.radius * s.radius * s.length / 3; }
  double operator()(const Ellipsoid& s) const { return 4 * kPi / 3 * s.semi_axes.prod(); }
  double operator()(const Convex& s) const { return moments_about(s, vertex_mean(s)).volume; }
  double operator()(const HalfSpace&) const {
    POINSOT_CHECK(!"a half-space has no volume");
    return 0;
  }
  double operator()(const Mesh&) const {
    POINSOT_CHECK(!"a mesh has no volume: it is a surface");
    return 0;
  }
};

// Mass properties for a given mass: the closed forms listed in README.md.
struct Solid {
  double m = 0;  // [kg]

  MassProperties operator()(const Sphere& s) const {
    return {m, Vec3::Zero(), 0.4 * m * s.radius * s.radius * Mat3::Identity()};
  }
  MassProperties operator()(const Box& s) const {
    const Vec3 q = s.size.cwiseAbs2();
    return {m, Vec3::Zero(), m / 12 * diagonal(q.y() + q.z(), q.z() + q.x(), q.x() + q.y())};
  }
  MassProperties operator()(const Cylinder& s) const {
    const double r2 = s.radius * s.radius;
    const double across = m * (3 * r2 + s.length * s.length) / 12;
    return {m, Vec3::Zero(), diagonal(across, across, m * r2 / 2)};
  }
  // A cylinder and two half-balls, whose centres of mass lie 3r/8 outside its ends.
  MassProperties operator()(const Capsule& s) const {
    const double r = s.radius, l = s.length;
    const double middle = m * l / (l + 4 * r / 3), caps = m - middle;
    const double across =
        middle * (3 * r * r + l * l) / 12 + caps * (0.4 * r * r + l * l / 4 + 3 * l * r / 8);
    const double along = middle * r * r / 2 + caps * 0.4 * r * r;
    return {m, Vec3::Zero(), diagonal(across, across, along)};
  }
  // The centre of mass lies a quarter of the length above the base.
  MassProperties operator()(const Cone& s) const {
    const double r2 = s.radius * s.radius;
    const double across = 3 * m * (4 * r2 + s.length * s.length) / 80;
    return {m, Vec3(0, 0, -s.length / 4), diagonal(across, across, 0.3 * m * r2)};
  }
  MassProperties operator()(const Ellipsoid& s) const {
    const Vec3 q = s.semi_axes.cwiseAbs2();
    return {m, Vec3::Zero(), m / 5 * diagonal(q.y() + q.z(), q.z() + q.x(), q.x() + q.y())};
  }
  MassProperties operator()(const Convex& s) const {
    const Vec3 inside = vertex_mean(s);
    const Moments sum = moments_about(s, inside);
    const Vec3 offset = sum.first / sum.volume;  // of the centre of mass from `inside`
    const Mat3 spread = sum.second / sum.volume - offset * offset.transpose();
    return {m, inside + offset, m * (spread.trace() * Mat3::Identity() - spread)};
  }
  MassProperties operator()(const HalfSpace&) const {
    POINSOT_CHECK(!"a half-space has no mass");
    return {};
  }
  MassProperties operator()(const Mesh&) const {
    POINSOT_CHECK(!"a mesh has no mass");
    return {};
  }
};

}  // namespace

double volume(const Shape& shape) {
  return std::visit(Volume(), shape);
}

MassProperties mass_properties(const Shape& shape, double density) {
  return std::visit(Solid{density * volume(shape)}, shape);
}

MassProperties mass_properties(std::span<const Particle> particles) {
  MassProperties sum;
  for (const Particle& p : particles) {
    sum.mass += p.mass;
    sum.center_of_mass += p.mass * p.point;
  }
  if (sum.mass > 0) sum.center_of_mass /= sum.mass;
  for (const Particle& p : particles) sum.J += parallel_axis(p.mass, p.point - sum.center_of_mass);
  return sum;
}

MassProperties transformed(const MassProperties& child, const Pose& pose) {
  return {child.mass, pose * child.center_of_mass,
          rotate_inertia(pose.q.toRotationMatrix(), child.J)};
}

MassProperties combined(std::span<const MassProperties> parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass += part.mass;
    sum.center_of_mass += part.mass * part.center_of_mass;
  }
  if (sum.mass > 0) sum.center_of_mass /= sum.mass;
  for (const MassProperties& part : parts)
    sum.J += part.J + parallel_axis(part.mass, part.center_of_mass - sum.center_of_mass);
  return sum;
}

}  // namespace poinsot
