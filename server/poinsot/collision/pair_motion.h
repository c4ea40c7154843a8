// A pair of shapes, each on its course, at a time one chooses: what impact searches look at.
//
// A half-space, if there is one, is b here, whichever it was in the pair; its course does not turn.

#pragma once

#include "poinsot/collision/axis_bound.h"
#include "poinsot/collision/impact_search.h"

namespace poinsot {

class PairMotion {
 public:
  PairMotion(const CoursePair& pair, SearchWork& work);

  void go_to(double t);
  double time() const { return time_; }
  // x [s] later, and later by what a double can tell.
  double next_time(double x) const;

  const Collider& shape_a() const { return *a_.collider; }
  const Collider& shape_b() const { return *b_.collider; }
  Pose pose_a() const { return a_.now.pose * a_.collider->in_body; }  // of S in W
  const MovingPose& body_a() const { return a_.now; }
  const MovingPose& body_b() const { return b_.now; }
  Pose pose_b() const { return b_.now.pose * b_.collider->in_body; }
  bool is_swapped() const { return swapped_; }
  bool has_plane() const { return has_plane_; }
  const Vec3& plane_normal() const { return plane_normal_; }  // in W
  SearchWork& work() const { return *work_; }

  // Along a unit n in W, from b to a, at the time gone to.
  double gap_along(const Vec3& n) const { return bound_along(n).at(0); }
  AxisBound bound_along(const Vec3& n) const;
  // Along an axis that turns at `turn` ⟂ n [rad/s], in W; holds for x ≤ most.
  AxisBound bound_turning(const Vec3& n, const Vec3& turn, double most) const;

  // Longest proven x ≤ most for which the balls that hold the shapes do not meet [s].
  double balls_apart_until(double most) const;

  // Bounds over the whole course: of turning of both [rad/s], and of how fast any two points of
  // the pair come nearer between the time gone to and h later [m/s].
  double turning() const { return turning_; }
  double closing(double h) const;
  // The same of how fast the gap along n closes or opens, also within h before.
  double closing_along(const Vec3& n, double h) const;

  double size() const { return size_; }  // [m] the smaller
  // What gaps are known to [m], and their rates [m/s], now.
  double rounding() const;
  double rate_rounding() const;

 private:
  struct Side {
    const Collider* collider;
    const Course* course;
    double r;     // [m] of the core about the centre of mass; 0 if there is nothing to turn
    double ball;  // [m] of the shape about the centre of mass; 0 of a half-space
    MovingPose now;
    Mat3 R = Mat3::Identity();   // S → W
    Vec3 offset = Vec3::Zero();  // [m] of S from the centre of mass, in W

    Side(const Collider& collider, const Course& course);
    void go_to(double t);
    double speed() const;  // [m/s] largest now
    TurningCore along(const Vec3& d, const Vec3& turn) const;
  };

  bool swapped_, has_plane_;
  Side a_, b_;
  SearchWork* work_;
  double radii_;       // [m] swept about the cores
  Vec3 acceleration_;  // [m/s²] of a, seen from b
  double slack_, turning_, size_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  Vec3 plane_normal_ = Vec3::Zero();
  double plane_offset_ = 0;  // [m] along it from the body's centre of mass
};

}  // namespace poinsot
