#include "poinsot/presentation/presentation_layer.h"

#include <cmath>
#include <utility>

#include "poinsot/base/check.h"
#include "poinsot/presentation/scene_wrenches.h"

namespace poinsot {

PresentationLayer::PresentationLayer(Scene scene)
    : scene_(std::move(scene)), collision_(scene_), held_(frame_rate()) {
  for (Eigen::Index i = 0; i < world().size(); ++i)
    if (world().moves(i) || world().is_kinematic(i)) columns_.push_back(i);
  snapshot_.bodies.resize(columns_.size());
  body_methods_.resize(columns_.size(), Method::none);
  captured_asleep_.resize(columns_.size(), 0);
  hold_scene_wrenches();
  capture();
}

void PresentationLayer::accept(std::span<const WrenchCommand> commands,
                               std::vector<Reply>& replies) {
  if (commands.empty()) return;
  const Stopwatch::Lap lap(times_.presentation);
  held_.accept(commands, world(), frame_ + 1, epoch_, replies);
}

void PresentationLayer::advance_frame() {
  ++frame_;
  if (held_.changes(frame_)) held_.apply_to(collision_.world(), frame_);
  collision_.advance_to(static_cast<double>(frame_) / frame_rate());  // all physics is in here
  capture();
}

void PresentationLayer::reset() {
  times_ = times();
  collision_ = CollisionLayer(scene_);
  held_ = HeldWrenches(frame_rate());
  frame_ = 0;
  impacts_so_far_ = 0;
  captured_asleep_.assign(columns_.size(), 0);
  digests_ = {};
  ++epoch_;
  hold_scene_wrenches();
  capture();
}

void PresentationLayer::hold_scene_wrenches() {
  if (scene_.wrenches.empty()) return;
  std::vector<Reply> replies;
  held_.accept(scene_wrenches(scene_, world()), world(), frame_ + 1, epoch_, replies);
  for (const Reply& reply : replies) POINSOT_CHECK(reply.code == ResultCode::ok);  // validate()
}

void PresentationLayer::capture() {
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
  snapshot_.sim_time_ns = std::llround(static_cast<double>(frame_) * 1e9 / frame_rate());
  snapshot_.state_hash = state_hash(frame_, collision_, held_, digests_);

  capture_impacts();
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

// Not yet behind their doors.
Reply PresentationLayer::obey(const Order& order) {
  Reply reply;
  reply.client = order.control.client;
  reply.seq = order.control.seq;
  reply.epoch = epoch_;
  if (order.control.action == ControlAction::reset) {
    reset();
    reply.epoch = epoch_;
  } else {
    reply.code = ResultCode::feature_unsupported;
  }
  reply.first_frame = reply.last_frame = frame_;
  reply.state_hash = snapshot_.state_hash;
  return reply;
}
std::shared_ptr<const Checkpoint> PresentationLayer::make_checkpoint(std::string) const {
  return std::make_shared<Checkpoint>();
}
void PresentationLayer::restore(const Checkpoint&) {}
std::size_t PresentationLayer::checkpoints() const {
  return 0;
}
std::uint32_t PresentationLayer::scene_bodies() const {
  return static_cast<std::uint32_t>(scene_.bodies.size());
}
void PresentationLayer::contacts(ContactSnapshot& contacts) const {
  contacts.contacts.clear();
}
void PresentationLayer::held(HeldList& list) const {
  list.items.clear();
}
std::uint64_t PresentationLayer::held_revision() const {
  return 0;
}
std::uint32_t PresentationLayer::held_by(std::uint64_t) const {
  return 0;
}

LayerTimes PresentationLayer::times() const {
  LayerTimes times = times_;
  times.collision += collision_.times().collision;
  times.contact += collision_.times().contact;
  times.simulation += collision_.times().simulation;
  return times;
}

}  // namespace poinsot
