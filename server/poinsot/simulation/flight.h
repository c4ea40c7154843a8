// Flight: the motion of a body on which nothing acts but uniform gravity, exact at any later time.
//
// The centre of mass follows its parabola, the orientation is torque_free.h's; both are evaluated
// from where the flight began, so that errors do not add up over frames. A flight lasts until
// something else acts on the body.
//
//   position error     4 ε (|c₀| + |v₀| t + ½ g t²)
//   orientation error  TorqueFree::error(t)

#pragma once

#include "poinsot/base/hash.h"
#include "poinsot/simulation/local_error.h"
#include "poinsot/simulation/torque_free.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

class Flight {
 public:
  Flight() = default;

  // From the body's present state and the world's time on.
  Flight(const World& world, Eigen::Index i) : Flight(world, i, world.time) {}
  // From its present state on, which it has at time `start` [s].
  Flight(const World& world, Eigen::Index i, double start);

  // The state at time t: column i of y. L stays as it is, to the bit.
  void evaluate(const World& world, Eigen::Index i, double t, StateArray& y) const;

  // The same in parts: pose of the centre of mass [m], velocity [m/s], L [kg·m²/s]; in W.
  Pose pose(const World& world, double t) const;
  Vec3 linear_velocity(const World& world, double t) const {
    return v_ + (t - start_) * world.gravity;
  }
  const Vec3& angular_momentum() const { return L_; }

  // Largest error of the state at time t.
  LocalError error(const World& world, double t) const;

  // Adds where it began: all else follows from that.
  void hash_into(Hash64& hash) const;
  template <class Archive>
  void archive(Archive& with) {
    with(start_, c_, P_, v_, L_, q_, rotation_);
  }

 private:
  double start_ = 0;  // [s]
  Vec3 c_;            // [m]
  Vec3 P_;            // [kg·m/s]
  Vec3 v_;            // [m/s]
  Vec3 L_;            // [kg·m²/s]
  Quat q_;
  TorqueFree rotation_;
};

}  // namespace poinsot
