#include "poinsot/collision/pair_contact.h"

#include <algorithm>
#include <cmath>

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

// A point continues an old one of its pair when it moved by less than this, relative to the size.
constexpr double kSamePoint = 0.25;
// Points are moved along instead of found anew while the pair turned and shifted by less than this
// of its size: their gaps are then wrong by no more than its square.
constexpr double kSamePose = 1e-5;

// How far the pair is from where its points were last found [m].
double shift(const Pose& before, const Pose& now, double arm) {
  return (now.c - before.c).norm() + arm * (now.q.coeffs() - before.q.coeffs()).norm() * 2;
}

void recall(PairContact& contact, double size, double h) {
  const double scale = contact.last_h > 0 ? h / contact.last_h : 0;
  std::uint64_t taken = 0;  // a bit per old point
  const std::size_t old = std::min<std::size_t>(contact.last.size(), 64);
  for (PairPoint& p : contact.points) {
    double nearest = kSamePoint * size;
    std::size_t match = old;
    for (std::size_t j = 0; j < old; ++j) {
      const double distance = (contact.last[j].offset - p.offset).norm();
      if ((taken >> j & 1) != 0 || distance >= nearest) continue;
      nearest = distance;
      match = j;
    }
    if (match == old) continue;
    taken |= std::uint64_t{1} << match;
    const PairPoint& before = contact.last[match];
    p.normal_impulse = scale * before.normal_impulse;
    p.friction_impulse =
        scale * (before.friction_impulse - p.normal.dot(before.friction_impulse) * p.normal);
    p.approach = before.approach;
  }
}

}  // namespace

// The points of a pair where its bodies are now; those that continue old ones keep what they know.
void measure_pair(CollisionState& state, PairRecord& record, double margin, double h) {
  const World& world = state.world();
  const auto a = static_cast<Eigen::Index>(record.a), b = static_cast<Eigen::Index>(record.b);
  const Collider& shape_a = state.colliders[static_cast<std::size_t>(record.pair.a)];
  const Collider& shape_b = state.colliders[static_cast<std::size_t>(record.pair.b)];
  const Pose pose_a = collider_pose(shape_a, {position(world.y, a), orientation(world.y, a)});
  const Pose pose_b = collider_pose(shape_b, {position(world.y, b), orientation(world.y, b)});
  const Pose relative{pose_a.q.conjugate() * (pose_b.c - pose_a.c),
                      pose_a.q.conjugate() * pose_b.q};
  PairContact& contact = state.pairs.contact(record);
  std::swap(contact.points, contact.last);
  contact.points.clear();

  const Eigen::Index mover = world.moves(a) ? a : b;
  const Vec3 center = position(world.y, mover);
  const bool same =
      has_corners(shape_a) && has_corners(shape_b) && contact.margin >= margin &&
      contact.margin <= 2 * margin &&
      shift(contact.measured, relative,
            std::min(shape_a.bounding_radius, shape_b.bounding_radius)) < kSamePose * record.size;
  if (same) {
    contact.points = contact.last;
    for (PairPoint& p : contact.points) {
      const Vec3 on_a = pose_a * p.anchor_a, on_b = pose_b * p.anchor_b;
      p.normal = pose_a.q * p.normal_in_a;
      p.gap = p.normal.dot(on_a - on_b);
      p.position = 0.5 * (on_a + on_b);
      p.offset = (mover == a ? on_a : on_b) - center;
    }
    const double scale = contact.last_h > 0 ? h / contact.last_h : 0;
    for (PairPoint& p : contact.points) {
      p.normal_impulse *= scale;
      p.friction_impulse =
          scale * (p.friction_impulse - p.normal.dot(p.friction_impulse) * p.normal);
    }
    contact.last_h = h;
    return;
  }
  thread_local std::vector<Manifold> manifolds;
  find_manifolds(shape_a, pose_a, shape_b, pose_b, 1.5 * margin, manifolds);
  contact.measured = relative;
  contact.margin = 1.5 * margin;
  for (const Manifold& manifold : manifolds)
    for (int k = 0; k < manifold.count; ++k) {
      const ManifoldPoint& found = manifold.points[static_cast<std::size_t>(k)];
      PairPoint p;
      p.position = found.point;
      p.normal = manifold.normal;
      p.gap = found.gap;
      const Vec3 half = (0.5 * p.gap) * p.normal;
      p.normal_in_a = pose_a.q.conjugate() * p.normal;
      p.anchor_a = pose_a.inverse() * Vec3(p.position + half);
      p.anchor_b = pose_b.inverse() * Vec3(p.position - half);
      // On the mover's own surface: the point midway moves while the gap closes.
      p.offset = (mover == a ? Vec3(p.position + half) : Vec3(p.position - half)) - center;
      contact.points.push_back(p);
    }
  recall(contact, record.size, h);
  contact.last_h = h;
}

}  // namespace poinsot
