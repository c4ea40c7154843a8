#include "poinsot/collision/islands.h"

#include <algorithm>
#include <utility>

namespace poinsot {

Islands::Islands(std::size_t bodies) : parent_(bodies, 0), island_of(bodies, kNone) {
  constexpr std::size_t kReady = 8;  // without allocating when they first come up
  islands_.resize(std::min(bodies, kReady));
  before_.resize(std::min(bodies, kReady));
}

void Islands::fit(std::size_t bodies) {
  parent_.resize(bodies, 0);
  island_of.resize(bodies, kNone);
}

int Islands::root(int body) {
  while (parent_[static_cast<std::size_t>(body)] != body) {
    int& up = parent_[static_cast<std::size_t>(body)];
    up = parent_[static_cast<std::size_t>(up)];
    body = up;
  }
  return body;
}

// The lesser body is the root: numbers follow the order of the bodies.
void Islands::join(int a, int b) {
  const int root_a = root(a), root_b = root(b);
  if (root_a < root_b) {
    parent_[static_cast<std::size_t>(root_b)] = root_a;
  } else {
    parent_[static_cast<std::size_t>(root_a)] = root_b;
  }
}

void Islands::partition(CollisionState& state, std::span<const std::uint8_t> excited, bool anew) {
  std::swap(islands_, before_);
  std::swap(island_of, before_of_);
  count_before_ = anew ? 0 : count_;
  island_of.assign(before_of_.size(), kNone);
  if (!anew)
    for (std::size_t k = 0; k < count_before_; ++k)
      if (!before_[k].done) before_[k].restore(state);
  number(state, excited);
  if (count_ > 0) fill(state);
}

void Islands::number(const CollisionState& state, std::span<const std::uint8_t> excited) {
  const World& world = state.world();
  const auto n = static_cast<int>(parent_.size());
  for (int i = 0; i < n; ++i) parent_[static_cast<std::size_t>(i)] = i;
  const auto is_excited = [&](int i) { return excited[static_cast<std::size_t>(i)] != 0; };
  for (const PairRecord& record : state.pairs.records()) {
    if (record.idle || (!is_excited(record.a) && !is_excited(record.b))) continue;
    if (state.is_awake(record.a) && state.is_awake(record.b)) join(record.a, record.b);
  }
  for (const BodySystem& system : world.systems)
    for (const Eigen::Index i : system.columns)
      join(static_cast<int>(system.columns[0]), static_cast<int>(i));

  // A body is in an island if its root has an excited body.
  std::vector<int>& number_of = island_of;  // of roots, meanwhile
  count_ = 0;
  const auto open = [&](int i) {
    int& number = number_of[static_cast<std::size_t>(root(i))];
    if (number == kNone) number = 0;
  };
  for (const PairRecord& record : state.pairs.records()) {
    if (record.idle || (!is_excited(record.a) && !is_excited(record.b))) continue;
    for (const int i : {record.a, record.b})
      if (state.is_awake(i)) open(i);
  }
  for (int i = 0; i < n; ++i) {  // roots come before what they lead
    const int r = root(i);
    int& number = number_of[static_cast<std::size_t>(i)];
    if (r != i) {
      number = state.is_awake(i) ? number_of[static_cast<std::size_t>(r)] : kNone;
    } else if (number != kNone) {
      number = static_cast<int>(count_++);
    }
  }
  for (int i = 0; i < n; ++i)
    if (!state.is_awake(i)) island_of[static_cast<std::size_t>(i)] = kNone;
}

void Islands::fill(CollisionState& state) {
  if (islands_.size() < count_) islands_.resize(count_);
  for (std::size_t k = 0; k < count_; ++k) {
    islands_[k].bodies.clear();
    islands_[k].records.clear();
    islands_[k].done = false;
  }
  for (std::size_t i = 0; i < island_of.size(); ++i)
    if (island_of[i] >= 0)
      islands_[static_cast<std::size_t>(island_of[i])].bodies.push_back(
          static_cast<Eigen::Index>(i));
  const std::span<PairRecord> records = state.pairs.records();
  for (std::size_t r = 0; r < records.size(); ++r) {
    const int a = island_of[static_cast<std::size_t>(records[r].a)];
    const int b = island_of[static_cast<std::size_t>(records[r].b)];
    const int owner = a >= 0 ? a : b;
    // A pair of two islands is apart for this frame, unless one of them is thrown out of its box.
    if (owner < 0 || records[r].idle || (a >= 0 && b >= 0 && a != b)) continue;
    const bool outsider = state.is_awake(records[r].a) && state.is_awake(records[r].b) && a != b;
    if (!outsider) islands_[static_cast<std::size_t>(owner)].records.push_back(static_cast<int>(r));
  }
  for (std::size_t k = 0; k < count_; ++k) {
    Island& island = islands_[k];
    int before = kNone;
    bool same = true;
    for (const Eigen::Index i : island.bodies) {
      const int old = count_before_ > 0 ? before_of_[static_cast<std::size_t>(i)] : kNone;
      same = same && old >= 0 && (before == kNone || old == before);
      before = old;
    }
    if (same && before >= 0 && before_[static_cast<std::size_t>(before)].done &&
        before_[static_cast<std::size_t>(before)].bodies.size() == island.bodies.size()) {
      std::swap(island.result, before_[static_cast<std::size_t>(before)].result);
      std::swap(island.bodies_before, before_[static_cast<std::size_t>(before)].bodies_before);
      std::swap(island.times_before, before_[static_cast<std::size_t>(before)].times_before);
      std::swap(island.records_before, before_[static_cast<std::size_t>(before)].records_before);
      std::swap(island.contacts_before, before_[static_cast<std::size_t>(before)].contacts_before);
      island.done = true;
      island.fresh = false;
      island.crowd = false;  // those of the crowd are not done yet
      continue;
    }
    for (const Eigen::Index i : island.bodies) {
      const int old = count_before_ > 0 ? before_of_[static_cast<std::size_t>(i)] : kNone;
      if (old < 0 || !before_[static_cast<std::size_t>(old)].done) continue;
      before_[static_cast<std::size_t>(old)].restore(state);
      before_[static_cast<std::size_t>(old)].done = false;
    }
    island.fresh = true;
    island.bodies_before.clear();
  }
}

}  // namespace poinsot
