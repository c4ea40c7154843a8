// One step of the crowd: finds where its pairs touch, hands bodies and contacts to soft_step
// (../contact/soft_step.h), and takes both back.
//
// Islands of the crowd are stepped some hundred bodies at a time, so that what a step needs stays
// near the processor, and by several threads; a larger island is one step that the whole team works
// at.
//
// A frame is one step, unless something in it moves by more than half its size: then what is near
// is looked at several times.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/parallel.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/collision/island.h"
#include "poinsot/contact/soft_step.h"

namespace poinsot {

// [-] What soft_step reaches in easy islands, relative to the size.
inline constexpr double kSoftTolerance = 1e-4;
// What is near is looked at anew before a body has moved by this much of its size; one that moves
// farther in a frame is fast.
inline constexpr double kLook = 0.5;

// One thread's means. Islands stepped at the same time by several of them share no body that moves.
class CrowdStep {
 public:
  explicit CrowdStep(const CollisionState& state) { fit(state); }

  // To bodies and shapes that came or went.
  void fit(const CollisionState& state);

  struct Result {
    Tally tally;
    SoftOutcome outcome;       // sums, and the worst residual
    std::uint32_t bodies = 0;  // stepped
  };
  // Moves the bodies of these islands, whose pairs have crowd contacts, from the world's time to
  // t_end. `strain` per body [-]: its deepest penetration at the start, relative to the pair's
  // size.
  Result advance(CollisionState& state, std::span<Island* const> islands, double t_end, Team& team,
                 std::span<double> strain);

  // The forces of a pair in the last sub-step.
  static void add_forces(const CollisionState& state, const PairRecord& record,
                         std::vector<ContactForce>& forces);

 private:
  int parts(const CollisionState& state, double duration);
  void gather_bodies(const CollisionState& state, std::span<Island* const> islands, Team& team);
  void measure(CollisionState& state, double h, Team& team);
  void measure(CollisionState& state, const PairRecord& record);
  void fill(CollisionState& state, Team& team);
  void fill(const CollisionState& state, const PairRecord& record, SoftManifold& m) const;
  void find_strain(std::span<double> strain) const;
  void recall(CollisionState& state, Team& team);
  int local(const CollisionState& state, int column);
  void place_immovable(const CollisionState& state, int i, double h);
  void scatter(CollisionState& state, Result& result, Team& team);

  // Of the bodies that take part, where the step is.
  std::vector<Pose> pose_;             // per collider
  std::vector<double> radius_;         // [m] per collider, about its origin: close together
  std::vector<double> travel_;         // [m] per body: no point of it moves farther in the step
  std::vector<std::uint64_t> placed_;  // per body that nothing moves: the step it was placed in
  std::uint64_t step_ = 0;

  SoftStep solver_;
  double sub_step_ = 0;                // [s]
  double now_ = 0, end_ = 0;           // [s] where the step begins and ends
  std::vector<Eigen::Index> columns_;  // bodies that move, in the order of the islands
  std::vector<int> local_;             // per column; −1: none
  std::vector<int> immovable_;         // columns among the bodies of the solver
  std::vector<SoftBody> bodies_;
  std::vector<int> records_;  // of the islands
  std::vector<int> active_;   // records that have points
  std::vector<SoftManifold> manifolds_;
};

}  // namespace poinsot
