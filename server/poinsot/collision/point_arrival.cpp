#include "poinsot/collision/point_arrival.h"

#include <limits>

#include "poinsot/collision/proximity.h"

namespace poinsot {

double gap_of_point(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                    const PairPoint& point, std::vector<Manifold>& manifolds) {
  const double reach =
      a.bounding_radius < b.bounding_radius ? a.bounding_radius : b.bounding_radius;
  find_manifolds(a, pose_a, b, pose_b, reach, manifolds);
  double nearest = std::numeric_limits<double>::infinity(), gap = nearest;
  for (const Manifold& manifold : manifolds)
    for (int k = 0; k < manifold.count; ++k) {
      const ManifoldPoint& p = manifold.points[static_cast<std::size_t>(k)];
      const Vec3 half = (0.5 * p.gap) * manifold.normal;
      const double from_a = (pose_a.inverse() * Vec3(p.point + half) - point.anchor_a).norm();
      const double from_b = (pose_b.inverse() * Vec3(p.point - half) - point.anchor_b).norm();
      const double distance = std::min(from_a, from_b);
      if (distance >= nearest) continue;
      nearest = distance;
      gap = p.gap;
    }
  return gap;
}

}  // namespace poinsot
