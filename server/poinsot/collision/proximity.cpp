#include "poinsot/collision/proximity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/collision/box_box.h"
#include "poinsot/collision/epa.h"
#include "poinsot/collision/half_space.h"
#include "poinsot/collision/mesh_pairs.h"
#include "poinsot/collision/pair_table.h"
#include "poinsot/collision/proximity_fcl.h"
#include "poinsot/collision/round_gap.h"

namespace poinsot {
namespace {

// [-] of the smaller radius: a manifold may be of a depth this much larger than the least.
constexpr double kManifoldAccuracy = 1e-4;

char kernel(const Collider& a, const Collider& b) {
  return kPairTable[a.shape.index()][b.shape.index()];
}

bool can_be_measured(const Pose& pose_a, const Pose& pose_b) {
  return std::isfinite((pose_a.c - pose_b.c).squaredNorm() + pose_a.q.squaredNorm() +
                       pose_b.q.squaredNorm());
}

// The order in which a pair is computed, whichever way it is asked for.
bool is_swapped(const Collider& a, const Collider& b) {
  return a.shape.index() > b.shape.index() ||
         (a.shape.index() == b.shape.index() && a.body > b.body);
}

// Of the shapes, from gjk or, where the cores touch, from the penetration search.
struct CoreQuery {
  Witness witness;  // gap: upper bound
  double lower;     // [m] of the gap
  bool apart;       // the cores are

  // From B to A: the way from core to surface. The normal proves the lower bound; the upper bound
  // is that of the points.
  Vec3 outward() const {
    return apart ? Vec3((witness.on_a - witness.on_b).normalized()) : witness.normal;
  }
};

CoreQuery query_cores(const ConvexPair& pair,
                      double enough = std::numeric_limits<double>::infinity(),
                      const Vec3* first = nullptr, double accuracy = kEpaGap) {
  const double radii = pair.a.core_radius + pair.b.core_radius;
  const GjkResult near = gjk(pair, enough + radii, first);
  if (near.separated)
    return {{near.normal, near.on_a, near.on_b, near.distance - radii}, near.lower - radii, true};
  const Penetration deep = penetration(pair, near, accuracy);
  // A negative depth proves the cores apart after all; then the points bound their distance.
  if (const double distance = (deep.on_a - deep.on_b).norm(); deep.depth < 0 && distance > 0)
    return {{deep.normal, deep.on_a, deep.on_b, distance - radii}, -deep.depth - radii, true};
  // The depth is bounded from above: the gap from below.
  return {{deep.normal, deep.on_a, deep.on_b, -deep.lower - radii}, -deep.depth - radii, false};
}

// Beyond the margin the search may stop with coarse bounds: the manifold is empty either way.
void general_manifold(const ConvexPair& pair, double margin, Manifold& manifold) {
  CoreQuery query = query_cores(pair, margin, nullptr, kManifoldAccuracy);
  // A depth is a least one to rounding, even where the bound from the other side is coarse.
  if (!query.apart) query.witness.gap = query.lower;
  manifold.clear();
  if (query.lower <= margin) build_manifold(pair, query.witness, margin, manifold);
}

void to_world(const Pose& pose_a, Manifold& manifold) {
  manifold.normal = pose_a.q * manifold.normal;
  for (int i = 0; i < manifold.count; ++i) {
    Vec3& point = manifold.points[static_cast<std::size_t>(i)].point;
    point = pose_a * point;
  }
}

// The plane of half-space `b` seen from the frame of shape `a`.
struct LocalPlane {
  Vec3 normal;
  double offset;
  LocalPlane(const Pose& pose_a, const HalfSpace& plane, const Pose& pose_b) {
    const Vec3 normal_W = pose_b.q * plane.normal;
    normal = pose_a.q.conjugate() * normal_W;
    offset = plane.offset + normal_W.dot(pose_b.c - pose_a.c);
  }
};

Gap gap_to_half_space(const Collider& a, const Pose& pose_a, const HalfSpace& b,
                      const Pose& pose_b) {
  const LocalPlane plane(pose_a, b, pose_b);
  const Vec3 lowest = support(a, -plane.normal) - a.core_radius * plane.normal;
  const double gap = plane.normal.dot(lowest) - plane.offset;
  return {gap, gap, pose_a.q * plane.normal, pose_a * lowest,
          pose_a * Vec3(lowest - gap * plane.normal)};
}

Gap gap_of_cores(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                 const GapHint* hint) {
  const ConvexPair pair(a, pose_a, b, pose_b);
  const bool hinted = hint && hint->valid;
  const Vec3 first = hinted ? Vec3(pose_a.q.conjugate() * hint->axis) : Vec3(-pair.c);
  const CoreQuery query = query_cores(pair, std::numeric_limits<double>::infinity(), &first);
  const Witness& near = query.witness;
  const Vec3 n = query.outward();
  return {near.gap, std::min(query.lower, near.gap), pose_a.q * near.normal,
          pose_a * Vec3(near.on_a - a.core_radius * n),
          pose_a * Vec3(near.on_b + b.core_radius * n)};
}

void deepest_mesh_manifold(const Collider& a, const Pose& pose_a, const Collider& b,
                           const Pose& pose_b, double margin, Manifold& manifold) {
  thread_local std::vector<Manifold> all;
  mesh_manifolds(a, pose_a, b, pose_b, margin, all);
  manifold.clear();
  if (!all.empty()) manifold = all.front();
}

Gap gap_of_convex(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                  const GapHint* hint) {
  Gap gap;
  return round_gap(a, pose_a, b, pose_b, gap) ? gap : gap_of_cores(a, pose_a, b, pose_b, hint);
}

}  // namespace

void find_manifold(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                   double margin, Manifold& manifold) {
  manifold.clear();
  if (!can_be_measured(pose_a, pose_b)) return;
  if (is_swapped(a, b)) {
    find_manifold(b, pose_b, a, pose_a, margin, manifold);
    manifold.normal = -manifold.normal;
    return;
  }
  switch (kernel(a, b)) {
    case 'F':
      return sphere_contact_fcl(a, pose_a, b, pose_b, margin, manifold);
    case 'B': {
      const ConvexPair pair(a, pose_a, b, pose_b);
      if (!box_box(pair, margin, manifold)) general_manifold(pair, margin, manifold);
      return to_world(pose_a, manifold);
    }
    case 'G':
      general_manifold({a, pose_a, b, pose_b}, margin, manifold);
      return to_world(pose_a, manifold);
    case 'H': {
      const LocalPlane plane(pose_a, std::get<HalfSpace>(b.shape), pose_b);
      shape_on_half_space(a, plane.normal, plane.offset, margin, manifold);
      return to_world(pose_a, manifold);
    }
    case 'M':
      return deepest_mesh_manifold(a, pose_a, b, pose_b, margin, manifold);
    default:
      POINSOT_CHECK(!"this pair never meets");
  }
}

void find_manifolds(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    double margin, std::vector<Manifold>& manifolds) {
  if (is_swapped(a, b)) {
    find_manifolds(b, pose_b, a, pose_a, margin, manifolds);
    for (Manifold& manifold : manifolds) manifold.normal = -manifold.normal;
    return;
  }
  if (kernel(a, b) == 'M') return mesh_manifolds(a, pose_a, b, pose_b, margin, manifolds);
  manifolds.resize(1);
  find_manifold(a, pose_a, b, pose_b, margin, manifolds.front());
  if (manifolds.front().count == 0) manifolds.clear();
}

Gap find_gap(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
             GapHint* hint) {
  if (!can_be_measured(pose_a, pose_b)) {
    constexpr double kUnknown = std::numeric_limits<double>::infinity();
    return {kUnknown, -kUnknown, Vec3::UnitZ(), Vec3::Zero(), Vec3::Zero()};
  }
  if (is_swapped(a, b)) {
    if (hint) hint->axis = -hint->axis;
    Gap gap = find_gap(b, pose_b, a, pose_a, hint);
    if (hint) hint->axis = -hint->axis;
    gap.normal = -gap.normal;
    std::swap(gap.point_a, gap.point_b);
    return gap;
  }
  const char by = kernel(a, b);
  const Gap gap = by == 'H'   ? gap_to_half_space(a, pose_a, std::get<HalfSpace>(b.shape), pose_b)
                  : by == 'M' ? gap_to_mesh(a, pose_a, b, pose_b)
                              : gap_of_convex(a, pose_a, b, pose_b, hint);
  if (hint) *hint = {gap.normal, true};
  return gap;
}

}  // namespace poinsot
