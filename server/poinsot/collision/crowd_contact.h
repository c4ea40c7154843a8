// Where a pair of a crowd touches: one plane and up to four points that keep to their bodies, and
// what they remember from step to step. Found anew only when the pair has moved.

#pragma once

#include <array>
#include <cstdint>

#include "poinsot/base/hash.h"
#include "poinsot/collision/manifold.h"

namespace poinsot {

struct CrowdContact {
  struct Point {
    Vec3 on_a = Vec3::Zero();   // [m] on the surface of a, in the frame S of its shape
    Vec3 on_b = Vec3::Zero();   // [m] on that of b, likewise
    double normal_impulse = 0;  // [N·s] of the last sub-step
    double usual_impulse = 0;   // [N·s] its long mean
    std::uint32_t feature = kNearestFeature;

    template <class Archive>
    void archive(Archive& with) {
      with(on_a, on_b, normal_impulse, usual_impulse, feature);
    }
  };

  Pose measured;       // of B's shape in A's frame when the points were last found …
  double margin = -1;  // [m] … and how far apart they were looked for; < 0: never
  double until = -1;   // [s] the end of the step it was last used in
  double h = 0;        // [s] sub-step of the impulses; 0: there are none
  int count = 0;
  Vec3 normal_in_a = Vec3::UnitZ();   // unit, from b to a
  Vec3 friction_in_a = Vec3::Zero();  // [N·s] on a, in the frame S of A
  double twist_impulse = 0;           // [N·m·s] on a about the normal
  std::array<Point, Manifold::kMaxPoints> points;

  void forget();  // as if it had never been near
  void hash_into(Hash64& hash) const;
  template <class Archive>
  void archive(Archive& with) {
    with(measured, margin, until, h);
    with.choice(count, Manifold::kMaxPoints);
    with(normal_in_a, friction_in_a, twist_impulse);
    for (int k = 0; k < count; ++k) with(points[static_cast<std::size_t>(k)]);
  }
};

// Brings a contact to where its shapes are now: points nearer than `margin` [m], and some beyond.
// Points that continue old ones keep their impulses. A pair of polyhedra that turned and shifted by
// less than a thousandth of its size keeps its points; their gaps are then wrong by the square
// of that.
void measure_contact(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                     double size, double margin, CrowdContact& contact);

}  // namespace poinsot
