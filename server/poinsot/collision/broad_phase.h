// Broad phase: which colliders may meet.
//
// Each collider has a box that holds all it can reach until its box is set again. Pairs are those
// of colliders of different bodies whose boxes overlap and of which at least one moves; half-spaces
// have no box and pair with the boxes that reach under their plane. The pairs, exact and sorted,
// depend on the boxes alone, never on how they came to be. Asking again costs nothing if no box was
// set since, and little if few were.

#pragma once

#include <span>
#include <vector>

#include "poinsot/collision/box_tree.h"
#include "poinsot/collision/pair_list.h"

namespace poinsot {

class BroadPhase {
 public:
  // All boxes empty: they meet nothing. All colliders move but half-spaces.
  explicit BroadPhase(std::span<const Collider> colliders);

  // All that collider i can reach until its box is set again [m], in W; ignored for a half-space.
  // A box with a number that is not finite is taken as empty and false is returned.
  bool set(int i, const Aabb& box);

  // Colliders that do not move do not pair among one another.
  void set_moves(int i, bool moves);

  // The half-space i holds the points x with normal·x <= offset [m], in W. Until it is set, it
  // holds all. With a number that is not finite it holds nothing and false is returned.
  bool set_plane(int i, const Vec3& normal_W, double offset_W);

  // Sorted by (a, b). Valid until called again.
  std::span<const ColliderPair> pairs();

 private:
  struct Plane {
    int collider;
    Vec3 normal;    // in W
    double offset;  // [m]
  };

  void touch(int i);
  void find_under_planes(bool all);
  void find_under(const Plane& plane, int i);

  std::vector<int> body_;  // per collider
  BoxTree tree_;           // of all colliders; half-spaces stay empty
  std::vector<Plane> planes_;
  std::vector<int> plane_of_;           // per collider: index in planes_; -1: it has a box
  std::vector<unsigned char> touched_;  // per collider: to be paired anew
  std::vector<int> which_;              // those touched
  PairList list_;
};

}  // namespace poinsot
