// Geometry for tests of the collision kernels: random shapes and poses, and support widths and
// memberships of shapes in closed form, written apart from the kernels they judge.
//
// With these two a query is proven without a second algorithm. A point in A and a point in B bound
// the gap from above; the slab between the supports along any normal bounds it from below.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "poinsot/collision/collider.h"

namespace poinsot::test {

// The same numbers on every machine (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform(double low, double high);
  double log_uniform(double low, double high);
  int below(int n);
  Vec3 in_box(double half);
  Vec3 direction();
  Quat rotation();

 private:
  std::uint64_t next();
  std::uint64_t state_;
};

// Indices of the variant.
enum Kind { kSphere, kBox, kCapsule, kCylinder, kCone, kEllipsoid, kConvex, kHalfSpace, kMesh };
std::string name_of(int kind);

// Half-extents 0.2 … 1 m, times `scale`; convex: the hull of 20 random points.
Shape random_shape(int kind, Random& random, double scale = 1);
Shape scaled(const Shape& shape, double factor);
Convex prism(int sides, double radius, double length);
Convex box_as_convex(const Vec3& size);
Collider collider(const Shape& shape, int body = 0);

// max over the shape of x·d [m], d in the shape's frame.
double support_width(const Shape& shape, const Vec3& d);

// How far outside the shape a point is: ≤ 0 inside. Exact zero set, in metres to first order.
double outside_by(const Shape& shape, const Vec3& point);

// Separation of the supports along n, a unit vector in W: never more than the signed gap, and equal
// to it for the best n.
double separation(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                  const Vec3& n);

// The signed gap by brute force: the best separation over a dense set of directions, improved
// locally. A lower bound always; close to the gap unless the search stops at a kink.
double sampled_gap(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

// The exact signed gap of overlapping polyhedra: all faces, all crossed edges. A lower bound for
// separated ones.
double separating_axes(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b);

// About n evenly spread unit vectors (Fibonacci's spiral).
std::vector<Vec3> directions(int n);

// Places b so that its gap to a along a random normal is `gap` by bisection on sampled supports;
// only roughly right where the nearest normal changes on the way.
Pose pose_at_gap(const Shape& a, const Pose& pose_a, const Shape& b, double gap, Random& random);

}  // namespace poinsot::test
