#include "poinsot/collision/axis_turn.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

constexpr double kTilt = 1e-6;   // [rad] features within this of being extreme are
constexpr double kLong = 1e-4;   // [-] shorter features, of the smaller shape, are points
constexpr double kSkew = 1e-3;   // [rad] edges nearer than this to parallel, faces to lines, are
constexpr double kTurn = 0.5;    // [rad] the bound of a turning axis gets poor beyond
constexpr double kPatch = 1e-9;  // [-] of the smaller shape: gaps as small as the least

// What of a core is extreme along d: nothing but a point, an edge, or a face.
struct Extreme {
  int rank = 0;
  Vec3 edge = Vec3::Zero();  // unit
};

Extreme extreme_of(const TurningCore& core, double size) {
  Extreme result;
  if (!core.collider) return result;
  const Vec3 u = core.d.unitOrthogonal(), v = core.d.cross(u);
  std::array<Vec3, 4> corner;
  const std::array<Vec3, 4> aside = {u, v, -u, -v};
  for (std::size_t i = 0; i < 4; ++i)
    corner[i] = core.R * support(*core.collider, core.R.transpose() * (core.d + kTilt * aside[i]));
  double longest = kLong * size;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 e = corner[i] - corner[j];
      const double length = e.norm();
      if (length <= longest) continue;
      longest = length;
      result = {1, e / length};
    }
  if (result.rank == 0) return result;
  for (std::size_t i = 1; i < 4; ++i)
    if ((corner[i] - corner[0]).cross(result.edge).norm() > kSkew * longest) result.rank = 2;
  return result;
}

}  // namespace

Vec3 axis_turn(const PairMotion& motion, const Vec3& n) {
  if (motion.has_plane()) return Vec3::Zero();
  const AxisBound bound = motion.bound_along(n);
  const Extreme a = extreme_of(bound.a, motion.size()), b = extreme_of(bound.b, motion.size());
  const Vec3 with_a = motion.body_a().velocity.angular.cross(n);  // n′ of a normal fixed to a
  const Vec3 with_b = motion.body_b().velocity.angular.cross(n);
  if (a.rank == 2) return n.cross(with_a);
  if (b.rank == 2) return n.cross(with_b);
  // n′ · e = (ω × n) · e for each edge.
  const Vec3 across = a.edge.cross(b.edge);
  const double sine = across.dot(n);
  if (a.rank == 1 && b.rank == 1 && std::abs(sine) > kSkew) {
    const Vec3 rate =
        (with_a.dot(a.edge) * b.edge.cross(n) + with_b.dot(b.edge) * n.cross(a.edge)) / sine;
    return n.cross(rate);
  }
  if (a.rank == 1) return with_a.dot(a.edge) * n.cross(a.edge);
  if (b.rank == 1) return with_b.dot(b.edge) * n.cross(b.edge);
  return Vec3::Zero();
}

double gap_rate(const PairMotion& motion, const NearestAxis& axis) {
  const AxisBound bound = motion.bound_along(axis.n);
  if (motion.has_plane() || (!bound.a.collider && !bound.b.collider)) return bound.slope();
  const MovingPose &a = motion.body_a(), &b = motion.body_b();
  const auto rate_at = [&](const Vec3& p) {
    return axis.n.dot(a.velocity.linear + a.velocity.angular.cross(p - a.pose.c) -
                      b.velocity.linear - b.velocity.angular.cross(p - b.pose.c));
  };
  double rate = rate_at(axis.middle);
  const double same = kPatch * motion.size();
  Manifold manifold;
  ++motion.work().gaps;
  find_manifold(motion.shape_a(), motion.pose_a(), motion.shape_b(), motion.pose_b(),
                axis.gap + same, manifold);
  for (int i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.points[static_cast<std::size_t>(i)];
    if (point.gap <= axis.gap + same) rate = std::min(rate, rate_at(point.point));
  }
  return rate;
}

double turning_for(const PairMotion& motion, const Vec3& turn, double most) {
  if (turn == Vec3::Zero()) return most;
  return std::min({most, kTurn / turn.norm(), motion.size() / motion.closing(0)});
}

Vec3 turned_axis(const Vec3& n, const Vec3& turn, double x) {
  const double rate = turn.norm();
  if (rate == 0) return n;
  const double angle = rate * x;
  return (std::cos(angle) * n + (std::sin(angle) / rate) * turn.cross(n)).normalized();
}

}  // namespace poinsot
