#include "poinsot/collision/nearest_axis.h"

#include "poinsot/collision/proximity.h"

namespace poinsot {
namespace {

constexpr double kNear = 1e-5;   // [-] cores nearer than this, of the smaller, are moved apart
constexpr double kApart = 1e-3;  // [-] by this, likewise
constexpr int kRepeats = 4;

Vec3 line_of_centres(const PairMotion& motion) {
  const Vec3 d = motion.pose_a().c - motion.pose_b().c;
  const double length = d.norm();
  return length > 0 ? Vec3(d / length) : Vec3(Vec3::UnitZ());
}

bool is_point(const Collider& collider) {
  return std::holds_alternative<Sphere>(collider.shape);
}

Vec3 middle_on_plane(const PairMotion& motion, double gap) {
  const Vec3& n = motion.plane_normal();
  const Pose pose = motion.pose_a();
  const Vec3 p = pose * support(motion.shape_a(), pose.q.conjugate() * -n);
  return p - (motion.shape_a().core_radius + 0.5 * gap) * n;
}

NearestAxis query(const PairMotion& motion, const Vec3& hint, double apart) {
  ++motion.work().gaps;
  GapHint start{hint, hint != Vec3::Zero()};
  Pose pose_a = motion.pose_a();
  pose_a.c += apart * hint;
  const Gap gap = find_gap(motion.shape_a(), pose_a, motion.shape_b(), motion.pose_b(), &start);
  return {gap.normal, motion.gap_along(gap.normal),
          0.5 * (gap.point_a - apart * hint + gap.point_b)};
}

}  // namespace

NearestAxis nearest_axis(const PairMotion& motion, const Vec3& hint) {
  if (motion.has_plane()) {
    const double gap = motion.gap_along(motion.plane_normal());
    return {motion.plane_normal(), gap, middle_on_plane(motion, gap)};
  }
  const Collider &a = motion.shape_a(), &b = motion.shape_b();
  if (is_point(a) && is_point(b)) {
    const Vec3 n = line_of_centres(motion);
    const double gap = motion.gap_along(n);
    return {n, gap, motion.pose_b().c + (b.core_radius + 0.5 * gap) * n};
  }
  const double small = motion.size();
  const double radii = a.core_radius + b.core_radius;
  const auto is_near = [&](double gap) { return std::abs(gap + radii) <= kNear * small; };
  NearestAxis best{hint, motion.gap_along(hint), Vec3::Zero()};
  if (hint == Vec3::Zero() || !is_near(best.gap)) best = query(motion, hint, 0);
  if (!is_near(best.gap)) return best;
  // The middle is that of a query, also when the axis is the hint.
  for (int i = 0; i < kRepeats; ++i) {
    const NearestAxis next = query(motion, best.n, kApart * small - best.gap);
    const double gain = next.gap - best.gap;
    if (gain >= 0)
      best = next;
    else
      best.middle = next.middle;
    if (gain <= motion.rounding()) return best;
  }
  // Corners that pass each other close by: each axis gains little on the last.
  const NearestAxis plain = query(motion, best.n, 0);
  return plain.gap > best.gap ? plain : best;
}

Vec3 first_axis(const PairMotion& motion, const Vec3& hint) {
  if (motion.has_plane()) return motion.plane_normal();
  const bool are_points = is_point(motion.shape_a()) && is_point(motion.shape_b());
  return are_points || hint == Vec3::Zero() ? line_of_centres(motion) : hint;
}

}  // namespace poinsot
