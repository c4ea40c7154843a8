// Distance between two convex cores, with a certificate.
//
// GJK descends to the point v of the Minkowski difference A − B that is nearest the origin. Every
// support point w gives a lower bound v·w/|v| ≤ distance ≤ |v|; the search stops when the two meet
// to `kGjkGap` of the smaller body, not when it merely stops making progress. Both bounds hold up
// to rounding, `kRounding` of the pair's scale.
//
// Source: Gilbert, Johnson, Keerthi 1988; stop by duality gap: van den Bergen 1999; closest points
// of simplices: Ericson, Real-Time Collision Detection, ch. 5.

#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "poinsot/collision/collider.h"

namespace poinsot {

inline constexpr double kGjkGap = 1e-12;    // [-] upper − lower bound, of the smaller radius
inline constexpr double kGjkTouch = 1e-10;  // [-] closer than this, of the smaller radius: touching
inline constexpr double kGjkNear = 1e-5;    // [-] below this, likewise, an unsure distance, whose
inline constexpr double kGjkSure = 1e-9;    // [-] bounds are farther apart than this, is none
inline constexpr double kPolishFrom =
    0.1;  // [-] upper − lower bound at which Newton's method starts
inline constexpr double kRounding = 4e-15;  // [-] of the scale: what positions are known to
inline constexpr int kGjkIterations = 128;

// A pair placed for a query: everything in A's frame.
struct ConvexPair {
  const Collider& a;
  const Collider& b;
  Mat3 R;        // B → A
  Vec3 c;        // [m] B's origin in A
  double scale;  // [m] of the coordinates: what rounding is relative to
  double small;  // [m] the smaller bounding radius: what tolerances are relative to

  ConvexPair(const Collider& a_, const Pose& pose_a, const Collider& b_, const Pose& pose_b)
      : a(a_),
        b(b_),
        R((pose_a.q.conjugate() * pose_b.q).toRotationMatrix()),
        c(pose_a.q.conjugate() * (pose_b.c - pose_a.c)),
        scale(a_.bounding_radius + b_.bounding_radius + c.norm()),
        small(std::min(a_.bounding_radius, b_.bounding_radius)) {}

  double rounding() const { return kRounding * scale; }  // [m]
  double at_least_rounding(double length) const { return std::max(length, rounding()); }

  bool is_curved() const { return a.is_curved || b.is_curved; }

  Vec3 support_a(const Vec3& d) const { return support(a, d); }
  Vec3 support_b(const Vec3& d) const { return c + R * support(b, R.transpose() * d); }
};

// A point of A − B and where it comes from.
struct DifferencePoint {
  Vec3 w;     // [m] on_a − on_b
  Vec3 on_a;  // [m] in A's frame

  Vec3 on_b() const { return on_a - w; }
};
DifferencePoint difference_support(const ConvexPair& pair, const Vec3& d);

// Up to three points of A − B and the weights of their blend.
struct Blend {
  std::array<DifferencePoint, 3> points;
  std::array<double, 3> weights;
  std::size_t size = 0;

  Vec3 on_a() const {
    Vec3 sum = weights[0] * points[0].on_a;
    for (std::size_t i = 1; i < size; ++i) sum += weights[i] * points[i].on_a;
    return sum;
  }
  Vec3 on_b() const {
    Vec3 sum = weights[0] * points[0].on_b();
    for (std::size_t i = 1; i < size; ++i) sum += weights[i] * points[i].on_b();
    return sum;
  }
};

// Of the cores, in A's frame. Both bounds hold whether or not the method settled.
struct Polished {
  bool settled = false;  // stationary: bounds meet when apart, a least depth nearby when not
  double upper = 0;      // [m] distance of the points; of the distance only when apart
  double lower = 0;      // [m] separation along the normal; negative: a depth that parts the cores
  Vec3 normal;           // unit, from B to A
  Vec3 on_a, on_b;       // [m] points of the cores
};

struct GjkResult {
  bool separated =
      false;            // proven: the cores do not touch; distances and normal are valid only then
  double distance = 0;  // [m] upper bound
  double lower = 0;     // [m] lower bound
  Vec3 normal;          // unit, from B to A, in A's frame: the direction that proves `lower`
  Vec3 on_a, on_b;      // [m] nearest points, in A's frame; not valid when size is 4
  std::array<DifferencePoint, 4> simplex;  // where it ended: the start of the penetration search
  int size = 0;
  int iterations = 0;
  Polished near_stationary;  // where the last digits were sought, if they were
};

// Stops early, with coarse bounds, once the cores are known to be farther apart than `enough` [m].
// `first`: the direction to try first, from B to A, any length, in A's frame.
GjkResult gjk(const ConvexPair& pair, double enough = std::numeric_limits<double>::infinity(),
              const Vec3* first = nullptr);

}  // namespace poinsot
