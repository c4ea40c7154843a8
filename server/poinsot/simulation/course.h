// The course of one body over a stretch of time, as a function: where it is and how fast at any
// moment of it, and rigorous bounds on how it accelerates and turns. What a search for impacts
// looks ahead with.
//
//   still    does not move
//   uniform  constant velocity and angular velocity: kinematic bodies
//   flight   closed form (flight.h)
//   driven   integrated from the start of the course to each moment asked for
//
// The centre of mass follows c(t) = c + v x + ½ a x² + rest, x = t − start, with |rest″| ≤ slack;
// slack is 0 but for driven bodies.

#pragma once

#include "poinsot/simulation/flight.h"
#include "poinsot/simulation/motion_bound.h"

namespace poinsot {

class SimulationLayer;
struct SimulationWorker;

struct MovingPose {
  Pose pose;  // of the centre of mass, in W
  Velocity velocity;
};

class Course {
 public:
  enum class Kind { still, uniform, flight, driven };
  using Column = Eigen::Matrix<double, 13, 1>;  // of a state
  // Who integrates a driven body's state, which it has at `from`, to each time asked for.
  struct Preview {
    SimulationLayer* layer = nullptr;
    SimulationWorker* worker = nullptr;
    double from = 0;  // [s]
    bool in_contact = false;
  };

  Course() = default;  // still, at the origin

  static Course still(const Pose& pose, double start, double end);
  static Course uniform(const Pose& pose, const Velocity& velocity, double start, double end);
  // `flight` lives as long as the course is used; `rotation` bounds it.
  static Course flight(const World& world, Eigen::Index body, const Flight& flight,
                       const RotationBound& rotation, double start, double end);
  // From the present state on. `acceleration` [m/s²] and its slack, and the bounds of rotation,
  // hold for the whole course.
  static Course driven(const World& world, Eigen::Index body, const Preview& preview,
                       const Vec3& acceleration, double slack, const RotationBound& rotation,
                       double start, double end);

  // start() ≤ t ≤ end().
  Pose at(double t) const;
  MovingPose moving_at(double t) const;

  // A driven body's course is integrated by this thread's means from now on.
  void use(SimulationWorker& worker) { preview_.worker = &worker; }
  // The flight has moved in memory.
  void use(const Flight& flight) { flight_ = &flight; }

  // All but whose it is: attach() says that, to one that was read.
  template <class Archive>
  void archive(Archive& with) {
    with.choice(kind_, Kind::driven);
    with(start_, end_);
    if (kind_ == Kind::still || kind_ == Kind::uniform) with(pose_);
    if (kind_ == Kind::uniform) with(velocity_);
    if (kind_ == Kind::driven) with(preview_.from, preview_.in_contact);
    if (kind_ != Kind::still) with(acceleration_, slack_, rotation_);
  }
  void attach(const World& world, Eigen::Index body, const Flight* flight, SimulationLayer* layer) {
    world_ = &world;
    body_ = body;
    flight_ = flight;
    preview_.layer = layer;
  }

  Kind kind() const { return kind_; }
  bool moves() const { return kind_ != Kind::still; }
  double start() const { return start_; }  // [s]
  double end() const { return end_; }      // [s]

  const Vec3& acceleration() const { return acceleration_; }  // a [m/s²]
  double slack() const { return slack_; }                     // [m/s²]
  const RotationBound& rotation() const { return rotation_; }

 private:
  Kind kind_ = Kind::still;
  double start_ = 0, end_ = 0;
  Pose pose_;  // of still and uniform ones
  Velocity velocity_;
  const World* world_ = nullptr;
  Eigen::Index body_ = 0;
  const Flight* flight_ = nullptr;
  Preview preview_;
  Vec3 acceleration_ = Vec3::Zero();
  double slack_ = 0;
  RotationBound rotation_;
};

}  // namespace poinsot
