// The islands of a frame: bodies joined by pairs that may become contacts before it ends, and by
// springs. Bodies that nothing may happen to are in none.

#pragma once

#include "poinsot/collision/island.h"

namespace poinsot {

class Islands {
 public:
  explicit Islands(std::size_t bodies);

  void fit(std::size_t bodies);

  static constexpr int kNone = -1;

  // Joins the bodies of every record of an excited body, and systems that have one. Islands of the
  // last call that went to the end and have the same bodies stay done, with their results; the
  // others that went on are put back to where the frame began.
  void partition(CollisionState& state, std::span<const std::uint8_t> excited, bool anew);

  std::span<Island> all() { return {islands_.data(), count_}; }

 private:
  int root(int body);
  void join(int a, int b);
  void number(const CollisionState& state, std::span<const std::uint8_t> excited);
  void fill(CollisionState& state);

  std::vector<int> parent_;
  std::vector<Island> islands_, before_;
  std::size_t count_ = 0, count_before_ = 0;
  std::vector<int> before_of_;  // island of the last call, per body

 public:
  std::vector<int> island_of;  // per body
};

}  // namespace poinsot
