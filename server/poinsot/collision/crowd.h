// The crowd: bodies whose contacts are stepped by soft_step (../contact/soft_step.h), the islands
// of all of them at once.
//
// An island joins the crowd for a frame if the scene asks for it, or if `auto` finds it accurate
// enough there, or too large for anything else. Pairs of the crowd are not searched for impacts:
// their points foresee them, and bodies that would move by more than half their size between two
// looks at what is near are looked at more often, or, with `auto`, stay out of the crowd.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/parallel.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/collision/island.h"
#include "poinsot/contact/soft_step.h"

namespace poinsot {

class Crowd {
 public:
  explicit Crowd(const CollisionState& state);

  // Whether a body was in the crowd in the last frame, or always is.
  bool has(Eigen::Index i) const { return member_[static_cast<std::size_t>(i)] != 0; }
  void set_member(Eigen::Index i, bool member);

  // What the shapes of body i may touch before `h` [s] have passed; whether its boxes hold that.
  bool look(const CollisionState& state, Eigen::Index i, double h);
  // A box for a collider of such a body that is likely to last for some frames.
  Aabb roomy_box(const CollisionState& state, const Collider& collider, double h) const;
  // Whether a pair may touch in this frame; one body at least is in the crowd and was looked at.
  bool is_near(const CollisionState& state, const PairRecord& record) const;

  // Whether an island is stepped with the crowd in the frame that begins.
  bool takes(const CollisionState& state, const Island& island, double duration) const;

  struct Result {
    Tally tally;
    SoftOutcome outcome;       // sums, and the worst residual
    std::uint32_t bodies = 0;  // stepped
  };
  // Moves the bodies of these islands from the world's time to t_end.
  Result advance(CollisionState& state, std::span<Island* const> islands, double t_end, Team& team);

  // The forces of a pair of the crowd in the last sub-step.
  void add_forces(const CollisionState& state, const PairRecord& record,
                  std::vector<ContactForce>& forces) const;

 private:
  int parts(const CollisionState& state, double duration);
  void gather_bodies(const CollisionState& state, std::span<Island* const> islands);
  void measure(CollisionState& state, double h, Team& team);
  void fill(CollisionState& state, Team& team);
  void recall(CollisionState& state);
  int local(const CollisionState& state, int column);
  void place_immovable(const CollisionState& state, int i, double h);
  double travel(const CollisionState& state, Eigen::Index i, const Vec3& omega, double h) const;
  void scatter(CollisionState& state, Result& result);

  std::vector<std::uint8_t> member_;    // per body
  std::vector<std::uint8_t> may_step_;  // per body: nothing acts on it that soft_step does not know
  std::vector<Aabb> near_;              // per collider of a body looked at
  // Of the bodies that take part, where the step is.
  std::vector<Pose> pose_;             // per collider
  std::vector<double> travel_;         // [m] per body: no point of it moves farther in the step
  std::vector<std::uint64_t> placed_;  // per body that nothing moves: the step it was placed in
  std::uint64_t step_ = 0;

  SoftStep solver_;
  double last_h_ = 0;                  // [s] of a sub-step
  double now_ = 0;                     // [s] where the step is
  std::vector<Eigen::Index> columns_;  // bodies that move, in the order of the islands
  std::vector<int> local_;             // per column; −1: none
  std::vector<int> immovable_;         // columns among the bodies of the solver
  std::vector<SoftBody> bodies_;
  std::vector<int> records_;  // of the islands
  std::vector<int> active_;   // records that have points
  std::vector<SoftManifold> manifolds_;
};

}  // namespace poinsot
