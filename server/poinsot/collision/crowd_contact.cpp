#include "poinsot/collision/crowd_contact.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

// Points are kept while the pair turned and shifted by less than this of its size. Three times as
// much and a tower of ten drifts by centimetres in a minute, for it is not seen to lean.
constexpr double kSamePose = 1e-3;
// A point continues an old one of another feature when it moved by less than this of the size.
constexpr double kSamePoint = 0.1;
// Points are looked for farther than asked for, so that they are not looked for anew so soon.
constexpr double kFarther = 1.5;

// No point nearer than `arm` to the origin of B's shape moved farther with it, seen from A [m].
double shift(const Pose& before, const Pose& now, double arm) {
  const double turn = 2 * (now.q.coeffs() - before.q.coeffs()).norm();
  return (now.c - before.c).norm() + arm * turn;
}

// As find_manifold(), without a detour: heaps of balls are nothing else.
void find_spheres(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                  double margin, Manifold& manifold) {
  const Vec3 apart = pose_a.c - pose_b.c;
  const double distance = apart.norm();
  const double gap = distance - a.core_radius - b.core_radius;
  manifold.count = 0;
  if (!(gap <= margin)) return;
  manifold.normal = distance > 0 ? Vec3(apart / distance) : Vec3(Vec3::UnitZ());
  manifold.points[0] = {pose_b.c + (b.core_radius + 0.5 * gap) * manifold.normal, gap};
  manifold.count = 1;
}

// The impulses of old points that new ones continue: those of the same feature, else the nearest.
void recall(std::span<const CrowdContact::Point> old, double size, CrowdContact& contact) {
  const double most = kSamePoint * size;
  unsigned taken = 0;
  const int count = static_cast<int>(old.size());
  const auto take = [&](CrowdContact::Point& p, int j) {
    taken |= 1u << j;
    p.normal_impulse = old[static_cast<std::size_t>(j)].normal_impulse;
    p.usual_impulse = old[static_cast<std::size_t>(j)].usual_impulse;
  };
  unsigned left = 0;
  for (int k = 0; k < contact.count; ++k) {
    CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    left |= 1u << k;
    for (int j = 0; j < count; ++j) {
      if ((taken >> j & 1u) != 0 || old[static_cast<std::size_t>(j)].feature != p.feature) continue;
      take(p, j);
      left &= ~(1u << k);
      break;
    }
  }
  for (int k = 0; k < contact.count; ++k) {
    if ((left >> k & 1u) == 0) continue;
    CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    double nearest = most * most;
    int match = -1;
    for (int j = 0; j < count; ++j) {
      const double distance = (old[static_cast<std::size_t>(j)].on_b - p.on_b).squaredNorm();
      if ((taken >> j & 1u) != 0 || distance >= nearest) continue;
      nearest = distance;
      match = j;
    }
    if (match >= 0) take(p, match);
  }
}

}  // namespace

void CrowdContact::forget() {
  margin = -1;
  h = 0;
  count = 0;
  friction_in_a.setZero();
  twist_impulse = 0;
}

void CrowdContact::hash_into(Hash64& hash) const {
  hash.add(margin);
  hash.add(until);
  hash.add(h);
  for (const double x : measured.c) hash.add(x);
  for (const double x : measured.q.coeffs()) hash.add(x);
  for (const double x : normal_in_a) hash.add(x);
  for (int k = 0; k < count; ++k) {
    const Point& p = points[static_cast<std::size_t>(k)];
    for (const Vec3* v : {&p.on_a, &p.on_b})
      for (const double x : *v) hash.add(x);
    hash.add(static_cast<std::uint64_t>(p.feature));
    hash.add(p.normal_impulse);
    hash.add(p.usual_impulse);
  }
  for (const double x : friction_in_a) hash.add(x);
  hash.add(twist_impulse);
}

void measure_contact(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                     double size, double margin, CrowdContact& contact) {
  const Quat to_a = pose_a.q.conjugate();
  const Pose relative{to_a * (pose_b.c - pose_a.c), to_a * pose_b.q};
  if (contact.margin >= margin) {
    const double moved = shift(contact.measured, relative,
                               std::min(b.bounding_radius, a.bounding_radius + relative.c.norm()));
    if (contact.count == 0) {
      if (margin + moved <= contact.margin) return;  // still too far apart
    } else if (moved <= kSamePose * size && margin + moved <= contact.margin && has_corners(a) &&
               has_corners(b)) {
      return;
    }
  }
  Manifold manifold;
  if (std::holds_alternative<Sphere>(a.shape) && std::holds_alternative<Sphere>(b.shape)) {
    find_spheres(a, pose_a, b, pose_b, kFarther * margin, manifold);
  } else {
    find_manifold(a, pose_a, b, pose_b, kFarther * margin, manifold);
  }
  std::array<CrowdContact::Point, Manifold::kMaxPoints> old;
  const auto old_count = static_cast<std::size_t>(contact.count);
  std::copy_n(contact.points.begin(), old_count, old.begin());
  contact.measured = relative;
  contact.margin = kFarther * margin;
  contact.count = manifold.count;
  if (manifold.count == 0) {
    contact.friction_in_a.setZero();
    contact.twist_impulse = 0;
    return;
  }
  contact.normal_in_a = to_a * manifold.normal;
  const Quat to_b = pose_b.q.conjugate();
  for (int k = 0; k < manifold.count; ++k) {
    const ManifoldPoint& found = manifold.points[static_cast<std::size_t>(k)];
    CrowdContact::Point& p = contact.points[static_cast<std::size_t>(k)];
    const Vec3 half = (0.5 * found.gap) * manifold.normal;
    p.on_a = to_a * Vec3(found.point + half - pose_a.c);
    p.on_b = to_b * Vec3(found.point - half - pose_b.c);
    p.feature = found.feature;
    p.normal_impulse = p.usual_impulse = 0;
  }
  recall(std::span(old).first(old_count), size, contact);
  if (old_count == 0) {
    contact.friction_in_a.setZero();
    contact.twist_impulse = 0;
  }
}

}  // namespace poinsot
