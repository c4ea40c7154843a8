#include "poinsot/collision/point_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace poinsot {
namespace {

// Sine of the angle between a normal and a face: nearer is that face's, as near as two faces are
// when they lie flat on one another, either's.
constexpr double kOfFace = 1e-6, kFlat = 1e-12;

// Of the face of a shape that is nearest to looking along n (in S).
double sine_to_face(const Collider& collider, const Vec3& n) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (std::holds_alternative<HalfSpace>(collider.shape)) return 0;
  if (std::holds_alternative<Box>(collider.shape)) {
    Eigen::Index most = 0;
    n.cwiseAbs().maxCoeff(&most);
    Vec3 beside = n;
    beside[most] = 0;
    return beside.norm();
  }
  double least = kNone;
  if (const Convex* hull = std::get_if<Convex>(&collider.shape))
    for (const Convex::Face& face : hull->faces)
      if (face.normal.dot(n) > 0) least = std::min(least, face.normal.cross(n).norm());
  return least;
}

bool is_round(const Collider& collider) {
  return collider.is_curved || collider.core_radius > 0;
}

}  // namespace

PointMotion motion_of(const CollisionState& state, const PairRecord& record, const PairPoint& p) {
  const Collider& a = state.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& b = state.colliders[static_cast<std::size_t>(record.pair.b)];
  PointMotion motion{is_round(a), is_round(b), 0, 0};
  if (motion.is_round_a || motion.is_round_b) return motion;
  const World& world = state.world();
  const auto sine = [&](const Collider& shape, double sign) {
    const Quat q = orientation(world.y, shape.body) * shape.in_body.q;
    return sine_to_face(shape, sign * (q.conjugate() * p.normal));
  };
  const double from_a = sine(a, -1), from_b = sine(b, 1);
  if (std::abs(from_a - from_b) <= kFlat || std::min(from_a, from_b) > kOfFace) {
    motion.turns_a = motion.turns_b = 0.5;
  } else {
    (from_a < from_b ? motion.turns_a : motion.turns_b) = 1;
  }
  return motion;
}

}  // namespace poinsot
