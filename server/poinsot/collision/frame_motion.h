// One frame of the collision layer, from partition to commit.

#pragma once

#include "poinsot/base/parallel.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/collision/crowd.h"
#include "poinsot/collision/island_motion.h"
#include "poinsot/collision/islands.h"
#include "poinsot/collision/sleep.h"
#include "poinsot/scene/pair_rules.h"

namespace poinsot {

// An impact may give a body up to twice the speed at which it happens.
inline constexpr double kThrown = 2;

class FrameMotion {
 public:
  explicit FrameMotion(const Scene& scene);

  void advance_to(double t_end, CollisionReport& report, std::vector<ImpactEvent>& impacts,
                  CollisionTimes& times);

  void contact_forces(std::vector<ContactForce>& forces) const;
  void hash_into(Hash64& hash) const;
  // All that crosses frames; islands, steps and workers are scratch.
  template <class Archive>
  void archive(Archive& with);

  // Changes from outside, between frames (frame_changes.cpp).
  Eigen::Index spawn(const BodyDef& body);
  void remove(Eigen::Index i);
  void set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity);
  void kick(Eigen::Index i, const Wrench& impulse);

  void touch() { touched_ = true; }
  void set_tethers(std::span<const Tether> tethers);
  CollisionState& state() { return state_; }
  const CollisionState& state() const { return state_; }

 private:
  void settle_courses();
  void set_bounds(double t_end);
  void set_bound(Eigen::Index i, double until, double more);
  void place_box(const Collider& collider, const Aabb& box);
  void update_pairs();
  void find_excited(double t_end, SearchWork& work);
  void excite(Eigen::Index i, double t_end, double speed);
  void run_islands(double t_end, CollisionReport& report, CollisionTimes& times);
  void gather_strays(double t_end, int attempt);
  void place_frozen();
  void choose_crowd(double t_end);
  void gather_batches();
  void run_crowd(double t_end, CollisionReport& report, CollisionTimes& times);
  void put_to_sleep();
  bool touches_now(const PairRecord& record) const;
  void fly_the_rest(double t_end, Tally& tally);
  void close(double t_end, CollisionReport& report, std::vector<ImpactEvent>& impacts,
             const Tally& tally);
  void place(Eigen::Index i);
  void place_resting(Eigen::Index i);
  void show(const Collider& collider);
  void begin_anew(Eigen::Index i);
  void wake_around(Eigen::Index i);
  void wake_touched();
  void fit_to_shapes();

  CollisionState state_;
  Team team_;
  std::vector<IslandMotion> motions_;  // per thread
  BroadPhase broad_phase_;
  Islands islands_;
  Crowd crowd_;
  std::vector<CrowdStep> crowd_steps_;  // per thread
  std::vector<double> strain_;          // [-] per body, of the crowd's last step
  std::vector<Island*> crowd_islands_;
  struct Batch {  // of crowd_islands_, stepped together
    std::size_t first, count, bodies;
    CrowdStep::Result result;
  };
  std::vector<Batch> batches_;
  Team alone_{1};
  Sleep sleep_;
  PairRules rules_;
  std::vector<std::uint32_t> bounded_;  // stamp of the course that the boxes are of, per body
  std::vector<std::uint8_t> excited_;   // per body
  std::vector<double> fastest_;         // [m/s] per body: of its points; < 0: not asked for yet
  std::vector<double> thrown_;          // [m/s] per body: the speed that an impact may have
  std::vector<Eigen::Index> rest_, awake_, strays_, left_;
  std::vector<Tally> rest_tallies_;
  std::vector<std::uint8_t> tired_;  // per island
  bool boxes_changed_ = true;
  bool shapes_changed_ = false;      // of the state, since the broad phase and the crowd were made
  std::vector<Eigen::Index> moved_;  // bodies that came or were moved since the last frame
  bool touched_ = true;              // the world may have been changed from outside
  bool rests_ = false;               // nothing moves
};

}  // namespace poinsot
