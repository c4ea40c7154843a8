#include "contact_overlaps.h"

#include <algorithm>

#include "poinsot/collision/broad_phase.h"
#include "poinsot/collision/proximity.h"

namespace poinsot::bench {
namespace {

constexpr double kFarAway = 1e6;  // [m]

bool is_near(const Pose& pose) {
  return pose.c.norm() < kFarAway && pose.q.coeffs().allFinite();
}

}  // namespace

Overlaps find_overlaps(const ContactScene& scene, const std::vector<Pose>& poses) {
  std::vector<Collider> colliders;
  std::vector<Pose> at;
  const auto add = [&](const Shape& shape, const Pose& pose) {
    if (!is_near(pose)) return;
    colliders.emplace_back(static_cast<Eigen::Index>(colliders.size()), shape, Pose{});
    at.push_back({pose.c, pose.q.normalized()});
  };
  for (std::size_t i = 0; i < poses.size(); ++i) add(scene.bodies[i].shape, poses[i]);
  const std::size_t moving = colliders.size();
  for (const ContactBody& wall : scene.walls) add(wall.shape, wall.pose);
  add(HalfSpace{}, {Vec3::Zero(), scene.ground});

  BroadPhase broad(colliders);
  const int ground = static_cast<int>(colliders.size()) - 1;
  for (int i = 0; i < ground; ++i) {
    const auto k = static_cast<std::size_t>(i);
    broad.set(i, bounds(colliders[k], at[k]));
    broad.set_moves(i, k < moving);
  }
  broad.set_moves(ground, false);
  broad.set_plane(ground, scene.ground * Vec3::UnitZ(), 0);

  Overlaps overlaps;
  double sum = 0;
  int touching = 0;
  for (const ColliderPair& pair : broad.pairs()) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const double depth = -find_gap(colliders[a], at[a], colliders[b], at[b]).value;
    if (depth < 0) continue;
    overlaps.largest = std::max(overlaps.largest, depth);
    sum += depth;
    ++touching;
  }
  overlaps.mean = touching > 0 ? sum / touching : 0;
  return overlaps;
}

}  // namespace poinsot::bench
