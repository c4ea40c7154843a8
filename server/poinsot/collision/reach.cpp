#include "poinsot/collision/reach.h"

#include <algorithm>
#include <cmath>

namespace poinsot {
namespace {

// A box is made to last until its body has moved by this many of its arms, and at most this many
// times the time asked for.
constexpr double kLastingArms = 2, kLastingTimes = 32;
constexpr double kRoom = 1e-12;  // [-] for the rounding of the box itself

struct Interval {
  double low, high;
};

// Of v x + ½ a x² for x = 0 … h.
Interval range(double v, double a, double h) {
  const double end = h * (v + 0.5 * a * h);
  Interval r{std::min(0.0, end), std::max(0.0, end)};
  if (a != 0) {
    const double vertex = -v / a;
    if (vertex > 0 && vertex < h) {
      const double top = 0.5 * v * vertex;
      r.low = std::min(r.low, top);
      r.high = std::max(r.high, top);
    }
  }
  return r;
}

}  // namespace

Aabb reach_box(CollisionState& state, const Collider& collider, double from, double to) {
  const World& world = state.world();
  const Eigen::Index i = collider.body;
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  Aabb box = bounds(collider, collider_pose(collider, pose));
  const double h = to - from;
  const bool still = !state.is_awake(i) && !world.is_kinematic(i);
  if (still) return box;
  const double arm = collider.in_body.c.norm() + collider.bounding_radius;
  Vec3 low, high;
  double omega;
  if (world.is_kinematic(i)) {
    const Vec3 path = h * linear_velocity(world, i);
    low = path.cwiseMin(0);
    high = path.cwiseMax(0);
    omega = angular_velocity(world, i).norm();
  } else if (state.simulation.flies_free() && !state.simulation.is_driven(i)) {
    const Vec3 v = linear_velocity(world, i);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Interval r = range(v[axis], world.gravity[axis], h);
      low[axis] = r.low;
      high[axis] = r.high;
    }
    // Beginning a flight is dear: only that of a body that is in one is asked.
    omega = state.simulation.is_in_flight(i) ? state.simulation.turning(i, from).omega
                                             : driven_bound(world, i, {}, h).speed.omega;
  } else {
    const DrivenBound bound = driven_bound(world, i, {}, h);
    high = Vec3::Constant(std::min(h * bound.speed.v, bound.path));
    low = -high;
    omega = bound.speed.omega;
  }
  const double turn = std::min(2.0, omega * h) * arm;
  box.low = (box.low.array() - turn).max(pose.c.array() - arm).matrix() + low;
  box.high = (box.high.array() + turn).min(pose.c.array() + arm).matrix() + high;
  const double room = kRoom * (pose.c.cwiseAbs().maxCoeff() + arm) +
                      state.def.contact_margin * 0.01 * collider.size;
  return box.grown(room);
}

double fastest_point(const CollisionState& state, Eigen::Index i, double duration) {
  const World& world = state.world();
  const double arm = state.arm[static_cast<std::size_t>(i)];
  if (state.is_awake(i)) {
    const DrivenBound bound = driven_bound(world, i, {}, duration);
    return std::min(bound.speed.v, bound.path / duration) + arm * bound.speed.omega;
  }
  if (world.is_kinematic(i))
    return linear_velocity(world, i).norm() + arm * angular_velocity(world, i).norm();
  return 0;
}

double worthwhile(const CollisionState& state, Eigen::Index i, double from, double to) {
  const World& world = state.world();
  if (!world.is_kinematic(i) && (!state.simulation.flies_free() || state.simulation.is_driven(i)))
    return to;
  const double h = to - from;
  const double speed = linear_velocity(world, i).norm() + h * world.gravity.norm();
  const double lasting = kLastingArms * state.arm[static_cast<std::size_t>(i)] / speed;
  return from + std::max(h, std::min(kLastingTimes * h, lasting));
}

}  // namespace poinsot
