// The pairs of colliders that may meet, and what is known of each: that it is apart until some
// time, that it touches, where, and with which impulses. Sorted, whatever their history.

#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "poinsot/base/check.h"
#include "poinsot/base/hash.h"
#include "poinsot/collision/broad_phase.h"
#include "poinsot/collision/crowd_contact.h"
#include "poinsot/collision/impact_search.h"
#include "poinsot/collision/manifold.h"

namespace poinsot {

// One point of a pair that touches or nearly touches.
struct PairPoint {
  Vec3 position;                         // [m] in W, midway between the surfaces
  Vec3 normal;                           // unit, in W, from b to a
  Vec3 anchor_a, anchor_b;               // [m] the same point on either surface, in its frame S
  Vec3 normal_in_a;                      // in the frame S of a
  Vec3 offset;                           // [m] from the mover's centre of mass, in W
  double gap = 0;                        // [m]
  double approach = 0;                   // [m/s] at which it was coming when it was slowed
  double normal_impulse = 0;             // [N·s] of the last sub-step
  Vec3 friction_impulse = Vec3::Zero();  // [N·s] in W

  template <class Archive>
  void archive(Archive& with) {
    with(position, normal, anchor_a, anchor_b, normal_in_a, offset, gap, approach, normal_impulse,
         friction_impulse);
  }
};

struct PairContact {
  std::vector<PairPoint> points, last;
  double last_h = 0;   // [s] sub-step of the impulses
  Pose measured;       // of B's shape in A's frame when the points were last found …
  double margin = -1;  // [m] … and the margin they were found with; < 0: never
  mutable std::uint64_t digest = 0;  // of all of it that a continuation depends on; 0: to be formed

  template <class Archive>
  void archive(Archive& with) {
    with(points, last_h, measured, margin);
  }
};

// What all pairs are asked for in every frame comes first, in one line of the cache.
struct alignas(64) PairRecord {
  ColliderPair pair;
  int a = 0, b = 0;  // bodies
  double size = 0;   // [m] the smaller collider's
  double friction = 0, restitution = 0;
  int contact = -1;        // index into contacts; -1: never near
  int crowd_contact = -1;  // index into crowd contacts; -1: never near
  bool standing = false;   // touches, and lasts: stepped, not searched
  bool idle = false;       // of a body in the crowd, and apart for this frame
  bool by_crowd = false;   // its forces are those of the crowd contact

  // No root of the gap before `safe_until`, on the courses with these stamps; `meeting` tells what
  // is then.
  Meeting meeting = Meeting::none;
  std::uint32_t stamp_a = 0, stamp_b = 0;
  double safe_until = -std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero(), point = Vec3::Zero();
  SearchMemory memory;
};

class PairStore {
 public:
  explicit PairStore(std::size_t bodies) : first_(bodies + 1, 0) {}

  // Takes over a sorted list. New records are made by `make`; pairs for which it returns false are
  // left out. Those of the old list that go on keep all they know.
  template <class Make>
  void update(std::span<const ColliderPair> pairs, const Make& make) {
    next_.clear();
    std::size_t old = 0;
    for (const ColliderPair& pair : pairs) {
      while (old < records_.size() && records_[old].pair < pair) drop(records_[old++]);
      if (old < records_.size() && records_[old].pair == pair) {
        next_.push_back(records_[old++]);
        continue;
      }
      PairRecord record;
      record.pair = pair;
      if (make(record)) next_.push_back(record);
    }
    while (old < records_.size()) drop(records_[old++]);
    std::swap(records_, next_);
    index();
  }

  std::span<PairRecord> records() { return records_; }
  std::span<const PairRecord> records() const { return records_; }
  PairRecord* find(const ColliderPair& pair);
  PairRecord& operator[](int i) { return records_[static_cast<std::size_t>(i)]; }
  // Indices of the records of a body, ascending.
  std::span<const int> of(Eigen::Index body) const {
    const auto k = static_cast<std::size_t>(body);
    return {of_.data() + first_[k], of_.data() + first_[k + 1]};
  }

  // The contact of a record: made when it is first asked for, not by two threads at once.
  PairContact& contact(PairRecord& record) {
    POINSOT_ASSERT(record.contact >= 0);
    return contacts_[static_cast<std::size_t>(record.contact)];
  }
  const PairContact* find_contact(const PairRecord& record) const {
    return record.contact < 0 ? nullptr : &contacts_[static_cast<std::size_t>(record.contact)];
  }
  // Gives each of these records a contact.
  void make_contact(PairRecord& record);

  // The same for the contacts of the crowd.
  CrowdContact& crowd_contact(const PairRecord& record) {
    return crowd_contacts_[static_cast<std::size_t>(record.crowd_contact)];
  }
  const CrowdContact& crowd_contact(const PairRecord& record) const {
    return crowd_contacts_[static_cast<std::size_t>(record.crowd_contact)];
  }
  void make_crowd_contact(PairRecord& record);

  // Nothing of what happened to the pair until now counts any more.
  void forget(PairRecord& record);

  // Bodies come and go. One more body; `count` new colliders take the numbers from `first` on, and
  // those that had them the next; so many colliders go, with their records.
  void add_body() { first_.push_back(first_.back()); }
  void insert_colliders(int first, int count);
  void erase_colliders(int first, int count);

  void hash_into(Hash64& hash) const;
  // The records and what they know; contacts are packed anew in their order.
  template <class Archive>
  void archive(Archive& with, std::span<const Collider> colliders);

 private:
  void drop(const PairRecord& record);
  template <class Archive>
  void archive_record(Archive& with, PairRecord& record);
  void index();

  std::vector<PairRecord> records_, next_;
  std::vector<PairContact> contacts_;
  std::vector<int> free_;
  std::vector<CrowdContact> crowd_contacts_;
  std::vector<int> free_crowd_;
  std::vector<int> first_, of_;
};

}  // namespace poinsot
