#include "poinsot/collision/manifold.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace poinsot {
namespace {

// A face counts as facing the other shape up to this tilt; cos(0.01 rad).
constexpr double kFacing = 0.99995;
// A normal this near a face's is the face's, rounded; cos(4.5e-6 rad).
constexpr double kSameNormal = 1 - 1e-11;
// Edges count as parallel below this sine of their angle.
constexpr double kParallel = 0.02;

// A clipped feature: every side of the reference adds at most one corner.
struct Polygon {
  std::array<Vec3, 2 * Feature::kMaxCorners + 2> corners;
  int count = 0;

  void add(const Vec3& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
  const Vec3& operator[](int i) const { return corners[static_cast<std::size_t>(i)]; }
};

// Keeps the part of `f` with direction·x ≤ offset.
Polygon clipped(const Polygon& f, const Vec3& direction, double offset) {
  Polygon result;
  if (f.count == 0) return result;
  const int edges = f.count > 2 ? f.count : f.count - 1;
  double dp = direction.dot(f[0]) - offset;
  if (f.count <= 2 && dp <= 0) result.add(f[0]);
  for (int i = 0; i < edges; ++i) {
    const Vec3& p = f[i];
    const Vec3& q = f[i + 1 == f.count ? 0 : i + 1];
    const double dq = direction.dot(q) - offset;
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) result.add(p + dp / (dp - dq) * (q - p));
    if (dq <= 0) result.add(q);
    dp = dq;
  }
  return result;
}

Polygon polygon(const Feature& f) {
  Polygon result;
  for (int i = 0; i < f.count; ++i) result.add(f[i]);
  return result;
}

Vec3 face_normal(const Feature& f) {  // Newell's sum: robust for any planar polygon
  if (f.count < 3) return Vec3::Zero();
  Vec3 n = Vec3::Zero();
  for (int i = 1; i + 1 < f.count; ++i) n += (f[i] - f[0]).cross(f[i + 1] - f[0]);
  return n.normalized();
}

Feature in_a_frame(const ConvexPair& pair, Feature f) {
  for (int i = 0; i < f.count; ++i) f.corners[static_cast<std::size_t>(i)] = pair.c + pair.R * f[i];
  return f;
}

// The two features that face each other and which of them is cut to the other's outline.
struct Facing {
  const ConvexPair& pair;
  Vec3 normal;  // unit, from B to A
  double margin;
  Feature reference, incident;
  Vec3 face = Vec3::Zero();  // outward normal of the reference; zero for an edge
  bool a_refers = true;

  Facing(const ConvexPair& pair_, const Vec3& n, double margin_)
      : pair(pair_), normal(n), margin(margin_) {
    const Feature on_a = support_feature(pair.a, -n);
    const Feature on_b = in_a_frame(pair, support_feature(pair.b, pair.R.transpose() * n));
    const Vec3 face_a = face_normal(on_a), face_b = face_normal(on_b);
    a_refers = -face_a.dot(n) >= face_b.dot(n) * (1 - 1e-9);  // A on a tie
    reference = a_refers ? on_a : on_b;
    incident = a_refers ? on_b : on_a;
    face = a_refers ? face_a : face_b;
    if (alignment() > kSameNormal) normal = a_refers ? Vec3(-face) : face;
  }

  double alignment() const { return std::abs(face.dot(normal)); }

  // From an incident core point, `core_gap` along the normal from the reference core.
  void add(PointSet& set, const Vec3& on_incident, double core_gap) const {
    const double gap = core_gap - pair.a.core_radius - pair.b.core_radius;
    if (gap > margin) return;
    const double to_middle =
        a_refers ? pair.b.core_radius + 0.5 * gap : -(pair.a.core_radius + 0.5 * gap);
    set.add(on_incident + to_middle * normal, gap);
  }
};

// The incident feature cut, along the normal, to what lies above the reference face.
void clip_to_face(const Facing& facing, PointSet& set) {
  const Feature& face = facing.reference;
  const Vec3 up = facing.a_refers ? Vec3(-facing.normal) : facing.normal;
  const double slack = 4 * facing.pair.rounding();
  Polygon kept = polygon(facing.incident);
  for (int i = 0; i < face.count && kept.count > 0; ++i) {
    const Vec3 side = face[i + 1 == face.count ? 0 : i + 1] - face[i];
    const Vec3 outward = side.cross(up);
    kept = clipped(kept, outward, outward.dot(face[i]) + slack * side.norm());
  }
  const double alignment = facing.alignment();
  for (int i = 0; i < kept.count; ++i)
    facing.add(set, kept[i], facing.face.dot(kept[i] - face[0]) / alignment);
}

// The incident edge cut to what lies beside the reference edge; nothing unless they are parallel.
// Between edges that cross at a small angle the round surfaces fall away: the gap is that of
// circles about the edges' axes.
void clip_to_edge(const Facing& facing, PointSet& set) {
  const Vec3 origin = facing.reference[0], along = facing.reference[1] - origin;
  const Vec3 other = facing.incident[1] - facing.incident[0];
  const double length2 = along.squaredNorm(), other2 = other.squaredNorm();
  if (along.cross(other).squaredNorm() > kParallel * kParallel * length2 * other2) return;
  const Polygon kept =
      clipped(clipped(polygon(facing.incident), along, along.dot(origin) + length2), -along,
              -along.dot(origin));
  for (int i = 0; i < kept.count; ++i) {
    const double t = along.dot(kept[i] - origin) / length2;
    const double s = other.dot(kept[i] - facing.incident[0]) / other2;
    const double round = facing.reference.round_at(t) + facing.incident.round_at(s);
    const Vec3 apart = (facing.a_refers ? -1.0 : 1.0) * (kept[i] - origin - t * along);
    const double height = apart.dot(facing.normal);
    const double aside2 = (apart - height * facing.normal).squaredNorm();
    facing.add(set, kept[i], std::sqrt((height + round) * (height + round) + aside2) - round);
  }
}

}  // namespace

void build_manifold(const ConvexPair& pair, const Witness& witness, double margin,
                    Manifold& manifold) {
  manifold.clear();
  if (witness.gap > margin) return;
  const double same_gap = kSameGap * std::min(pair.a.size, pair.b.size);
  const Facing facing(pair, witness.normal, margin);
  PointSet set(same_gap);
  if (facing.alignment() >= kFacing) {
    clip_to_face(facing, set);
  } else if (facing.reference.count == 2 && facing.incident.count == 2) {
    clip_to_edge(facing, set);
  }
  // What is clipped may leave out the deepest point: a rim between two corners of its octagon.
  if (set.count() == 0 || witness.gap < set.least_gap() - same_gap) {
    const double aside = 0.5 * (pair.b.core_radius - pair.a.core_radius);
    set.add(0.5 * (witness.on_a + witness.on_b) + aside * facing.normal, witness.gap);
  }
  set.reduce_into(facing.normal, manifold);
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
  manifold.count = 0;
  if (count_ == 0) return;
  const std::span<const ManifoldPoint> points(points_.data(), static_cast<std::size_t>(count_));
  const double deep = least_gap() + same_gap_;
  manifold.points[0] = *std::find_if(points.begin(), points.end(),
                                     [&](const ManifoldPoint& p) { return p.gap <= deep; });
  manifold.count = 1;
  // Appends the point of the largest measure, the first on a tie, if that is above `least`.
  const auto keep_best = [&](double least, auto&& measure) {
    const ManifoldPoint* best = nullptr;
    for (const ManifoldPoint& p : points) {
      const double value = measure(p.point);
      if (value <= least) continue;
      least = value * (1 + 1e-9);
      best = &p;
    }
    if (best) manifold.points[static_cast<std::size_t>(manifold.count++)] = *best;
    return best != nullptr;
  };
  const Vec3& first = manifold.points[0].point;
  const auto beside2 = [&](const Vec3& p, const Vec3& q) {
    const Vec3 d = p - q;
    return d.squaredNorm() - d.dot(normal) * d.dot(normal);
  };
  const double same2 = same_gap_ * same_gap_;
  if (!keep_best(same2, [&](const Vec3& p) { return beside2(p, first); })) return;
  const Vec3& second = manifold.points[1].point;
  const auto area = [&](const Vec3& from, const Vec3& to, const Vec3& p) {
    return (to - from).cross(p - from).dot(normal);
  };
  const double no_area = same_gap_ * (second - first).norm();
  if (!keep_best(no_area, [&](const Vec3& p) { return std::abs(area(first, second, p)); })) {
    // On a line: the other end, where the deepest lies between both.
    const double other_side = beside2(first, second) + no_area;
    keep_best(other_side, [&](const Vec3& p) { return beside2(p, second); });
    return;
  }
  // Beyond the triangle's sides, whichever way it turns.
  const Vec3& third = manifold.points[2].point;
  const double turn = area(first, second, third) < 0 ? 1 : -1;
  keep_best(no_area, [&](const Vec3& p) {
    return std::max({turn * area(first, second, p), turn * area(second, third, p),
                     turn * area(third, first, p)});
  });
}

}  // namespace poinsot
