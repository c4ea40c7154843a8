// Sleep: islands in proven equilibrium are left alone until something changes.
//
// An island sleeps when its contacts were solved to `sleep_acceleration` with every pushing point
// inside its friction cone, and nothing in it moves faster than that acceleration gives in a
// sub-step, for kFrames frames on end. It then has no velocity at all. It wakes as a whole: when a
// held wrench of one of its bodies changes, when something meets it, or when its state is changed
// from outside.

#pragma once

#include "poinsot/collision/islands.h"

namespace poinsot {

class Sleep {
 public:
  explicit Sleep(std::size_t bodies);

  // After a frame: islands that were at rest long enough fall asleep.
  void settle(CollisionState& state, const Island& island);
  // Wakes the group of a sleeping body.
  void wake(CollisionState& state, Eigen::Index i);
  // Wakes what was changed from outside since it fell asleep.
  void wake_changed(CollisionState& state);

  std::uint32_t asleep() const { return asleep_; }
  void hash_into(Hash64& hash) const;

 private:
  void lay_down(CollisionState& state, Eigen::Index i, int group);

  struct Before {
    Course::Column y = Course::Column::Zero();
    HeldWrench held;
  };
  std::vector<int> still_frames_;  // per body
  std::vector<int> group_of_;      // of a sleeping body: its first; −1 awake
  std::vector<int> next_;          // in its group; −1: the last
  std::vector<Before> before_;
  std::uint32_t asleep_ = 0;
};

}  // namespace poinsot
