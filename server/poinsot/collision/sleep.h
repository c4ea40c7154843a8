// Sleep: islands in proven equilibrium are left alone until something changes.
//
// An island may sleep when nothing in it is faster than kSlow and it is getting slower: what rolls
// or creeps on evenly never does. It does sleep if its contacts, solved as if it were at rest, hold
// it: with every point strictly inside its friction cone and no acceleration above
// `sleep_acceleration`. It then has no velocity at all. It wakes as a whole: when a held wrench of
// one of its bodies changes, when something meets it, or when its state is changed from outside.

#pragma once

#include "poinsot/collision/islands.h"
#include "poinsot/simulation/held_wrench.h"

namespace poinsot {

class Sleep {
 public:
  explicit Sleep(std::size_t bodies);

  void fit(std::size_t bodies);
  // Body i, which is awake, begins anew.
  void forget(Eigen::Index i);

  // A frame is over.
  void next_frame() { ++frame_; }
  // Whether it is worth while to ask if the island is in equilibrium; now and then only.
  bool may_sleep(const CollisionState& state, const Island& island);
  // It is: its bodies fall asleep.
  void lay_down(CollisionState& state, const Island& island);
  // Wakes the group of a sleeping body.
  void wake(CollisionState& state, Eigen::Index i);
  // Wakes what was changed from outside since it fell asleep.
  void wake_changed(CollisionState& state);

  std::uint32_t asleep() const { return asleep_; }
  void hash_into(Hash64& hash) const;
  template <class Archive>
  void archive(Archive& with, const CollisionState& state);

 private:
  void lay_down(CollisionState& state, Eigen::Index i, int group);

  struct Before {
    Course::Column y = Course::Column::Zero();
    HeldWrench held;

    template <class Archive>
    void archive(Archive& with) {
      with(y, held);
    }
  };
  std::uint64_t frame_ = 0;
  std::vector<double>
      speed_;  // [m/s] per body: of its island, when it was last looked at; < 0: never
  std::vector<std::uint32_t> wait_;  // per body: of its island, after the last proof tried; 0: none
  std::vector<std::uint64_t> ask_again_;  // in that frame
  std::vector<int> group_of_;             // of a sleeping body: its first; −1 awake
  std::vector<int> next_;                 // in its group; −1: the last
  std::vector<Before> before_;
  std::uint32_t asleep_ = 0;
};

}  // namespace poinsot
