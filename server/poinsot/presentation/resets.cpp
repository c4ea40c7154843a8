// PresentationLayer: back to the start, as a whole or in parts.

#include "poinsot/presentation/presentation_layer.h"

namespace poinsot {
namespace {

bool same(const Pose& a, const Pose& b) {
  return a.c == b.c && a.q.coeffs() == b.q.coeffs();
}

}  // namespace

void PresentationLayer::next_epoch() {
  ++epoch_;
  impacts_.clear();
  follow_scene();
  refresh();
}

void PresentationLayer::reset() {
  times_ = times();
  scene_.start_afresh();
  collision_ = CollisionLayer(scene());
  held_ = HeldWrenches(frame_rate(), held_.revision() + 1);
  frame_ = 0;
  impacts_so_far_ = 0;
  hold_scene_wrenches();
  next_epoch();
}

void PresentationLayer::reset(std::uint8_t scope) {
  const bool time = has_scope(scope, ResetScope::time);
  const bool state = has_scope(scope, ResetScope::state);
  const bool spawned = has_scope(scope, ResetScope::spawned);
  if (time && state && spawned) return reset();

  const auto bodies = static_cast<Eigen::Index>(scene().bodies.size());
  const auto is_there = [this](Eigen::Index i) {
    return !scene().bodies[static_cast<std::size_t>(i)].absent;
  };
  if (spawned)
    for (Eigen::Index i = 0; i < bodies; ++i)
      if (is_there(i) && !scene_.is_original(static_cast<std::size_t>(i))) remove_body(i);
  if (time)
    begin_again(state);
  else if (state)
    for (Eigen::Index i = 0; i < bodies; ++i)
      if (is_there(i)) return_to_start(i);
  if (state && !time) held_.release_all_clients();
  impacts_so_far_ = 0;
  next_epoch();
}

// A body of the scene file; static ones only if they were moved, so that nothing is woken for it.
void PresentationLayer::return_to_start(Eigen::Index i) {
  const auto place = static_cast<std::size_t>(i);
  if (!scene_.is_original(place)) return;
  const BodyDef& body = scene_.original().bodies[place];
  if (body.is_static && same(scene().bodies[place].pose, body.pose)) return;
  collision_.set_state(i, body.pose, {body.linear_velocity, body.angular_velocity});
  if (body.is_static) scene_.move_static(place, body.pose);
}

// From frame 0, with the bodies of the scene file as it says or all as they are now.
void PresentationLayer::begin_again(bool with_state) {
  for (Eigen::Index i = 0; i < world().size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const BodyDef& now = scene().bodies[place];
    if (now.absent) continue;
    if (with_state && scene_.is_original(place)) {
      const BodyDef& body = scene_.original().bodies[place];
      if (!body.is_static)
        scene_.set_start(place, body.pose, body.linear_velocity, body.angular_velocity);
      else if (!same(now.pose, body.pose))
        scene_.move_static(place, body.pose);
    } else if (!now.is_static) {
      scene_.set_start(place, body_pose(world(), i), linear_velocity(world(), i),
                       angular_velocity(world(), i));
    }
  }
  times_ = times();
  collision_ = CollisionLayer(scene());
  held_ = HeldWrenches(frame_rate(), held_.revision() + 1);
  frame_ = 0;
  hold_scene_wrenches();
}

}  // namespace poinsot
