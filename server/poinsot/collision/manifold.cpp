#include "poinsot/collision/manifold.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// A face counts as facing the other shape up to this tilt; cos(0.01 rad).
constexpr double kFacing = 0.99995;
// Edges count as parallel below this sine of their angle.
constexpr double kParallel = 0.02;

Vec3 face_normal(const Feature& f) {  // Newell's sum: robust for any planar polygon
  Vec3 n = Vec3::Zero();
  for (int i = 0; i < f.count; ++i) n += (f[i] - f[0]).cross(f[(i + 1) % f.count] - f[0]);
  return n.normalized();
}

// Keeps the part of `f` with direction·x ≤ offset.
Feature clipped(const Feature& f, const Vec3& direction, double offset) {
  Feature result;
  const int edges = f.count > 2 ? f.count : f.count - 1;
  if (f.count == 1 && direction.dot(f[0]) <= offset) result.add(f[0]);
  for (int i = 0; i < edges; ++i) {
    const Vec3& p = f[i];
    const Vec3& q = f[(i + 1) % f.count];
    const double dp = direction.dot(p) - offset, dq = direction.dot(q) - offset;
    if (dp <= 0) result.add(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) result.add(p + dp / (dp - dq) * (q - p));
    if (f.count == 2 && dq <= 0) result.add(q);
  }
  return result;
}

// Incident feature cut to what lies above the reference face.
Feature above_face(Feature incident, const Feature& face, const Vec3& normal) {
  for (int i = 0; i < face.count && incident.count > 0; ++i) {
    const Vec3 outward = (face[(i + 1) % face.count] - face[i]).cross(normal);
    incident = clipped(incident, outward, outward.dot(face[i]));
  }
  return incident;
}

// Incident edge cut to what lies beside the reference edge; nothing unless they are parallel.
Feature beside_edge(const Feature& incident, const Feature& edge) {
  const Vec3 along = edge[1] - edge[0], other = incident[1] - incident[0];
  if (along.cross(other).norm() > kParallel * along.norm() * other.norm()) return {};
  return clipped(clipped(incident, along, along.dot(edge[1])), -along, -along.dot(edge[0]));
}

Feature in_a_frame(const ConvexPair& pair, Feature f) {
  for (int i = 0; i < f.count; ++i) f.corners[static_cast<std::size_t>(i)] = pair.c + pair.R * f[i];
  return f;
}

}  // namespace

void build_manifold(const ConvexPair& pair, const Witness& witness, double margin,
                    Manifold& manifold) {
  manifold.clear();
  if (witness.gap > margin) return;
  const Vec3& n = witness.normal;
  const double radii = pair.a.core_radius + pair.b.core_radius;
  const Feature on_a = support_feature(pair.a, -n, witness.on_a);
  const Feature on_b =
      in_a_frame(pair, support_feature(pair.b, pair.R.transpose() * n,
                                       pair.R.transpose() * (witness.on_b - pair.c)));

  // The better aligned face is the reference; A on a tie.
  const Vec3 normal_a = on_a.count > 2 ? face_normal(on_a) : Vec3(Vec3::Zero());
  const Vec3 normal_b = on_b.count > 2 ? face_normal(on_b) : Vec3(Vec3::Zero());
  const double facing_a = -normal_a.dot(n), facing_b = normal_b.dot(n);
  const bool a_refers = facing_a >= facing_b * (1 - 1e-9);
  const Feature& reference = a_refers ? on_a : on_b;
  const Feature& incident = a_refers ? on_b : on_a;

  PointSet set;
  // Midway between the surfaces: from the incident core, back to its own surface, half the gap on.
  const auto add = [&](const Vec3& on_incident, double core_gap) {
    const double gap = core_gap - radii;
    if (gap > margin) return;
    const double from_core =
        a_refers ? pair.b.core_radius + 0.5 * gap : -(pair.a.core_radius + 0.5 * gap);
    set.add(on_incident + from_core * n, gap);
  };
  if (std::max(facing_a, facing_b) >= kFacing) {
    const Vec3& face = a_refers ? normal_a : normal_b;
    const Feature kept = above_face(incident, reference, face);
    // Along n, not along the face: one normal serves all points.
    for (int i = 0; i < kept.count; ++i)
      add(kept[i], face.dot(kept[i] - reference[0]) / std::abs(face.dot(n)));
  } else if (on_a.count == 2 && on_b.count == 2) {
    const Feature kept = beside_edge(incident, reference);
    const Vec3 along = reference[1] - reference[0];
    for (int i = 0; i < kept.count; ++i) {
      const double t = along.dot(kept[i] - reference[0]) / along.squaredNorm();
      const Vec3 apart = kept[i] - (reference[0] + t * along);
      add(kept[i], a_refers ? -apart.dot(n) : apart.dot(n));
    }
  }
  // The clipped features may leave out the deepest point (a rim between two corners of its
  // octagon).
  const double noticeable = 1e-7 * pair.scale;
  if (witness.is_point && (set.count() == 0 || witness.gap < set.least_gap() - noticeable))
    set.add(0.5 * (witness.on_a + witness.on_b + (pair.b.core_radius - pair.a.core_radius) * n),
            witness.gap);
  if (set.count() > 0) set.reduce_into(n, manifold);
}

void PointSet::add(const Vec3& point, double gap) {
  if (count_ < kCapacity) {
    points_[static_cast<std::size_t>(count_++)] = {point, gap};
    return;
  }
  auto shallowest = std::max_element(
      points_.begin(), points_.end(),
      [](const ManifoldPoint& a, const ManifoldPoint& b) { return a.gap < b.gap; });
  if (gap < shallowest->gap) *shallowest = {point, gap};
}

double PointSet::least_gap() const {
  double least = points_[0].gap;
  for (int i = 1; i < count_; ++i)
    least = std::min(least, points_[static_cast<std::size_t>(i)].gap);
  return least;
}

void PointSet::reduce_into(const Vec3& normal, Manifold& manifold) const {
  manifold.normal = normal;
  manifold.count = std::min(count_, Manifold::kMaxPoints);
  if (count_ <= Manifold::kMaxPoints) {
    std::copy_n(points_.begin(), count_, manifold.points.begin());
    return;
  }
  // The point with the largest measure, appended if that is positive.
  manifold.count = 0;
  const auto keep_best = [&](auto&& measure) {
    int index = 0;
    double most = measure(points_[0]);
    for (int i = 1; i < count_; ++i) {
      const double value = measure(points_[static_cast<std::size_t>(i)]);
      if (value > most) {
        most = value;
        index = i;
      }
    }
    if (manifold.count > 0 && most <= 0) return false;
    manifold.points[static_cast<std::size_t>(manifold.count++)] =
        points_[static_cast<std::size_t>(index)];
    return true;
  };
  const auto& kept = manifold.points;
  const auto area = [&](const Vec3& from, const Vec3& to, const Vec3& p) {
    return (to - from).cross(p - from).dot(normal);
  };
  keep_best([](const ManifoldPoint& p) { return -p.gap; });
  if (!keep_best([&](const ManifoldPoint& p) { return (p.point - kept[0].point).squaredNorm(); }))
    return;
  if (!keep_best([&](const ManifoldPoint& p) {
        return std::abs(area(kept[0].point, kept[1].point, p.point));
      }))
    return;
  // Beyond the triangle's sides, whichever way it turns.
  const double turn = area(kept[0].point, kept[1].point, kept[2].point) < 0 ? 1 : -1;
  keep_best([&](const ManifoldPoint& p) {
    return std::max({turn * area(kept[0].point, kept[1].point, p.point),
                     turn * area(kept[1].point, kept[2].point, p.point),
                     turn * area(kept[2].point, kept[0].point, p.point)});
  });
}

}  // namespace poinsot
