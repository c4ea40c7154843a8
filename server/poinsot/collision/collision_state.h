// What the parts of the collision layer share: the bodies' shapes, their courses, the boxes that
// they cannot leave, and the pairs that may meet. Islands work on it at the same time; each touches
// its own bodies and records only.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/collision/pair_store.h"
#include "poinsot/simulation/simulation_layer.h"

namespace poinsot {

struct CollisionState {
  explicit CollisionState(const Scene& scene);

  const World& world() const { return simulation.world(); }
  bool is_awake(Eigen::Index i) const {
    return world().moves(i) && asleep[static_cast<std::size_t>(i)] == 0;
  }
  std::span<const Collider> colliders_of(Eigen::Index i) const;

  // Changes from outside. A body that comes has no pairs and no boxes yet; from one that goes the
  // records of its pairs are dropped; with springs, as SimulationLayer::remove() says.
  Eigen::Index add(const BodyDef& body);
  bool remove(Eigen::Index i);
  void set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity);

  // The body's course is another one from now on: what was found out about its pairs is void.
  void change_course(Eigen::Index i) { ++stamp[static_cast<std::size_t>(i)]; }
  // The course of a body that is at body_time, until `to` at least.
  const Course& course(Eigen::Index i, double to, bool in_contact, SimulationWorker& worker);
  // Where the body is at t on its course, or at body_time = t.
  MovingPose moving_pose(Eigen::Index i, double t, bool in_contact, SimulationWorker& worker);
  // Moves a body on to t, if it is not there yet.
  void bring(Eigen::Index i, double t, SimulationWorker& worker, Tally& tally);

  // All that a continuation depends on; what follows from the scene is left out.
  template <class Archive>
  void archive(Archive& with);

  // [m] gap below which a pair touches.
  double touch(const PairRecord& record) const;

  CollisionDef def;
  SimulationLayer simulation;
  std::vector<Collider> colliders;        // in body order
  std::vector<int> first_collider;        // per body, and the end
  std::vector<double> arm;                // [m] per body: no point of its shapes is farther from c
  std::vector<std::uint8_t> has_corners;  // per body: some shape of it
  std::vector<double> least_size;         // [m] per body: of its shapes
  PairStore pairs;

  // Per body.
  std::vector<std::uint32_t> stamp;  // of its course
  std::vector<double> body_time;     // [s] its state's
  std::vector<Course> courses;
  std::vector<std::uint32_t> course_stamp;  // that courses[i] is of; 0: none yet
  std::vector<double> bounds_until;         // [s] that its boxes hold; for ever if it is at rest
  std::vector<std::uint8_t> asleep;

  std::vector<Aabb> bound;  // per collider: it stays inside until bounds_until, but for impacts

 private:
  void measure_shapes(Eigen::Index i);
  void begin_anew(Eigen::Index i);
};

// The colliders of all bodies of a scene, in body order, and those of one.
std::vector<Collider> make_colliders(const Scene& scene);
std::vector<Collider> make_colliders(Eigen::Index column, const BodyDef& body);

// Pose of a collider of a body whose centre of mass is at `pose`, in W.
inline Pose collider_pose(const Collider& collider, const Pose& pose) {
  return pose * collider.in_body;
}

}  // namespace poinsot
