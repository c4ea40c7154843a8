// Changes of the world between frames. Whom a change concerns is woken: at once those that touch
// what is moved or taken away, and when the next frame begins those that touch what came.

#include <algorithm>
#include <limits>

#include "poinsot/collision/frame_motion.h"

namespace poinsot {

Eigen::Index FrameMotion::spawn(const BodyDef& body) {
  const Eigen::Index i = state_.add(body);
  if (const auto n = static_cast<std::size_t>(state_.world().size()); n > bounded_.size()) {
    islands_.fit(n);
    sleep_.fit(n);
    strain_.resize(n, 0);
    bounded_.resize(n, 0);
    excited_.resize(n, 0);
    thrown_.resize(n, 0);
  }
  rules_.add(i, body);
  shapes_changed_ = true;
  begin_anew(i);
  return i;
}

void FrameMotion::remove(Eigen::Index i) {
  wake_around(i);
  if (state_.remove(i)) {
    const World& world = state_.world();
    for (IslandMotion& motion : motions_) motion.worker() = SimulationWorker(world);
    for (Eigen::Index j = 0; j < world.size(); ++j) crowd_.look_at_forces(world, j);
  }
  rules_.remove(i);
  shapes_changed_ = true;
  begin_anew(i);
}

void FrameMotion::set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity) {
  wake_around(i);
  state_.set_state(i, pose, velocity);
  begin_anew(i);
}

// Pairs that stand are looked at again: what the kick presses together meets, with an impact.
void FrameMotion::kick(Eigen::Index i, const Wrench& impulse) {
  if (!state_.world().moves(i)) return;  // frozen, if it was a dynamic one
  sleep_.wake(state_, i);
  state_.simulation.kick(i, impulse);
  state_.change_course(i);
  for (const int r : state_.pairs.of(i)) state_.pairs[r].standing = false;
  touched_ = true;
}

// Nothing is known of how body i came to be where it is.
void FrameMotion::begin_anew(Eigen::Index i) {
  sleep_.forget(i);
  crowd_.set_body(state_, i);
  strain_[static_cast<std::size_t>(i)] = 0;
  place(i);
  moved_.push_back(i);
  touched_ = true;
}

// The body, and those that sleep on it or beside it.
void FrameMotion::wake_around(Eigen::Index i) {
  sleep_.wake(state_, i);
  for (const int r : state_.pairs.of(i)) {
    const PairRecord& record = state_.pairs[r];
    const int other = record.a == i ? record.b : record.a;
    if (state_.asleep[static_cast<std::size_t>(other)] == 0) continue;
    if (record.standing || touches_now(record)) sleep_.wake(state_, other);
  }
}

void FrameMotion::wake_touched() {
  if (moved_.empty()) return;
  update_pairs();
  for (const Eigen::Index i : moved_) wake_around(i);
  moved_.clear();
  rests_ = false;
}

// Boxes for a body where it is now.
void FrameMotion::place(Eigen::Index i) {
  const World& world = state_.world();
  if (!world.moves(i) && !world.is_kinematic(i)) return place_resting(i);
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  for (const Collider& collider : state_.colliders_of(i))
    place_box(collider, bounds(collider, collider_pose(collider, pose)));
}

// A body that does not move: its boxes and its course hold for ever.
void FrameMotion::place_resting(Eigen::Index i) {
  const World& world = state_.world();
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  for (const Collider& collider : state_.colliders_of(i)) {
    const bool plane = std::holds_alternative<HalfSpace>(collider.shape);
    place_box(collider, plane ? Aabb{} : bounds(collider, collider_pose(collider, pose)));
  }
  state_.bounds_until[static_cast<std::size_t>(i)] = std::numeric_limits<double>::infinity();
  state_.body_time[static_cast<std::size_t>(i)] = world.time;
  state_.course(i, std::numeric_limits<double>::infinity(), false, motions_.front().worker());
  boxes_changed_ = true;
}

// Tells the broad phase of a collider's box.
void FrameMotion::show(const Collider& collider) {
  boxes_changed_ = true;
  if (shapes_changed_) return;  // it will be told of all
  const World& world = state_.world();
  const Eigen::Index i = collider.body;
  const auto k = static_cast<int>(&collider - state_.colliders.data());
  broad_phase_.set_moves(k, world.moves(i) || world.is_kinematic(i));
  const auto* plane = std::get_if<HalfSpace>(&collider.shape);
  if (plane == nullptr) {
    broad_phase_.set(k, state_.bound[static_cast<std::size_t>(k)]);
    return;
  }
  const Pose placed = collider_pose(collider, {position(world.y, i), orientation(world.y, i)});
  const Vec3 normal = placed.q * plane->normal;
  broad_phase_.set_plane(k, normal, plane->offset + normal.dot(placed.c));
}

// Whatever has a place for each collider.
void FrameMotion::fit_to_shapes() {
  shapes_changed_ = false;
  broad_phase_ = BroadPhase(state_.colliders);
  for (const Collider& collider : state_.colliders) show(collider);
  crowd_.fit_to_shapes(state_);
  for (CrowdStep& step : crowd_steps_) step.fit(state_);
}

}  // namespace poinsot
