// What two bodies do when they meet: whether they collide, with which friction and restitution.
//
// The materials say it, friction by the geometric mean and restitution by the maximum, unless the
// scene has an entry in `pairs`. Bodies are columns, their places in the scene. A body that is in
// no entry costs one look-up in a table, others a binary search among the entries; a scene without
// entries nothing. Symmetric, does not allocate, thread-safe.

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
  const PairRule* find(Eigen::Index a, Eigen::Index b) const;

  std::vector<Material> materials_;  // of the bodies
  std::vector<bool> is_named_;       // bodies: in an entry
  std::vector<Entry> entries_;       // sorted by bodies
};

}  // namespace poinsot
