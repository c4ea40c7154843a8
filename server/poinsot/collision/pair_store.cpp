#include "poinsot/collision/pair_store.h"

#include <algorithm>

namespace poinsot {

PairRecord* PairStore::find(const ColliderPair& pair) {
  const auto found = std::lower_bound(
      records_.begin(), records_.end(), pair,
      [](const PairRecord& record, const ColliderPair& p) { return record.pair < p; });
  return found != records_.end() && found->pair == pair ? &*found : nullptr;
}

void PairStore::make_contact(PairRecord& record) {
  if (record.contact >= 0) return;
  if (free_.empty()) {
    record.contact = static_cast<int>(contacts_.size());
    contacts_.emplace_back();
    PairContact& contact = contacts_.back();
    contact.points.reserve(Manifold::kMaxPoints);
    contact.last.reserve(Manifold::kMaxPoints);
    return;
  }
  record.contact = free_.back();
  free_.pop_back();
}

void PairStore::make_crowd_contact(PairRecord& record) {
  if (record.crowd_contact >= 0) return;
  if (free_crowd_.empty()) {
    record.crowd_contact = static_cast<int>(crowd_contacts_.size());
    crowd_contacts_.emplace_back();
    return;
  }
  record.crowd_contact = free_crowd_.back();
  free_crowd_.pop_back();
  crowd_contact(record) = {};
}

void PairStore::drop(const PairRecord& record) {
  if (record.crowd_contact >= 0) free_crowd_.push_back(record.crowd_contact);
  if (record.contact < 0) return;
  PairContact& contact = contacts_[static_cast<std::size_t>(record.contact)];
  contact.points.clear();
  contact.last.clear();
  contact.last_h = 0;
  contact.margin = -1;
  contact.measured = {};
  contact.digest = 0;
  free_.push_back(record.contact);
}

void PairStore::forget(PairRecord& record) {
  drop(record);
  PairRecord fresh;
  fresh.pair = record.pair;
  fresh.a = record.a;
  fresh.b = record.b;
  fresh.size = record.size;
  fresh.friction = record.friction;
  fresh.restitution = record.restitution;
  record = fresh;
}

void PairStore::insert_colliders(int first, int count) {
  for (PairRecord& record : records_)
    for (int* collider : {&record.pair.a, &record.pair.b})
      if (*collider >= first) *collider += count;
}

void PairStore::erase_colliders(int first, int count) {
  const auto goes = [&](int collider) { return collider >= first && collider < first + count; };
  const std::size_t before = records_.size();
  std::erase_if(records_, [&](const PairRecord& record) {
    if (!goes(record.pair.a) && !goes(record.pair.b)) return false;
    drop(record);
    return true;
  });
  insert_colliders(first + count, -count);
  if (records_.size() != before) index();
}

void PairStore::index() {
  std::fill(first_.begin(), first_.end(), 0);
  for (const PairRecord& record : records_) {
    ++first_[static_cast<std::size_t>(record.a) + 1];
    ++first_[static_cast<std::size_t>(record.b) + 1];
  }
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  of_.resize(2 * records_.size());
  for (std::size_t i = records_.size(); i-- > 0;)
    for (const int body : {records_[i].a, records_[i].b})
      of_[static_cast<std::size_t>(--first_[static_cast<std::size_t>(body) + 1])] =
          static_cast<int>(i);
  // Filled from behind, each start has come down to where its body's records begin.
  for (std::size_t k = 0; k + 1 < first_.size(); ++k) first_[k] = first_[k + 1];
  first_.back() = static_cast<int>(of_.size());
}

namespace {

std::uint64_t digest_of(const PairContact& contact) {
  Hash64 hash;
  hash.add(contact.last_h);
  hash.add(contact.margin);
  for (const double x : contact.measured.c) hash.add(x);
  for (const double x : contact.measured.q.coeffs()) hash.add(x);
  for (const PairPoint& point : contact.points) {
    hash.add(point.normal_impulse);
    for (const double x : point.friction_impulse) hash.add(x);
    for (const Vec3* v : {&point.offset, &point.anchor_a, &point.anchor_b, &point.normal_in_a})
      for (const double x : *v) hash.add(x);
    hash.add(point.approach);
  }
  return hash.value() | 1;
}

// What the last search for an impact found, and where the next one begins.
std::uint64_t digest_of_search(const PairRecord& record) {
  Hash64 hash;
  hash.add(static_cast<std::uint64_t>(record.pair.a) << 32 |
           static_cast<std::uint32_t>(record.pair.b));
  hash.add(record.safe_until);
  hash.add(static_cast<std::uint64_t>(record.meeting));
  for (const double x : record.memory.axis) hash.add(x);
  if (record.meeting == Meeting::none) return hash.value();
  for (const Vec3* v : {&record.normal, &record.point})
    for (const double x : *v) hash.add(x);
  return hash.value();
}

}  // namespace

void PairStore::hash_into(Hash64& hash) const {
  for (const PairRecord& record : records_) {
    if (!record.standing && (record.safe_until > -std::numeric_limits<double>::infinity() ||
                             !record.memory.axis.isZero(0)))
      hash.add(digest_of_search(record));
    const PairContact* contact = find_contact(record);
    if (record.crowd_contact >= 0) {
      hash.add(static_cast<std::uint64_t>(record.pair.a) << 32 |
               static_cast<std::uint32_t>(record.pair.b));
      Hash64 contact_hash;  // does not wait for those before it
      crowd_contact(record).hash_into(contact_hash);
      hash.add(contact_hash.value());
    }
    if (!record.standing && (contact == nullptr || contact->points.empty())) continue;
    hash.add(static_cast<std::uint64_t>(record.pair.a) << 32 |
             static_cast<std::uint32_t>(record.pair.b));
    hash.add(static_cast<std::uint64_t>(record.standing ? 1 : 0));
    if (contact == nullptr) continue;
    if (contact->digest == 0) contact->digest = digest_of(*contact);
    hash.add(contact->digest);
  }
}

}  // namespace poinsot
