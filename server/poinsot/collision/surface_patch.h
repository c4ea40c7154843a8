// One feature of a core's surface as a smooth piece: which points face a normal m, along which
// straight freedoms they may lie, and how they move when m turns.
//
// The points facing m are x(m) + t₀ g₀ + t₁ g₁. A corner has no freedom, an edge one, a face two; a
// rim has x on the circle; the side of a cylinder or a cone has one freedom along its line, from
// rim to rim or from apex to base; an ellipsoid has x alone. In A's frame, lengths in metres.

#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "poinsot/collision/collider.h"

namespace poinsot {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;
using Tangents = Eigen::Matrix<double, 3, 2>;  // two unit vectors perpendicular to a normal

class SurfacePatch {
 public:
  // The feature that faces m about the blend of up to three points of the core. R, c: the pose.
  SurfacePatch(const Collider& shape, const Mat3& R, const Vec3& c, std::span<const Vec3> points,
               std::span<const double> weights, const Vec3& m);

  void turn_to(const Vec3& m);  // unit
  const Vec3& point() const { return point_; }
  std::size_t freedoms() const { return freedoms_; }
  const Vec3& freedom(std::size_t k) const { return g_[k]; }
  // Change of the point as m turns by T δ, seen in T: symmetric, not negative.
  Mat2 curvature(const Tangents& T) const;

  // Moves along the freedoms; turn_to() must follow. Past an end the feature becomes what lies
  // there. Returns what m must lean by for that: not zero where a disc becomes its rim.
  Vec3 move(const Vec2& by);
  // Becomes the larger feature that holds the core's point `farther` too; false if it cannot.
  bool grow(const Vec3& farther);

 private:
  enum class Kind { kCorners, kPolygon, kRim, kDisc, kBarrel, kFunnel, kEllipsoid };

  void start_corners(std::span<const Vec3> points, std::span<const double> weights, double same);
  void start_polygon(const Feature& face, const Mat3& R);
  void start_round(std::span<const Vec3> points, std::span<const double> weights, const Vec3& m);
  void become_edge(const Vec3& from, const Vec3& to, double t);
  void become_rim(double side);
  void become_disc();
  void leave_polygon();
  void leave_triangle();

  Kind kind_ = Kind::kCorners;
  std::size_t freedoms_ = 0;
  std::array<Vec3, 2> g_;  // [m]
  Vec2 t_ = Vec2::Zero();
  Vec3 base_ = Vec3::Zero();   // [m] x, where it does not depend on m
  Vec3 point_ = Vec3::Zero();  // [m]

  Feature face_;                  // the polygon
  Vec3 center_;                   // [m]
  Vec3 axis_ = Vec3::Zero();      // unit; of a round shape
  Vec3 across_ = Vec3::Zero();    // unit; of m across the axis
  Vec3 leaning_ = Vec3::Zero();   // part of m across the axis, for a disc
  double radius_ = 0, half_ = 0;  // [m] and half the length
  double side_ = 1;               // of the rim or disc on the axis
  double bend_ = 0;               // [m] radius by which the rim's point turns with m
  bool is_cone_ = false;
  Mat3 from_ball_;    // [m] the unit ball becomes the ellipsoid
  Vec3 ball_;         // unit: of the point
  double width_ = 0;  // [m] of the ellipsoid's support
};

}  // namespace poinsot
