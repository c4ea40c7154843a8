// Bodies over the sub-steps of a soft step: what moves them between the sweeps of contacts.
//
// A body that no impulse acted on follows its parabola; one with contacts moves on with the
// velocity that these left it. What contacts changed in one sub-step is their first guess in the
// next: the sum of a body's impulses is known without asking the contacts. Inertia that is not
// isotropic turns with the body: its free rotation is soft_rotation.h's.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "poinsot/contact/soft_kernels.h"
#include "poinsot/contact/soft_step.h"

namespace poinsot {

class SoftBodies {
 public:
  static constexpr std::size_t kPieceBodies = 128;  // worth handing to another thread

  // Then each piece is to be set.
  void start(std::span<const SoftBody> bodies, double h);
  void set(std::size_t piece, std::span<const SoftBody> bodies);
  void finish(std::span<SoftBody> bodies);

  std::size_t pieces() const { return (count_ + kPieceBodies - 1) / kPieceBodies; }
  // Of a piece's bodies, once per sub-step each.
  void take_forces(std::size_t piece);
  void move(std::size_t piece);

  // The one after the last stands for none.
  HotBody* hot() { return hot_.data(); }
  const HotBody* hot() const { return hot_.data(); }
  const SoftMass* masses() const { return masses_.data(); }
  bool moves(int k) const {
    return course_[static_cast<std::size_t>(k)].kind != Kind::kFixed &&
           course_[static_cast<std::size_t>(k)].kind != Kind::kEven;
  }
  // Its inertia in W changes as it turns …
  bool turns(int k) const { return course_[static_cast<std::size_t>(k)].kind == Kind::kTurning; }
  // … and has in the last sub-step.
  bool has_turned(int k) const { return course_[static_cast<std::size_t>(k)].has_turned; }
  // [J] of forces, and the change of kinetic energy, of all bodies.
  double work() const { return work_; }
  double kinetic_change() const { return kinetic_change_; }

 private:
  enum class Kind : std::uint8_t {
    kFixed,    // does not move
    kEven,     // moves evenly, whatever touches it
    kRound,    // inertia does not change as it turns
    kTurning,  // it does
  };
  struct alignas(64) Course {
    Lanes predicted_v, predicted_omega;  // with forces, without contacts
    Lanes kick_v, kick_omega;            // by forces, of a sub-step
    Kind kind;
    bool has_turned;
    int turning;  // index of its Turning
  };
  struct Turning {
    Quat q_0;
    Vec3 L, torque, synced_omega;
    Mat3 inv_J_B, J_B, J_W;
    double turned_angle;  // [rad] since J_W was computed
  };
  void add_torque_work(std::size_t k, bool free);
  void turn(std::size_t k);
  void sync(Turning& turning, const HotBody& hot) const;

  void set(std::size_t k, const SoftBody& body);

  double h_ = 0, work_ = 0, kinetic_change_ = 0;
  std::size_t count_ = 0;
  std::vector<HotBody> hot_;
  std::vector<SoftMass> masses_;
  std::vector<Course> course_;
  std::vector<Turning> turning_;
  std::vector<double> energy_, torque_work_;  // [J] of each body: kinetic at the start; of torques
};

}  // namespace poinsot
