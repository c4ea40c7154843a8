#include "support/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace poinsot::test {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};

double planar(const Vec3& v) {
  return std::hypot(v.x(), v.y());
}

Vec3 across(const Vec3& n) {
  return n.cross(std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
}

// Compass search on the sphere, from n.
double improved(const auto& value, Vec3 n, double step) {
  double best = value(n);
  for (int turns = 0; step > 1e-10 && turns < 300; ++turns) {
    const Vec3 u = across(n), v = n.cross(u);
    bool better = false;
    for (int k = 0; k < 12 && !better; ++k) {
      const double angle = k * std::numbers::pi / 6 + step;
      const Vec3 next = (n + step * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
      if (const double s = value(next); s > best + 1e-15) {
        best = s;
        n = next;
        better = true;
      }
    }
    step *= better ? 1.5 : 0.5;
  }
  return best;
}

std::vector<Vec3> edges(const Convex& c) {
  std::vector<Vec3> result;
  for (const Convex::Face& face : c.faces)
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      const int from = face.loop[i], to = face.loop[(i + 1) % face.loop.size()];
      if (from < to)
        result.push_back(
            (c.vertices[static_cast<std::size_t>(to)] - c.vertices[static_cast<std::size_t>(from)])
                .normalized());
    }
  return result;
}

}  // namespace

std::uint64_t Random::next() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
}

double Random::log_uniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

int Random::below(int n) {
  return static_cast<int>(next() % static_cast<std::uint64_t>(n));
}

Vec3 Random::in_box(double half) {
  const double x = uniform(-half, half), y = uniform(-half, half);
  return {x, y, uniform(-half, half)};
}

Vec3 Random::direction() {
  for (;;) {
    const Vec3 v = in_box(1);
    if (const double n = v.norm(); n > 0.1 && n < 1) return v / n;
  }
}

Quat Random::rotation() {
  const double angle = uniform(0, std::numbers::pi);
  return Quat(Eigen::AngleAxisd(angle, direction()));
}

std::string name_of(int kind) {
  return std::string(kShapeNames[static_cast<std::size_t>(kind)]);
}

Shape random_shape(int kind, Random& random, double scale) {
  const auto half = [&] { return scale * random.uniform(0.2, 1); };
  switch (kind) {
    case kSphere:
      return Sphere{half()};
    case kBox: {
      const double x = half(), y = half();
      return Box{2 * Vec3(x, y, half())};
    }
    case kCapsule: {
      const double r = half();
      return Capsule{r, 2 * half()};
    }
    case kCylinder: {
      const double r = half();
      return Cylinder{r, 2 * half()};
    }
    case kCone: {
      const double r = half();
      return Cone{r, 2 * half()};
    }
    case kEllipsoid: {
      const double x = half(), y = half();
      return Ellipsoid{Vec3(x, y, half())};
    }
    case kConvex: {
      std::vector<Vec3> points;
      const double x = half(), y = half();
      const Vec3 axes(x, y, half());
      for (int i = 0; i < 20; ++i) points.push_back(axes.cwiseProduct(random.direction()));
      return convex_hull(points);
    }
    default:
      return HalfSpace{random.direction(), scale * random.uniform(-1, 1)};
  }
}

Shape scaled(const Shape& shape, double k) {
  return std::visit(
      Overloaded{[&](const Sphere& s) -> Shape { return Sphere{k * s.radius}; },
                 [&](const Box& s) -> Shape { return Box{k * s.size}; },
                 [&](const Capsule& s) -> Shape {
                   return Capsule{k * s.radius, k * s.length};
                 },
                 [&](const Cylinder& s) -> Shape {
                   return Cylinder{k * s.radius, k * s.length};
                 },
                 [&](const Cone& s) -> Shape {
                   return Cone{k * s.radius, k * s.length};
                 },
                 [&](const Ellipsoid& s) -> Shape { return Ellipsoid{k * s.semi_axes}; },
                 [&](const Convex& s) -> Shape {
                   Convex result = s;
                   for (Vec3& v : result.vertices) v *= k;
                   for (Convex::Face& f : result.faces) f.offset *= k;
                   return result;
                 },
                 [&](const HalfSpace& s) -> Shape {
                   return HalfSpace{s.normal, k * s.offset};
                 },
                 [&](const Mesh& s) -> Shape {
                   Mesh result = s;
                   for (Vec3& v : result.vertices) v *= k;
                   return result;
                 }},
      shape);
}

Convex prism(int sides, double radius, double length) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {-0.5 * length, 0.5 * length})
      points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return convex_hull(points);
}

Convex box_as_convex(const Vec3& size) {
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner)
    points.push_back(0.5 * size.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                                  corner & 4 ? 1 : -1)));
  return convex_hull(points);
}

Collider collider(const Shape& shape, int body) {
  return Collider(body, shape, Pose{});
}

double support_width(const Shape& shape, const Vec3& d) {
  return std::visit(
      Overloaded{
          [&](const Sphere& s) { return s.radius * d.norm(); },
          [&](const Box& s) { return 0.5 * s.size.dot(d.cwiseAbs()); },
          [&](const Capsule& s) { return 0.5 * s.length * std::abs(d.z()) + s.radius * d.norm(); },
          [&](const Cylinder& s) {
            return 0.5 * s.length * std::abs(d.z()) + s.radius * planar(d);
          },
          [&](const Cone& s) {
            return std::max(0.5 * s.length * d.z(), s.radius * planar(d) - 0.5 * s.length * d.z());
          },
          [&](const Ellipsoid& s) { return s.semi_axes.cwiseProduct(d).norm(); },
          [&](const Convex& s) {
            double most = s.vertices[0].dot(d);
            for (const Vec3& v : s.vertices) most = std::max(most, v.dot(d));
            return most;
          },
          [&](const HalfSpace& s) {
            return d.dot(s.normal) > (1 - 1e-15) * d.norm()
                       ? s.offset * d.norm()
                       : std::numeric_limits<double>::infinity();
          },
          [&](const Mesh& s) {
            double most = s.vertices[0].dot(d);
            for (const Vec3& v : s.vertices) most = std::max(most, v.dot(d));
            return most;
          }},
      shape);
}

double outside_by(const Shape& shape, const Vec3& p) {
  return std::visit(
      Overloaded{[&](const Sphere& s) { return p.norm() - s.radius; },
                 [&](const Box& s) { return (p.cwiseAbs() - 0.5 * s.size).maxCoeff(); },
                 [&](const Capsule& s) {
                   const double z = std::clamp(p.z(), -0.5 * s.length, 0.5 * s.length);
                   return (p - Vec3(0, 0, z)).norm() - s.radius;
                 },
                 [&](const Cylinder& s) {
                   return std::max(planar(p) - s.radius, std::abs(p.z()) - 0.5 * s.length);
                 },
                 [&](const Cone& s) {
                   const double slope = s.radius / s.length;
                   return std::max(
                       (planar(p) - slope * (0.5 * s.length - p.z())) / std::hypot(1.0, slope),
                       -p.z() - 0.5 * s.length);
                 },
                 [&](const Ellipsoid& s) {
                   return (p.cwiseQuotient(s.semi_axes).norm() - 1) * s.semi_axes.minCoeff();
                 },
                 [&](const Convex& s) {
                   double most = -std::numeric_limits<double>::infinity();
                   for (const Convex::Face& face : s.faces)
                     most = std::max(most, face.normal.dot(p) - face.offset);
                   return most;
                 },
                 [&](const HalfSpace& s) { return s.normal.dot(p) - s.offset; },
                 [](const Mesh&) { return std::numeric_limits<double>::infinity(); }},
      shape);
}

double separation(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                  const Vec3& n) {
  return n.dot(pose_a.c - pose_b.c) - support_width(a, pose_a.q.conjugate() * -n) -
         support_width(b, pose_b.q.conjugate() * n);
}

double sampled_gap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  static const std::vector<Vec3> sphere = directions(1500);
  const auto value = [&](const Vec3& n) { return separation(a, pose_a, b, pose_b, n); };
  std::vector<std::pair<double, Vec3>> ranked;
  for (const Vec3& n : sphere) ranked.emplace_back(value(n), n);
  constexpr std::size_t kStarts = 6;
  std::partial_sort(ranked.begin(), ranked.begin() + kStarts, ranked.end(),
                    [](const auto& x, const auto& y) { return x.first > y.first; });
  double best = ranked[0].first;
  for (std::size_t k = 0; k < kStarts; ++k)
    best = std::max(best, improved(value, ranked[k].second, 0.05));
  return best;
}

double separating_axes(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b) {
  double best = -std::numeric_limits<double>::infinity();
  const auto test = [&](const Vec3& n) {
    best = std::max(best, separation(a, pose_a, b, pose_b, n));
  };
  for (const Convex::Face& face : a.faces) test(pose_a.q * -face.normal);
  for (const Convex::Face& face : b.faces) test(pose_b.q * face.normal);
  const std::vector<Vec3> edges_b = edges(b);
  for (const Vec3& e : edges(a)) {
    for (const Vec3& f : edges_b) {
      const Vec3 n = (pose_a.q * e).cross(pose_b.q * f);
      if (n.norm() < 1e-9) continue;
      test(n.normalized());
      test(-n.normalized());
    }
  }
  return best;
}

std::vector<Vec3> directions(int n) {
  std::vector<Vec3> result;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z);
    result.push_back({r * std::cos(turn * i), r * std::sin(turn * i), z});
  }
  return result;
}

Pose pose_at_gap(const Shape& a, const Pose& pose_a, const Shape& b, double gap, Random& random) {
  Pose pose_b{Vec3::Zero(), random.rotation()};
  const Vec3 n = random.direction();
  const double reach = bounding_radius(a) + bounding_radius(b);
  // Slide along n until the best separation is the gap; the separation grows with the distance.
  double near = 0, far = 2 * reach + std::abs(gap);
  const auto gap_at = [&](double t) {
    pose_b.c = pose_a.c - t * n + 0.1 * reach * Vec3(n.y(), n.z(), n.x());
    double best = -std::numeric_limits<double>::infinity();
    static const std::vector<Vec3> sphere = directions(600);
    for (const Vec3& d : sphere) best = std::max(best, separation(a, pose_a, b, pose_b, d));
    return best;
  };
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (near + far);
    (gap_at(middle) < gap ? near : far) = middle;
  }
  gap_at(far);
  return pose_b;
}

}  // namespace poinsot::test
