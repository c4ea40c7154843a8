// The contacts of a world: which bodies touch or may touch before the sub-step ends, and what their
// contacts remember from one sub-step to the next.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/collision/broad_phase.h"
#include "poinsot/collision/manifold.h"
#include "poinsot/contact/contact.h"
#include "poinsot/simulation/motion_bound.h"

namespace poinsot {

// What lasts about a contact beside its impulses.
struct ContactMemory {
  ColliderPair pair;
  Vec3 offset;          // [m] of the point from the moving body's centre of mass, in W
  double size;          // [m] the smaller body's: what relative tolerances are relative to
  double approach = 0;  // [m/s] speed at which the pair was coming when it was slowed to arrive
};

class ContactSet {
 public:
  ContactSet(const Scene& scene, const World& world);

  // Finds all points that may touch within the next h, in pair order. A point that continues one of
  // the last call keeps its impulses, scaled to h, and its approach.
  void find(const World& world, double h);

  // Whether any two bodies may come within the contact margin in the next h.
  bool may_meet(const World& world, double h);
  // No contacts: what find() would leave if nothing met.
  void forget();

  std::span<Contact> contacts() { return contacts_; }
  std::span<const Contact> contacts() const { return contacts_; }
  std::span<ContactMemory> memories() { return memories_; }

  // Adds what the next find() depends on.
  void hash_into(Hash64& hash) const;

 private:
  void place(const World& world, double h);
  bool may_touch(const ColliderPair& pair) const;
  bool reaches(const Aabb& box, std::size_t half_space) const;
  void add(const World& world, const ColliderPair& pair, const Manifold& manifold);
  void recall(double h);

  CollisionDef def_;
  std::vector<Material> materials_;  // per body
  std::vector<Collider> colliders_;
  BroadPhase broad_phase_;
  SpeedBounds speeds_;

  // Per collider, for the sub-step at hand.
  std::vector<Pose> poses_;     // of S in W
  std::vector<double> travel_;  // [m] at most, within h
  std::vector<double> reach_;   // [m] for which the broad phase is asked to last
  std::vector<Aabb> boxes_;     // tight, grown by travel and margin

  std::vector<Contact> contacts_, last_contacts_;
  std::vector<ContactMemory> memories_, last_memories_;
  double last_h_ = 0;  // [s]
};

// The colliders of all bodies of a scene, in body order.
std::vector<Collider> make_colliders(const Scene& scene);

}  // namespace poinsot
