// An island: bodies that may meet before the frame ends, the pairs among them, and what happened to
// them. Bodies that do not move are in no island; a pair with one belongs to the other's.

#pragma once

#include <vector>

#include "poinsot/collision/collision_state.h"
#include "poinsot/collision/impact_event.h"

namespace poinsot {

struct Island {
  Island();  // with room for a few bodies, so that small islands come and go without allocating

  std::vector<Eigen::Index> bodies;  // awake, ascending; systems as a whole
  std::vector<int> records;          // ascending

  // What an advance of it adds.
  struct Result {
    Tally tally;
    double impact_loss = 0;      // [J]
    double push_out_energy = 0;  // [J]
    double max_penetration = 0;  // [m] in its last sub-step
    std::uint32_t contacts = 0;  // points that push, there
    std::uint32_t impacts = 0;   // located
    SearchWork work;
    bool solved = false;  // contacts were solved directly; of all these solves:
    double residual = 0;  // [m/s] the worst
    std::uint32_t iterations = 0, unconverged = 0;
    bool crowded = false;  // more impacts than it located
    std::vector<ImpactEvent> events;

    void clear();
  } result;

  // Why it stopped before the end: a body that an impact sends where others are, to be advanced
  // again together with them. Empty: it did not.
  std::vector<Eigen::Index> strays;

  // To go back to: as it was when the frame began.
  std::vector<SimulationLayer::Backup> bodies_before;
  std::vector<double> times_before;
  bool done = false;   // it reached the end of the frame
  bool fresh = false;  // it was not in the partition before
  bool crowd = false;  // stepped with the crowd
  std::vector<PairRecord> records_before;
  std::vector<PairContact> contacts_before;  // of records with a contact

  void save(const CollisionState& state);
  void restore(CollisionState& state) const;  // whatever has become of the order of the records
};

}  // namespace poinsot
