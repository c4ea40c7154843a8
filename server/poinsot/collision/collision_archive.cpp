// What of the collision layer crosses frames, as bytes and back (base/archive.h).
//
// What follows from the scene, and what every frame makes anew before it looks at it, is left out:
// islands, steps, solvers and searches start from the records. The broad phase is built from the
// boxes: its pairs depend on nothing else.

#include <algorithm>

#include "poinsot/base/archive.h"
#include "poinsot/collision/frame_motion.h"

namespace poinsot {

template <class Archive>
void PairStore::archive_record(Archive& with, PairRecord& record) {
  bool near = record.contact >= 0, near_in_crowd = record.crowd_contact >= 0;
  with(record.pair.a, record.pair.b, record.size, record.friction, record.restitution,
       record.standing, record.idle, record.by_crowd);
  with.choice(record.meeting, Meeting::unsure);
  with(record.stamp_a, record.stamp_b, record.safe_until, record.normal, record.point,
       record.memory.axis, near, near_in_crowd);
  if constexpr (Archive::kReads) {
    if (near) make_contact(record);
    if (near_in_crowd) make_crowd_contact(record);
  }
  if (near) with(contacts_[static_cast<std::size_t>(record.contact)]);
  if (near_in_crowd) with(crowd_contacts_[static_cast<std::size_t>(record.crowd_contact)]);
}

template <class Archive>
void PairStore::archive(Archive& with, std::span<const Collider> colliders) {
  constexpr std::size_t kLeast = 100;  // bytes of a record
  std::size_t n = records_.size();
  with.count(n, kLeast);
  if constexpr (Archive::kReads) {
    contacts_.clear();
    crowd_contacts_.clear();
    free_.clear();
    free_crowd_.clear();
    records_.assign(n, {});
  }
  for (std::size_t k = 0; k < n; ++k) {
    PairRecord& record = records_[k];
    archive_record(with, record);
    if constexpr (Archive::kReads) {
      const ColliderPair pair = record.pair;
      const bool ordered = k == 0 || records_[k - 1].pair < pair;
      if (!ordered || pair.a < 0 || pair.a >= pair.b ||
          static_cast<std::size_t>(pair.b) >= colliders.size())
        with.fail();
      record.a = static_cast<int>(colliders[static_cast<std::size_t>(pair.a)].body);
      record.b = static_cast<int>(colliders[static_cast<std::size_t>(pair.b)].body);
      if (record.a == record.b) with.fail();
    }
  }
  if constexpr (Archive::kReads) index();
}

// Courses of other stamps are not looked at again.
template <class Archive>
void CollisionState::archive(Archive& with) {
  with(simulation);
  with.fixed(stamp);
  with.fixed(body_time);
  with.fixed(bounds_until);
  with.fixed(asleep);
  with.fixed(bound);
  for (std::size_t k = 0; k < courses.size(); ++k) {
    bool valid = course_stamp[k] == stamp[k];
    with(valid);
    if constexpr (Archive::kReads) course_stamp[k] = valid ? stamp[k] : 0;
    if (!valid) continue;
    with(courses[k]);
    if constexpr (Archive::kReads)
      if (!simulation.attach(courses[k], static_cast<Eigen::Index>(k))) with.fail();
  }
  pairs.archive(with, colliders);
}

// Sleeping bodies group by group, in order.
template <class Archive>
void Sleep::archive(Archive& with, const CollisionState& state) {
  std::vector<std::vector<int>> groups;
  if constexpr (!Archive::kReads) {
    for (std::size_t k = 0; k < group_of_.size(); ++k) {
      if (group_of_[k] != static_cast<int>(k)) continue;
      groups.emplace_back();
      for (int i = group_of_[k]; i >= 0; i = next_[static_cast<std::size_t>(i)])
        groups.back().push_back(i);
    }
  }
  with(frame_, groups);
  with.fixed(speed_);
  with.fixed(wait_);
  with.fixed(ask_again_);
  if constexpr (Archive::kReads) {
    std::fill(group_of_.begin(), group_of_.end(), -1);
    std::fill(next_.begin(), next_.end(), -1);
    asleep_ = 0;
    for (const std::vector<int>& group : groups)
      for (std::size_t k = 0; k < group.size(); ++k) {
        const auto i = static_cast<std::size_t>(group[k]);
        if (i >= group_of_.size() || group_of_[i] >= 0) with.fail();
        group_of_[i] = group[0];
        if (k > 0) next_[static_cast<std::size_t>(group[k - 1])] = group[k];
        ++asleep_;
      }
    if (!groups.empty()) before_.resize(speed_.size());
  }
  for (std::size_t k = 0; k < group_of_.size(); ++k) {
    if ((group_of_[k] >= 0) != (state.asleep[k] != 0)) ByteReader::fail();
    if (group_of_[k] >= 0) with(before_[k]);
  }
}

template <class Archive>
void Crowd::archive(Archive& with) {
  with(everybody_, frame_);
  with.fixed(member_);
  with.fixed(may_step_);
  with.fixed(forced_);
  with.fixed(promoted_);
}

template <class Archive>
void FrameMotion::archive(Archive& with) {
  const World& world = state_.world();
  const auto agree = [&](auto number) {
    const auto own = number;
    with(number);
    if (number != own) throw Error("checkpoint: it is of another scene");
  };
  for (const std::size_t n : {world.ids.size(), state_.colliders.size(), world.scene_systems})
    agree(n);
  for (const BodyId id : world.ids) agree(id.generation);
  with(state_);
  if constexpr (Archive::kReads) {
    fit_to_shapes();
    for (IslandMotion& motion : motions_) motion.worker().prepare(world);  // of tethers
  }
  sleep_.archive(with, state_);
  with(crowd_);
  with.fixed(strain_);
  with.fixed(bounded_);
  with(moved_);
  for (const Eigen::Index i : moved_)
    if (i < 0 || i >= world.size()) ByteReader::fail();
  with(boxes_changed_, touched_, rests_);
}

template void FrameMotion::archive(ByteWriter&);
template void FrameMotion::archive(ByteReader&);

}  // namespace poinsot
