#include "poinsot/collision/island.h"

namespace poinsot {

Island::Island() {
  constexpr std::size_t kBodies = 8, kRecords = 16;
  bodies.reserve(kBodies);
  records.reserve(kRecords);
  strays.reserve(kBodies);
  bodies_before.reserve(kBodies);
  times_before.reserve(kBodies);
  records_before.reserve(kRecords);
  contacts_before.resize(kRecords);
  for (PairContact& contact : contacts_before) {
    contact.points.reserve(Manifold::kMaxPoints);
    contact.last.reserve(Manifold::kMaxPoints);
  }
  result.events.reserve(kRecords);
}

void Island::Result::clear() {
  std::vector<ImpactEvent> kept;
  std::swap(kept, events);
  kept.clear();
  *this = Result{};
  std::swap(events, kept);
}

void Island::save(const CollisionState& state) {
  bodies_before.clear();
  times_before.clear();
  records_before.clear();
  for (const Eigen::Index i : bodies) {
    bodies_before.push_back(state.simulation.backup(i));
    times_before.push_back(state.body_time[static_cast<std::size_t>(i)]);
  }
  std::size_t contacts = 0;
  for (const int r : records) {
    const PairRecord& record = state.pairs.records()[static_cast<std::size_t>(r)];
    records_before.push_back(record);
    const PairContact* contact = state.pairs.find_contact(record);
    if (contact == nullptr) continue;
    if (contacts == contacts_before.size()) contacts_before.emplace_back();
    contacts_before[contacts++] = *contact;
  }
}

void Island::restore(CollisionState& state) const {
  if (bodies_before.size() != bodies.size()) return;  // it was never advanced
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    state.simulation.restore(bodies[k], bodies_before[k]);
    state.body_time[static_cast<std::size_t>(bodies[k])] = times_before[k];
    state.change_course(bodies[k]);
  }
  std::size_t contacts = 0;
  for (const PairRecord& before : records_before) {
    PairRecord* record = state.pairs.find(before.pair);
    const bool has_contact = before.contact >= 0;
    if (record != nullptr) {
      const int contact = record->contact, crowd_contact = record->crowd_contact;
      *record = before;
      record->contact = contact;
      record->crowd_contact = crowd_contact;
      record->safe_until = -std::numeric_limits<double>::infinity();
      if (has_contact) state.pairs.contact(*record) = contacts_before[contacts];
    }
    contacts += has_contact ? 1 : 0;
  }
}

}  // namespace poinsot
