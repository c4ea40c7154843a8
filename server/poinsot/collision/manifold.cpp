#include "poinsot/collision/manifold.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// A face counts as facing the other shape up to this tilt; cos(0.02 rad).
constexpr double kFacing = 0.9998;
// A normal this near a face's is the face's, rounded; cos(4.5e-6 rad).
constexpr double kSameNormal = 1 - 1e-11;
// Edges count as parallel below this sine of their angle.
constexpr double kParallel = 0.02;

// A clipped feature: every side of the reference adds at most one corner.
struct Polygon {
  std::array<Vec3, 2 * Feature::kMaxCorners + 2> corners;
  std::array<std::uint32_t, 2 * Feature::kMaxCorners + 2> features;
  int count = 0;

  void add(const Vec3& corner, std::uint32_t feature) {
    features[static_cast<std::size_t>(count)] = feature;
    corners[static_cast<std::size_t>(count++)] = corner;
  }
  std::uint32_t feature(int i) const { return features[static_cast<std::size_t>(i)]; }
  const Vec3& operator[](int i) const { return corners[static_cast<std::size_t>(i)]; }
};

// Keeps the part of `f` with direction·x ≤ offset. `side`: the number of what cuts.
Polygon clipped(const Polygon& f, const Vec3& direction, double offset, std::uint32_t side) {
  Polygon result;
  if (f.count == 0) return result;
  const int edges = f.count > 2 ? f.count : f.count - 1;
  double dp = direction.dot(f[0]) - offset;
  if (f.count <= 2 && dp <= 0) result.add(f[0], f.feature(0));
  for (int i = 0; i < edges; ++i) {
    const Vec3& p = f[i];
    const int next = i + 1 == f.count ? 0 : i + 1;
    const Vec3& q = f[next];
    const double dq = direction.dot(q) - offset;
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
      result.add(p + dp / (dp - dq) * (q - p), edge_cut(f.feature(i), side, dq > 0));
    if (dq <= 0) result.add(q, f.feature(next));
    dp = dq;
  }
  return result;
}

Polygon polygon(const Feature& f, bool of_a) {
  Polygon result;
  for (int i = 0; i < f.count; ++i)
    result.add(f[i], corner_of(of_a, f.id[static_cast<std::size_t>(i)]));
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
  void add(PointSet& set, const Vec3& on_incident, double core_gap, std::uint32_t feature) const {
    const double gap = core_gap - pair.a.core_radius - pair.b.core_radius;
    if (gap > margin) return;
    const double to_middle =
        a_refers ? pair.b.core_radius + 0.5 * gap : -(pair.a.core_radius + 0.5 * gap);
    set.add(on_incident + to_middle * normal, gap, feature);
  }
};

// The incident feature cut, along the normal, to what lies above the reference face.
void clip_to_face(const Facing& facing, PointSet& set) {
  const Feature& face = facing.reference;
  const Vec3 up = facing.a_refers ? Vec3(-facing.normal) : facing.normal;
  const double slack = 4 * facing.pair.rounding();
  Polygon kept = polygon(facing.incident, !facing.a_refers);
  for (int i = 0; i < face.count && kept.count > 0; ++i) {
    const Vec3 side = face[i + 1 == face.count ? 0 : i + 1] - face[i];
    const Vec3 outward = side.cross(up);
    kept = clipped(kept, outward, outward.dot(face[i]) + slack * side.norm(),
                   face.id[static_cast<std::size_t>(i)]);
  }
  const double alignment = facing.alignment();
  for (int i = 0; i < kept.count; ++i)
    facing.add(set, kept[i], facing.face.dot(kept[i] - face[0]) / alignment, kept.feature(i));
}

// The incident edge cut to what lies beside the reference edge; nothing unless they are parallel.
// Between edges that cross at a small angle the round surfaces fall away: the gap is that of
// circles about the edges' axes.
void clip_to_edge(const Facing& facing, PointSet& set) {
  const Vec3 origin = facing.reference[0], along = facing.reference[1] - origin;
  const Vec3 other = facing.incident[1] - facing.incident[0];
  const double length2 = along.squaredNorm(), other2 = other.squaredNorm();
  if (along.cross(other).squaredNorm() > kParallel * kParallel * length2 * other2) return;
  const Polygon kept = clipped(
      clipped(polygon(facing.incident, !facing.a_refers), along, along.dot(origin) + length2, 1),
      -along, -along.dot(origin), 0);
  for (int i = 0; i < kept.count; ++i) {
    const double t = along.dot(kept[i] - origin) / length2;
    const double s = other.dot(kept[i] - facing.incident[0]) / other2;
    const double round = facing.reference.round_at(t) + facing.incident.round_at(s);
    const Vec3 apart = (facing.a_refers ? -1.0 : 1.0) * (kept[i] - origin - t * along);
    const double height = apart.dot(facing.normal);
    const double aside2 = (apart - height * facing.normal).squaredNorm();
    facing.add(set, kept[i], std::sqrt((height + round) * (height + round) + aside2) - round,
               kept.feature(i));
  }
}

}  // namespace

void build_manifold(const ConvexPair& pair, const Witness& witness, double margin,
                    Manifold& manifold) {
  manifold.clear();
  if (witness.gap <= margin) gather_points(pair, witness, margin, true).reduce_into(manifold);
}

PointSet gather_points(const ConvexPair& pair, const Witness& witness, double margin,
                       bool keep_witness) {
  const double same_gap = kSameGap * std::min(pair.a.size, pair.b.size);
  const Facing facing(pair, witness.normal, margin);
  PointSet set(facing.normal, same_gap);
  if (facing.alignment() >= kFacing) {
    clip_to_face(facing, set);
  } else if (facing.reference.count == 2 && facing.incident.count == 2) {
    clip_to_edge(facing, set);
  }
  // What is clipped may leave out the deepest point: a rim between two corners of its octagon.
  if (keep_witness && witness.gap <= margin &&
      (set.count() == 0 || witness.gap < set.least_gap() - same_gap)) {
    const double aside = 0.5 * (pair.b.core_radius - pair.a.core_radius);
    set.add(0.5 * (witness.on_a + witness.on_b) + aside * facing.normal, witness.gap);
  }
  return set;
}

Choice choose_points(std::span<const Candidate> candidates, double same_gap) {
  Choice choice;
  if (candidates.empty()) return choice;
  double least = candidates[0].gap;
  for (const Candidate& c : candidates) least = std::min(least, c.gap);
  std::size_t deepest = 0;
  while (candidates[deepest].gap > least + same_gap) ++deepest;
  // Of those equally deep, the one that is farthest from the first is a corner of them all; the
  // first may lie on an edge, and one corner of four would be left out.
  const std::size_t first = deepest;
  const auto distance2 = [](const Candidate& a, const Candidate& b) {
    return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
  };
  double farthest = same_gap * same_gap;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double distance = distance2(candidates[i], candidates[first]);
    if (candidates[i].gap > least + same_gap || distance <= farthest) continue;
    farthest = distance * (1 + 1e-9);
    deepest = i;
  }
  choice.index[0] = deepest;
  choice.count = 1;
  // Appends the candidate of the largest measure, the first on a tie, if that is above `bar`.
  const auto append_best = [&](double bar, auto&& measure) {
    std::size_t best = candidates.size();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double value = measure(candidates[i]);
      if (value <= bar) continue;
      bar = value * (1 + 1e-9);
      best = i;
    }
    if (best == candidates.size()) return false;
    choice.index[static_cast<std::size_t>(choice.count++)] = best;
    return true;
  };
  const Candidate& p = candidates[deepest];
  const auto area = [](const Candidate& a, const Candidate& b, const Candidate& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  };
  if (!append_best(same_gap * same_gap, [&](const Candidate& c) { return distance2(c, p); }))
    return choice;
  const Candidate& q = candidates[choice.index[1]];
  const double length2 = distance2(p, q), no_area = same_gap * std::sqrt(length2);
  if (!append_best(no_area, [&](const Candidate& c) { return std::abs(area(p, q, c)); })) {
    append_best(length2 + no_area, [&](const Candidate& c) { return distance2(c, q); });
    return choice;
  }
  // Beyond the triangle's sides, whichever way it turns.
  const Candidate& r = candidates[choice.index[2]];
  const double turn = area(p, q, r) < 0 ? 1 : -1;
  append_best(no_area, [&](const Candidate& c) {
    return std::max({turn * area(p, q, c), turn * area(q, r, c), turn * area(r, p, c)});
  });
  return choice;
}

PointSet::PointSet(const Vec3& normal, double same_gap) : normal_(normal), same_gap_(same_gap) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  u_ = normal.cross(Vec3::Unit(least)).normalized();
  v_ = normal.cross(u_);
}

void PointSet::add(const Vec3& point, double gap, std::uint32_t feature) {
  auto slot = static_cast<std::size_t>(count_);
  if (count_ < kCapacity) {
    ++count_;
  } else {
    const auto shallowest =
        std::max_element(candidates_.begin(), candidates_.end(),
                         [](const Candidate& a, const Candidate& b) { return a.gap < b.gap; });
    if (gap >= shallowest->gap) return;
    slot = static_cast<std::size_t>(shallowest - candidates_.begin());
  }
  points_[slot] = point;
  candidates_[slot] = {u_.dot(point), v_.dot(point), gap, feature};
}

double PointSet::least_gap() const {
  double least = candidates_[0].gap;
  for (int i = 1; i < count_; ++i)
    least = std::min(least, candidates_[static_cast<std::size_t>(i)].gap);
  return least;
}

void PointSet::reduce_into(Manifold& manifold) const {
  manifold.normal = normal_;
  const Choice choice =
      choose_points({candidates_.data(), static_cast<std::size_t>(count_)}, same_gap_);
  manifold.count = choice.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(choice.count); ++k) {
    const std::size_t i = choice.index[k];
    manifold.points[k] = {points_[i], candidates_[i].gap, candidates_[i].feature};
  }
}

}  // namespace poinsot
