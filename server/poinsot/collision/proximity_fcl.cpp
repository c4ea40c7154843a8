#include "poinsot/collision/proximity_fcl.h"

#include <vector>

#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

// Packaged FCL is built for 16-byte alignment; a wider Eigen would change its layouts.
static_assert(sizeof(fcl::CollisionObjectd) == 224, "Eigen alignment differs from packaged FCL");

fcl::Transform3d to_fcl(const Pose& pose) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = pose.q.toRotationMatrix();
  X.translation() = pose.c;
  return X;
}

struct Solver {
  fcl::detail::GJKSolver_libccd<double> gjk;
  std::vector<fcl::ContactPointd> contacts;

  Solver() { contacts.reserve(8); }

  template <class Other>
  bool touch(const fcl::Sphered& sphere, const fcl::Transform3d& X, const Other& other,
             const fcl::Transform3d& Y) {
    contacts.clear();
    return gjk.shapeIntersect(sphere, X, other, Y, &contacts) && !contacts.empty();
  }
};

bool touch(Solver& solver, const fcl::Sphered& sphere, const fcl::Transform3d& X,
           const Shape& other, const fcl::Transform3d& Y) {
  if (const auto* s = std::get_if<Sphere>(&other))
    return solver.touch(sphere, X, fcl::Sphered(s->radius), Y);
  if (const auto* s = std::get_if<Box>(&other))
    return solver.touch(sphere, X, fcl::Boxd(s->size), Y);
  if (const auto* s = std::get_if<Capsule>(&other))
    return solver.touch(sphere, X, fcl::Capsuled(s->radius, s->length), Y);
  if (const auto* s = std::get_if<Cylinder>(&other))
    return solver.touch(sphere, X, fcl::Cylinderd(s->radius, s->length), Y);
  POINSOT_CHECK(!"no closed form for this pair");
  return false;
}

// FCL's normal, turned round. It is zero or noise where the centre lies on that of a sphere or on a
// capsule's axis: beside the axis it is made perpendicular, and x is as short a way out as any.
Vec3 outward_normal(const fcl::ContactPointd& contact, const Shape& other, const Vec3& center) {
  Vec3 n = -contact.normal;
  const auto* capsule = std::get_if<Capsule>(&other);
  if (capsule && std::abs(center.z()) <= 0.5 * capsule->length)
    n = Vec3(center.x(), center.y(), 0).normalized();
  return n.squaredNorm() > 0.25 ? n : Vec3(Vec3::UnitX());
}

}  // namespace

void sphere_contact_fcl(const Collider& sphere, const Pose& pose, const Collider& other,
                        const Pose& pose_other, double margin, Manifold& manifold) {
  thread_local Solver solver;
  manifold.clear();
  const double radius = std::get<Sphere>(sphere.shape).radius;
  // A sphere grown by the margin touches whatever is nearer than the margin: FCL reports only what
  // penetrates. Positions relative to the other shape, so that far from the origin nothing is lost.
  const Pose relative = pose_other.inverse() * pose;
  if (!touch(solver, fcl::Sphered(radius + margin), to_fcl(relative), other.shape,
             fcl::Transform3d::Identity()))
    return;
  const fcl::ContactPointd& contact = solver.contacts.front();
  const Vec3 n = outward_normal(contact, other.shape, relative.c);
  const double gap = margin - contact.penetration_depth;
  manifold.normal = pose_other.q * n;
  manifold.count = 1;
  // FCL's own position is wrong for capsules: take it from the sphere.
  manifold.points[0] = {pose_other * Vec3(relative.c - (radius + 0.5 * gap) * n), gap};
}

}  // namespace poinsot
