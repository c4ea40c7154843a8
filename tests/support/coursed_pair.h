// Two bodies of one shape each on courses of their own, for tests of impact searches: flights,
// kinematic and static bodies, with a reference by dense sampling.

#pragma once

#include <array>
#include <optional>

#include "poinsot/collision/impact_search.h"
#include "support/geometry.h"
#include "support/scene_builder.h"

namespace poinsot::test {

class CoursedPair {
 public:
  // Courses from 0 to `end` [s]. Static bodies stay, kinematic ones move uniformly.
  CoursedPair(const BodyDef& a, const BodyDef& b, double end, const Vec3& gravity = Vec3::Zero());
  CoursedPair(const CoursedPair&) = delete;

  CoursePair pair() const { return {colliders_[0], courses_[0], colliders_[1], courses_[1]}; }
  double end() const { return end_; }
  double size() const;  // [m] the smaller
  double touch() const { return 1e-10 * size(); }
  // From the start to the end, with a touch of 1e-10 of the smaller.
  SearchSpan span() const { return {0, end_, touch()}; }

  // Signed, by the narrow phase [m].
  double gap(double t) const;

 private:
  double end_;
  World world_;
  std::array<Collider, 2> colliders_;
  std::array<Flight, 2> flights_;
  std::array<Course, 2> courses_;
};

// A body of this shape that moves about its centre of mass as told, which is at `at` at time 0.
BodyDef moving(const Shape& shape, const Vec3& at, const Vec3& v, const Vec3& omega,
               const Quat& q = Quat::Identity());

// Two bodies for a second of flight: they pass each other at 0.5 … 20 m/s within reach or nearly
// so, spinning at up to `spin` rad/s. A half-space is a wall, up which or down which body a falls.
struct FlyBy {
  BodyDef a, b;
  Vec3 gravity;
};
FlyBy random_fly_by(int kind_a, int kind_b, double spin, Random& random);

struct Sampled {
  std::optional<double> meets;  // [s] first root found
  double closest;               // [m] least gap found before it; refined
};
// Samples `dt` apart, but for stretches in which the largest speeds keep the pair apart; the first
// root by bisection, every minimum near 0 by golden section.
Sampled dense_samples(const CoursedPair& pair, double dt);

}  // namespace poinsot::test
