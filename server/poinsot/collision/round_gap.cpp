#include "poinsot/collision/round_gap.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// Where a point is nearest to a core, in the core's frame: signed, negative inside.
struct Foot {
  Vec3 on;      // [m] of the core's surface
  Vec3 normal;  // unit, outward: from there to the point, or the shortest way out
  double distance;
};

// `otherwise`: a normal as good as any, where the point lies on the core.
Foot foot_on(const Vec3& on, const Vec3& p, const Vec3& otherwise) {
  const Vec3 v = p - on;
  const double distance = v.norm();
  return {on, distance > 0 ? Vec3(v / distance) : otherwise, distance};
}

Foot foot_on_segment(double half, const Vec3& p) {
  return foot_on({0, 0, std::clamp(p.z(), -half, half)}, p, Vec3::UnitX());
}

Foot foot_on_box(const Vec3& half, const Vec3& p) {
  const Vec3 on = p.cwiseMin(half).cwiseMax(-half);
  if (on != p) return foot_on(on, p, Vec3::UnitX());
  Eigen::Index axis = 0;
  const double inside = (half - p.cwiseAbs()).minCoeff(&axis);
  Foot foot{p, Vec3::Zero(), -inside};
  foot.normal[axis] = p[axis] < 0 ? -1 : 1;
  foot.on[axis] = foot.normal[axis] * half[axis];
  return foot;
}

Foot foot_on_cylinder(double radius, double half, const Vec3& p) {
  const double r = std::sqrt(p.x() * p.x() + p.y() * p.y());
  const Vec3 out = r > 0 ? Vec3(p.x() / r, p.y() / r, 0) : Vec3(Vec3::UnitX());
  const double z = std::clamp(p.z(), -half, half);
  if (r > radius) return foot_on(radius * out + Vec3(0, 0, z), p, out);
  if (z != p.z()) return foot_on({p.x(), p.y(), z}, p, Vec3::UnitZ());
  if (radius - r < half - std::abs(z)) return {radius * out + Vec3(0, 0, z), out, r - radius};
  const double side = z < 0 ? -1 : 1;
  return {{p.x(), p.y(), side * half}, {0, 0, side}, std::abs(z) - half};
}

bool sphere_foot(const Shape& other, const Vec3& p, Foot& foot) {
  if (std::holds_alternative<Sphere>(other))
    foot = foot_on(Vec3::Zero(), p, Vec3::UnitX());
  else if (const auto* box = std::get_if<Box>(&other))
    foot = foot_on_box(0.5 * box->size, p);
  else if (const auto* capsule = std::get_if<Capsule>(&other))
    foot = foot_on_segment(0.5 * capsule->length, p);
  else if (const auto* cylinder = std::get_if<Cylinder>(&other))
    foot = foot_on_cylinder(cylinder->radius, 0.5 * cylinder->length, p);
  else
    return false;
  return true;
}

// Nearest points of the segments c ± half u and ± other z, as distances along both from their
// middles. Ericson, Real-Time Collision Detection, 5.1.9.
void nearest_on_axes(const Vec3& c, const Vec3& u, double half, double other, double& s,
                     double& t) {
  const double uz = u.z(), cu = c.dot(u), det = 1 - uz * uz;
  s = det > 0 ? std::clamp((uz * c.z() - cu) / det, -half, half) : 0;
  t = std::clamp(c.z() + s * uz, -other, other);
  s = std::clamp(t * uz - cu, -half, half);
  t = std::clamp(c.z() + s * uz, -other, other);
}

}  // namespace

bool round_gap(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
               Gap& gap) {
  const Vec3 c = pose_b.q.conjugate() * (pose_a.c - pose_b.c);  // a's centre in b
  Foot foot;
  if (std::holds_alternative<Sphere>(a.shape)) {
    if (!sphere_foot(b.shape, c, foot)) return false;
  } else if (const auto* ca = std::get_if<Capsule>(&a.shape), *cb = std::get_if<Capsule>(&b.shape);
             ca && cb) {
    const Vec3 u = pose_b.q.conjugate() * (pose_a.q * Vec3(Vec3::UnitZ()));
    double s = 0, t = 0;
    nearest_on_axes(c, u, 0.5 * ca->length, 0.5 * cb->length, s, t);
    foot = foot_on({0, 0, t}, c + s * u, Vec3::Zero());
    if (foot.distance < 1e-9 * std::min(ca->radius, cb->radius)) return false;
  } else {
    return false;
  }
  const double value = foot.distance - a.core_radius - b.core_radius;
  const Vec3 on_b = foot.on + b.core_radius * foot.normal;
  gap = {value, value, pose_b.q * foot.normal, pose_b * Vec3(on_b + value * foot.normal),
         pose_b * on_b};
  return true;
}

}  // namespace poinsot
