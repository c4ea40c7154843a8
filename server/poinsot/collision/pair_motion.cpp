#include "poinsot/collision/pair_motion.h"

#include <algorithm>
#include <cmath>

#include "poinsot/base/check.h"

namespace poinsot {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Normals are known to about this [rad], and with them how fast shapes that slide come nearer: of
// spheres, capsules and polyhedra, and of shapes with curved surfaces that have no closed form.
constexpr double kNormal = 1e-10;
constexpr double kCurvedNormal = 3e-6;

bool is_plane(const Collider& collider) {
  return std::holds_alternative<HalfSpace>(collider.shape);
}

}  // namespace

PairMotion::Side::Side(const Collider& collider_, const Course& course_)
    : collider(&collider_), course(&course_) {
  if (is_plane(collider_)) {
    r = ball = 0;
  } else {
    r = collider_.in_body.c.norm() + collider_.bounding_radius - collider_.core_radius;
    ball = r + collider_.core_radius;
  }
  if (!course->moves()) go_to(course->start());
}

void PairMotion::Side::go_to(double t) {
  now = course->moving_at(t);
  if (r == 0) return;
  R = (now.pose.q * collider->in_body.q).toRotationMatrix();
  offset = now.pose.q * collider->in_body.c;
}

double PairMotion::Side::speed() const {
  return now.velocity.linear.norm() + ball * now.velocity.angular.norm();
}

TurningCore PairMotion::Side::along(const Vec3& d, const Vec3& turn) const {
  TurningCore core;
  if (r == 0) return core;
  core.collider = collider;
  core.R = R;
  core.offset = offset;
  core.d = d;
  core.d_rate = d.cross(now.velocity.angular - turn);
  return core;
}

PairMotion::PairMotion(const CoursePair& pair, SearchWork& work)
    : swapped_(is_plane(pair.a)),
      has_plane_(swapped_ || is_plane(pair.b)),
      a_(swapped_ ? Side(pair.b, pair.course_b) : Side(pair.a, pair.course_a)),
      b_(swapped_ ? Side(pair.a, pair.course_a) : Side(pair.b, pair.course_b)),
      work_(&work),
      radii_(a_.collider->core_radius + b_.collider->core_radius),
      acceleration_(a_.course->acceleration() - b_.course->acceleration()),
      slack_(a_.course->slack() + b_.course->slack()),
      turning_(a_.course->rotation().omega + b_.course->rotation().omega),
      size_(std::min(a_.collider->size, b_.collider->size)) {
  ++work.searches;
  if (!has_plane_) return;
  POINSOT_CHECK(b_.course->rotation().omega == 0);
  const auto& plane = std::get<HalfSpace>(b_.collider->shape);
  const Pose in_W = b_.course->at(b_.course->start());
  plane_normal_ = in_W.q * (b_.collider->in_body.q * plane.normal);
  plane_offset_ = plane.offset + plane_normal_.dot(in_W.q * b_.collider->in_body.c);
}

void PairMotion::go_to(double t) {
  if (t == time_) return;
  time_ = t;
  ++work_->poses;
  if (a_.course->moves()) a_.go_to(t);
  if (b_.course->moves()) b_.go_to(t);
}

double PairMotion::next_time(double x) const {
  return time_ + std::max(x, 2 * kEpsilon * std::abs(time_) + std::numeric_limits<double>::min());
}

AxisBound PairMotion::bound_along(const Vec3& n) const {
  AxisBound bound;
  const double apart = n.dot(a_.now.pose.c - b_.now.pose.c) - plane_offset_;
  bound.z = apart - radii_;
  bound.v = n.dot(a_.now.velocity.linear - b_.now.velocity.linear);
  bound.central_z = apart - a_.ball - b_.ball;
  bound.central_c = bound.c = n.dot(acceleration_) - slack_;
  bound.a = a_.along(-n, Vec3::Zero());
  bound.b = b_.along(n, Vec3::Zero());
  if (!bound.a.collider && !bound.b.collider) return bound;
  for (const Side* side : {&a_, &b_})
    if (side->r > 0) bound.c -= side->r * side->course->rotation().turn_acceleration(n);
  bound.c = std::min(bound.c, 0.0);
  return bound;
}

AxisBound PairMotion::bound_turning(const Vec3& n, const Vec3& turn, double most) const {
  const Vec3 d = a_.now.pose.c - b_.now.pose.c;
  const Vec3 v = a_.now.velocity.linear - b_.now.velocity.linear;
  const double rate = turn.norm(), push = acceleration_.norm();
  const double speed = v.norm() + most * (push + slack_);  // [m/s] largest
  AxisBound bound;
  bound.z = n.dot(d) - radii_;
  bound.v = n.dot(v) + turn.cross(n).dot(d);
  bound.central_z = 0;
  bound.central_c = 0;
  bound.a = a_.along(-n, turn);
  bound.b = b_.along(n, turn);
  bound.c = n.dot(acceleration_) - push * std::min(2.0, rate * most) - slack_ -
            rate * (rate * (d.norm() + most * speed) + 2 * speed);
  for (const Side* side : {&a_, &b_}) {
    if (side->r == 0) continue;
    const RotationBound& rotation = side->course->rotation();
    const double relative = rate + rotation.omega;
    bound.c -= side->r * (relative * relative + rotation.alpha);
  }
  bound.c = std::min(bound.c, 0.0);
  return bound;
}

double PairMotion::balls_apart_until(double most) const {
  if (has_plane_ || slack_ > 0 || acceleration_ != Vec3::Zero()) return 0;
  const Vec3 d = a_.now.pose.c - b_.now.pose.c;
  const Vec3 v = a_.now.velocity.linear - b_.now.velocity.linear;
  const double speed = v.norm(), R = a_.ball + b_.ball;
  if (d.squaredNorm() <= R * R) return 0;
  if (speed == 0) return most;
  const Vec3 along = v / speed;
  const double ahead = -d.dot(along);              // [m] to where they are nearest
  const double pass = (d + ahead * along).norm();  // [m] apart there
  if (ahead <= 0 || pass >= R) return most;
  return std::min(most, (ahead - std::sqrt((R - pass) * (R + pass))) / speed);
}

double PairMotion::closing(double h) const {
  const double linear = (a_.now.velocity.linear - b_.now.velocity.linear).norm();
  return linear + h * (acceleration_.norm() + slack_) + a_.r * a_.course->rotation().omega +
         b_.r * b_.course->rotation().omega;
}

double PairMotion::closing_along(const Vec3& n, double h) const {
  const double linear = std::abs(n.dot(a_.now.velocity.linear - b_.now.velocity.linear));
  return linear + h * (std::abs(n.dot(acceleration_)) + slack_) +
         a_.r * a_.course->rotation().turn_rate(n) + b_.r * b_.course->rotation().turn_rate(n);
}

double PairMotion::rounding() const {
  const double where = a_.now.pose.c.norm() + b_.now.pose.c.norm() + a_.ball + b_.ball;
  return 4 * kEpsilon *
         (where + std::abs(plane_offset_) + std::abs(time_) * (a_.speed() + b_.speed()));
}

double PairMotion::rate_rounding() const {
  const bool curved = !has_plane_ && (a_.collider->is_curved || b_.collider->is_curved);
  return (curved ? kCurvedNormal : kNormal) * (a_.speed() + b_.speed());
}

}  // namespace poinsot
