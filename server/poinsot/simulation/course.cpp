#include "poinsot/simulation/course.h"

#include "poinsot/math/elementary.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {
namespace {

Quat turned(const Quat& q, const Vec3& angle) {  // by the rotation vector `angle` [rad] in W
  const double length = angle.norm();
  if (length == 0) return q;
  const auto [sine, cosine] = sin_cos(0.5 * length);
  const Vec3 axis = (sine / length) * angle;
  return (Quat(cosine, axis.x(), axis.y(), axis.z()) * q).normalized();
}

Vec3 angular_velocity(const World& world, Eigen::Index i, const Quat& q, const Vec3& L) {
  return q * (world.inv_J_B[static_cast<std::size_t>(i)] * (q.conjugate() * L));
}

}  // namespace

Course Course::still(const Pose& pose, double start, double end) {
  Course course;
  course.start_ = start;
  course.end_ = end;
  course.pose_ = pose;
  return course;
}

Course Course::uniform(const Pose& pose, const Velocity& velocity, double start, double end) {
  Course course = still(pose, start, end);
  course.kind_ = Kind::uniform;
  course.velocity_ = velocity;
  const double omega = velocity.angular.norm();
  course.rotation_.omega = course.rotation_.along = omega;
  if (omega > 0) course.rotation_.axis = velocity.angular / omega;
  return course;
}

Course Course::flight(const World& world, Eigen::Index body, const Flight& flight,
                      const RotationBound& rotation, double start, double end) {
  Course course;
  course.kind_ = Kind::flight;
  course.start_ = start;
  course.end_ = end;
  course.world_ = &world;
  course.body_ = body;
  course.flight_ = &flight;
  course.acceleration_ = world.gravity;
  course.rotation_ = rotation;
  return course;
}

Course Course::driven(const World& world, Eigen::Index body, const Preview& preview,
                      const Vec3& acceleration, double slack, const RotationBound& rotation,
                      double start, double end) {
  Course course;
  course.kind_ = Kind::driven;
  course.start_ = start;
  course.end_ = end;
  course.world_ = &world;
  course.body_ = body;
  course.preview_ = preview;
  course.acceleration_ = acceleration;
  course.slack_ = slack;
  course.rotation_ = rotation;
  return course;
}

Pose Course::at(double t) const {
  switch (kind_) {
    case Kind::still:
      return pose_;
    case Kind::uniform:
      return {pose_.c + (t - start_) * velocity_.linear,
              turned(pose_.q, (t - start_) * velocity_.angular)};
    case Kind::flight:
      return flight_->pose(*world_, t);
    case Kind::driven:
      break;
  }
  const Column y = preview_.layer->preview(body_, preview_, t);
  return {y.head<3>(), Quat(y[6], y[3], y[4], y[5])};
}

MovingPose Course::moving_at(double t) const {
  switch (kind_) {
    case Kind::still:
    case Kind::uniform:
      return {at(t), velocity_};
    case Kind::flight: {
      const Pose pose = flight_->pose(*world_, t);
      return {pose,
              {flight_->linear_velocity(*world_, t),
               angular_velocity(*world_, body_, pose.q, flight_->angular_momentum())}};
    }
    case Kind::driven:
      break;
  }
  const Column y = preview_.layer->preview(body_, preview_, t);
  const Quat q(y[6], y[3], y[4], y[5]);
  return {{y.head<3>(), q},
          {world_->inv_mass[static_cast<std::size_t>(body_)] * y.segment<3>(7),
           angular_velocity(*world_, body_, q, y.tail<3>())}};
}

}  // namespace poinsot
