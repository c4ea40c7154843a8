// What two bodies do when they meet: whether they collide, with which friction and restitution.
//
// The materials say it, friction by the geometric mean and restitution by the maximum, unless the
// scene has an entry in `pairs`. Bodies are columns, their places in the scene. A body that is in
// no entry costs one look-up in a table, others a binary search among the entries; a scene without
// entries nothing. Symmetric; questions do not allocate and are thread-safe.
//
// Entries name bodies: they hold for whoever has these names. Bodies come and go.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot {

struct PairRule {
  double friction = 0;     // [-]
  double restitution = 0;  // [-]
  bool collide = true;
};

class PairRules {
 public:
  PairRules() = default;
  explicit PairRules(const Scene& scene);  // of a valid scene

  // The body of an absent column or of the next one; a body that goes.
  void add(Eigen::Index column, const BodyDef& body);
  void remove(Eigen::Index column);

  bool collide(Eigen::Index a, Eigen::Index b) const {
    if (entries_.empty()) return true;
    const PairRule* entry = find(a, b);
    return entry == nullptr || entry->collide;
  }
  PairRule rule(Eigen::Index a, Eigen::Index b) const;

 private:
  struct Entry {
    std::uint64_t bodies;  // the lower column above, the higher below
    PairRule rule;
  };
  struct Named {
    PairDef def;
    Eigen::Index a = kNobody, b = kNobody;  // who has these names
  };
  static constexpr Eigen::Index kNobody = -1;

  const PairRule* find(Eigen::Index a, Eigen::Index b) const;
  Entry entry_of(const Named& named) const;

  std::vector<Material> materials_;  // of the bodies
  std::vector<bool> is_named_;       // bodies: in an entry
  std::vector<Named> named_;         // entries of the scene
  std::vector<Entry> entries_;       // of those whose bodies are both there, sorted by bodies
};

}  // namespace poinsot
