#include "support/fcl_oracle.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

namespace poinsot::test {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

struct ToFcl {
  Geometry operator()(const Sphere& s) const { return std::make_shared<fcl::Sphered>(s.radius); }
  Geometry operator()(const Box& s) const { return std::make_shared<fcl::Boxd>(s.size); }
  Geometry operator()(const Capsule& s) const {
    return std::make_shared<fcl::Capsuled>(s.radius, s.length);
  }
  Geometry operator()(const Cylinder& s) const {
    return std::make_shared<fcl::Cylinderd>(s.radius, s.length);
  }
  Geometry operator()(const Cone& s) const {
    return std::make_shared<fcl::Coned>(s.radius, s.length);
  }
  Geometry operator()(const Ellipsoid& s) const {
    return std::make_shared<fcl::Ellipsoidd>(s.semi_axes);
  }
  Geometry operator()(const Convex& s) const {
    auto vertices = std::make_shared<std::vector<Vec3>>(s.vertices);
    auto faces = std::make_shared<std::vector<int>>();
    for (const Convex::Face& face : s.faces) {
      faces->push_back(static_cast<int>(face.loop.size()));
      faces->insert(faces->end(), face.loop.begin(), face.loop.end());
    }
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(s.faces.size()), faces);
  }
  Geometry operator()(const HalfSpace& s) const {
    return std::make_shared<fcl::Halfspaced>(s.normal, s.offset);
  }
  Geometry operator()(const Mesh&) const { return nullptr; }
};

}  // namespace

Geometry to_fcl(const Shape& shape) {
  return std::visit(ToFcl(), shape);
}

fcl::Transform3d to_fcl(const Pose& pose) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.linear() = pose.q.toRotationMatrix();
  X.translation() = pose.c;
  return X;
}

double fcl_distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  fcl::DistanceRequestd request(true, false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = 1e-12;
  fcl::DistanceResultd result;
  const Geometry ga = to_fcl(a), gb = to_fcl(b);
  return fcl::distance(ga.get(), to_fcl(pose_a), gb.get(), to_fcl(pose_b), request, result);
}

double fcl_box_depth(const Box& a, const Pose& pose_a, const Box& b, const Pose& pose_b) {
  fcl::CollisionRequestd request(16, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  fcl::CollisionResultd result;
  const fcl::Boxd box_a(a.size), box_b(b.size);
  fcl::collide(&box_a, to_fcl(pose_a), &box_b, to_fcl(pose_b), request, result);
  double depth = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, result.getContact(i).penetration_depth);
  return depth;
}

}  // namespace poinsot::test
