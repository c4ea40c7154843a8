// What a client asks of the loop.

#include <cmath>
#include <string>

#include "poinsot/base/limits.h"
#include "poinsot/presentation/command_check.h"
#include "poinsot/presentation/value_check.h"
#include "poinsot/service/frame_loop.h"

namespace poinsot {
namespace {

// Slower than that a frame would take longer than anybody waits, and deadlines would not fit.
constexpr double kMinTimeScale = 1e-6;
// A time that is a whole number of frames up to rounding is that number.
constexpr double kFrameSlack = 1e-6;

std::string name_of(ControlAction action) {
  return std::string(name_of<ControlAction>(kControlActionNames, action));
}

// What ends a step or run_until that is under way. A restore does so when its checkpoint is there.
bool changes_course(ControlAction action) {
  return action == ControlAction::pause || action == ControlAction::resume ||
         action == ControlAction::reset || action == ControlAction::shutdown;
}

}  // namespace

std::optional<Refusal> FrameLoop::check(const RunControl& control) const {
  if (control.epoch != 0 && control.epoch != layer_.epoch())
    return Refusal{ResultCode::wrong_epoch, "meant for epoch " + std::to_string(control.epoch) +
                                                "; epoch " + std::to_string(layer_.epoch()) +
                                                " runs"};
  if (auto refusal = check_values(control)) return refusal;
  return check_state(control);
}

std::optional<Refusal> FrameLoop::check_values(const RunControl& control) const {
  if (control.seq == 0) return invalid("seq is 0: a client counts from 1");
  const auto action = static_cast<std::size_t>(control.action);
  if (action >= kControlActionNames.size())
    return invalid("action is " + std::to_string(action) + ": the largest known value is " +
                   std::to_string(kControlActionNames.size() - 1));
  switch (control.action) {
    case ControlAction::step:
      if (control.frames == 0 || control.frames > kMaxStepFrames)
        return invalid("frames is " + std::to_string(control.frames) + ": a step has 1 to " +
                       std::to_string(kMaxStepFrames));
      return std::nullopt;
    case ControlAction::run_until:
      if (!(control.value >= 0 && control.value <= kMaxRunTime))
        return invalid("value is " + std::to_string(control.value) +
                       ": a run goes until a time of 0 to 1e9 s");
      return std::nullopt;
    case ControlAction::scale:
      if (control.value != 0 && !(control.value >= kMinTimeScale && control.value <= kMaxTimeScale))
        return invalid("value is " + std::to_string(control.value) +
                       ": a time scale is 1e-6 to 1e6, or 0 for as fast as it can");
      return std::nullopt;
    case ControlAction::reset:
      return check_scope(control);
    case ControlAction::lock_step:
      if (control.timeout_ns < 0 || control.timeout_ns > kMaxLockStepNs)
        return invalid("timeout_ns is " + std::to_string(control.timeout_ns) +
                       ": lock step waits for up to an hour, or 0 to leave it");
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

std::optional<Refusal> FrameLoop::check_state(const RunControl& control) const {
  const auto not_now = [](std::string reason) {
    return Refusal{ResultCode::incorrect_state, std::move(reason)};
  };
  switch (control.action) {
    case ControlAction::step:
      if (!paused_) return not_now("the run is not paused: pause it first");
      [[fallthrough]];
    case ControlAction::run_until:
      if (goal_)
        return not_now("a " + name_of(goal_->control.action) + " is under way until frame " +
                       std::to_string(goal_->target));
      return std::nullopt;
    case ControlAction::lock_step:
      if (control.timeout_ns > 0 && !lock_step_.has(control.client) &&
          lock_step_.size() >= kMaxClients)
        return Refusal{ResultCode::quota_exceeded,
                       std::to_string(kMaxClients) + " clients are in lock step already"};
      return std::nullopt;
    case ControlAction::advance:
      if (!lock_step_.has(control.client)) return not_now("this client is not in lock step");
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

void FrameLoop::obey(const Order& order) {
  const RunControl& control = order.control;
  if (control.seq == kOwnSeq) return obey_release(order);
  if (const auto refusal = check(control)) return answer(control, refusal->code, refusal->reason);
  if (changes_course(control.action))
    end_goal(ResultCode::operation_failed, "ended early by " + name_of(control.action));
  switch (control.action) {
    case ControlAction::pause:
    case ControlAction::resume:
      paused_ = control.action == ControlAction::pause;
      return answer(control, ResultCode::ok, "");
    case ControlAction::step:
    case ControlAction::run_until:
      return begin_goal(control);
    case ControlAction::scale:
      return set_scale(control);
    case ControlAction::lock_step:
      return enter_lock_step(control);
    case ControlAction::advance:
      if (!lock_step_.offer(control))
        return answer(control, ResultCode::incorrect_state,
                      "the input for the next frame is complete already");
      return answered_.expect(control.client, control.seq);
    case ControlAction::record:
      return record(control);
    case ControlAction::shutdown:
      quit_ = true;
      return answer(control, ResultCode::ok, "");
    case ControlAction::release:
      return obey_release(order);
    case ControlAction::restore:
      return obey_restore(order);
    default:
      return obey_layer(order);
  }
}

// A run until a time that has passed is done at once.
void FrameLoop::begin_goal(const RunControl& control) {
  const std::uint64_t target =
      control.action == ControlAction::step
          ? layer_.frame() + control.frames
          : static_cast<std::uint64_t>(
                std::max(0.0, std::ceil(control.value * layer_.frame_rate() - kFrameSlack)));
  goal_ = Goal{control, target};
  answered_.expect(control.client, control.seq);
  paused_ = control.action == ControlAction::step || layer_.frame() >= target;
  if (layer_.frame() >= target) end_goal(ResultCode::ok, "");
}

void FrameLoop::end_goal(ResultCode code, const std::string& message) {
  if (!goal_) return;
  const RunControl control = goal_->control;
  goal_.reset();
  answer(control, code, message);
}

void FrameLoop::set_scale(const RunControl& control) {
  scale_ = control.value;
  if (scale_ > 0) clock_.set_rate(layer_.frame_rate() * scale_);
  begin_pace();
  answer(control, ResultCode::ok, "");
}

// Lock step --------------------------------------------------------------------------------------

void FrameLoop::enter_lock_step(const RunControl& control) {
  if (control.timeout_ns > 0)
    lock_step_.join(control.client, control.timeout_ns);
  else
    leave_lock_step(control.client, "ended early by lock_step");
  answer(control, ResultCode::ok, "");
}

void FrameLoop::leave_lock_step(std::uint64_t client, const std::string& why) {
  if (const auto advance = lock_step_.leave(client))
    send(reply_to(*advance, ResultCode::operation_failed, why));
}

// Without a report for each: there may be thousands a second.
void FrameLoop::answer_inputs(ResultCode code, const std::string& message) {
  if (lock_step_.empty()) return;
  lock_step_.take(inputs_);
  for (const RunControl& advance : inputs_) send(reply_to(advance, code, message));
}

// What the layer does ----------------------------------------------------------------------------

// Of a client that is gone, or that asks for it.
void FrameLoop::obey_release(const Order& order) {
  leave_lock_step(order.control.client, "ended early by release");
  recording_.note(order);
  const Reply reply = layer_.obey(order);
  if (order.control.seq == kOwnSeq) return;
  report();
  send(reply);
}

void FrameLoop::obey_layer(const Order& order) {
  const RunControl& control = order.control;
  const Reply reply = layer_.obey(order);
  recording_.note(order);
  const bool ok = reply.code == ResultCode::ok;
  const bool saves = control.action == ControlAction::save;
  if (ok && saves && control.on_disk) return save_to_disk(control, reply);
  if (ok && (control.action == ControlAction::reset || control.action == ControlAction::restore))
    begin_epoch(control.action);
  else if (ok && !saves)
    publish();
  report();
  send(reply);
}

// With the checkpoint that it means, so that a log of the run can be repeated without it.
void FrameLoop::obey_restore(const Order& order) {
  Order complete = order;
  if (!complete.checkpoint) complete.checkpoint = layer_.find_checkpoint(order.control.name);
  if (!complete.checkpoint && options_.store.read) return restore_from_disk(order.control);
  end_goal(ResultCode::operation_failed, "ended early by restore");
  if (complete.checkpoint)
    complete.checkpoint = with_threads(complete.checkpoint, layer_.scene().collision.threads);
  obey_layer(complete);
}

// A checkpoint may be of a scene with another one.
void FrameLoop::follow_frame_rate() {
  frame_rate_ = layer_.frame_rate();
  meter_ = PaceMeter(frame_rate_, SteadyTime::now());
  if (scale_ > 0) clock_.set_rate(frame_rate_ * scale_);
  begin_pace();
}

void FrameLoop::begin_epoch(ControlAction action) {
  epoch_ = layer_.epoch();
  if (layer_.frame_rate() != frame_rate_) follow_frame_rate();
  answer_inputs(ResultCode::operation_failed, "ended early by " + name_of(action));
  hand_over();
}

}  // namespace poinsot
