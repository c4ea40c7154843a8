#include "poinsot/presentation/presentation_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/base/limits.h"
#include "poinsot/presentation/scene_wrenches.h"

namespace poinsot {
namespace {

std::int64_t sim_time_ns(std::uint64_t frame, double frame_rate) {
  return std::llround(static_cast<double>(frame) * 1e9 / frame_rate);
}

}  // namespace

PresentationLayer::PresentationLayer(Scene scene)
    : scene_(std::move(scene)), collision_(scene_.now()), held_(frame_rate()) {
  follow_scene();
  hold_scene_wrenches();
  refresh();
}

void PresentationLayer::accept(std::span<const WrenchCommand> commands,
                               std::vector<Reply>& replies) {
  if (commands.empty()) return;
  const Stopwatch::Lap lap(times_.presentation);
  held_.accept(commands, world(), frame_ + 1, epoch_, suggestions_, replies);
}

void PresentationLayer::begin_turn() {
  suggestions_ = {};
}

void PresentationLayer::advance_frame() {
  begin_turn();
  ++frame_;
  if (held_.changes(frame_)) held_.apply_to(collision_, frame_);
  collision_.advance_to(static_cast<double>(frame_) / frame_rate());  // all physics is in here
  held_.end_frame(frame_);
  capture();
}

void PresentationLayer::hold_scene_wrenches() {
  if (scene().wrenches.empty()) return;
  std::vector<Reply> replies;
  held_.accept(scene_wrenches(scene(), world()), world(), frame_ + 1, epoch_, suggestions_,
               replies);
  for (const Reply& reply : replies) POINSOT_CHECK(reply.code == ResultCode::ok);  // validate()
}

// Other bodies, or other ones in their places: nothing that was captured of them holds.
void PresentationLayer::follow_scene() {
  columns_.clear();
  const std::vector<BodyDef>& bodies = scene().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].absent && !bodies[i].is_static) columns_.push_back(static_cast<Eigen::Index>(i));
  snapshot_.bodies.resize(columns_.size());
  body_methods_.resize(columns_.size(), Method::none);
  captured_asleep_.assign(columns_.size(), 0);
  digests_ = {};
}

void PresentationLayer::capture() {
  capture_impacts();
  refresh();
}

void PresentationLayer::refresh() {
  const Stopwatch::Lap lap(times_.presentation);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Eigen::Index i = columns_[k];
    const std::uint32_t asleep = collision_.is_asleep(i) ? collision_.course_stamp(i) : 0;
    if (asleep != 0 && captured_asleep_[k] == asleep) continue;
    captured_asleep_[k] = asleep;
    const Pose pose = body_pose(world(), i);
    snapshot_.bodies[k] = {world().ids[static_cast<std::size_t>(i)], pose.c, pose.q,
                           linear_velocity(world(), i), angular_velocity(world(), i)};
  }
  snapshot_.epoch = epoch_;
  snapshot_.total = static_cast<std::uint32_t>(columns_.size());
  snapshot_.frame = frame_;
  snapshot_.sim_time_ns = sim_time_ns(frame_, frame_rate());
  snapshot_.state_hash = state_hash(frame_, collision_, held_, scene_.digest(), digests_);
  refresh_report();
}

void PresentationLayer::refresh_report() {
  const CollisionReport& collision = collision_.report();
  const SimulationLayer& simulation = collision_.simulation();
  const std::uint32_t quarantined = simulation.quarantined();
  const LocalError error = simulation.local_error();
  const EnergyBalance balance = collision_.energy_balance();
  report_ = {.frame = frame_,
             .sim_time = time(),
             .bodies = static_cast<std::uint32_t>(columns_.size()),
             .contacts = collision.contacts,
             .quarantined = quarantined,
             .islands = collision.islands,
             .restarts = collision.restarts,
             .impact_searches = collision.searches,
             .impacts = collision.impacts,
             .impacts_so_far = impacts_so_far_,
             .asleep = collision.asleep,
             .soft_bodies = collision.soft_bodies,
             .direct_bodies = collision.direct_bodies,
             .solver_iterations = collision.solver_iterations,
             .unconverged = collision.unconverged,
             .contact_residual = collision.contact_residual,
             .energy = balance.energy,
             .energy_error = balance.error,
             .push_out_energy = collision.push_out_energy,
             .max_penetration = collision.max_penetration,
             .position_error = error.position,
             .orientation_error = error.orientation,
             .momentum_error = simulation.momentum_error(),
             .flags = (quarantined > 0 ? FrameFlag::body_quarantined : FrameFlag::none) |
                      (simulation.is_stiff() ? FrameFlag::stiff : FrameFlag::none) |
                      (collision.crowded ? FrameFlag::crowded : FrameFlag::none)};
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Method method = simulation.methods()[static_cast<std::size_t>(columns_[k])];
    body_methods_[k] = method;
    ++report_.methods[static_cast<std::size_t>(method)];
  }
}

// Columns become handles: an outsider knows bodies by no other name.
void PresentationLayer::capture_impacts() {
  impacts_.clear();
  impacts_so_far_ += collision_.report().impacts;
  const auto id = [this](Eigen::Index i) { return world().ids[static_cast<std::size_t>(i)]; };
  for (const ImpactEvent& event : collision_.impacts())
    impacts_.push_back(
        {.epoch = epoch_,
         .frame = frame_,
         .time = event.time,
         .a = {id(event.a), event.v_a_before, event.w_a_before, event.v_a_after, event.w_a_after},
         .b = {id(event.b), event.v_b_before, event.w_b_before, event.v_b_after, event.w_b_after},
         .point = event.point,
         .normal = event.normal,
         .impulse = event.impulse});
}

void PresentationLayer::contacts(ContactSnapshot& contacts) const {
  contacts.epoch = epoch_;
  contacts.frame = frame_;
  contacts.sim_time_ns = snapshot_.sim_time_ns;
  collision_.contact_forces(contact_forces_);
  const std::size_t told = std::min(contact_forces_.size(), kMaxContacts);
  contacts.left_out = static_cast<std::uint32_t>(contact_forces_.size() - told);
  contacts.contacts.clear();
  const auto id = [this](int i) { return world().ids[static_cast<std::size_t>(i)]; };
  // The one that the force is told of moves.
  for (const ContactForce& c : std::span(contact_forces_).first(told))
    contacts.contacts.push_back(world().moves(c.a)
                                    ? ContactState{id(c.a), id(c.b), c.point, c.normal, c.force}
                                    : ContactState{id(c.b), id(c.a), c.point, -c.normal, -c.force});
}

void PresentationLayer::held(HeldList& list) const {
  list.epoch = epoch_;
  list.frame = frame_;
  held_.list(list, world());
}

LayerTimes PresentationLayer::times() const {
  LayerTimes times = times_;
  times.collision += collision_.times().collision;
  times.contact += collision_.times().contact;
  times.simulation += collision_.times().simulation;
  return times;
}

}  // namespace poinsot
