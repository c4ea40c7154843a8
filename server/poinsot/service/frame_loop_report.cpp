// What the loop says: replies, and how the run goes.

#include <utility>

#include "poinsot/service/frame_loop.h"

namespace poinsot {
Reply FrameLoop::reply_to(const RunControl& control, ResultCode code,
                          const std::string& message) const {
  Reply reply;
  reply.client = control.client;
  reply.seq = control.seq;
  reply.epoch = layer_.epoch();
  reply.code = code;
  reply.message = message;
  reply.first_frame = reply.last_frame = layer_.frame();
  reply.state_hash = layer_.snapshot().state_hash;
  return reply;
}

void FrameLoop::answer(const RunControl& control, ResultCode code, const std::string& message) {
  report();
  send(reply_to(control, code, message));
}

void FrameLoop::send(const Reply& reply) {
  if (reply.seq != 0) answered_.insert(reply);  // seq 0 is nobody's
  if (in_turn_) return turn_replies_.push_back(reply);
  const bool accepted = reply.code == ResultCode::ok;
  ++(accepted ? accepted_ : refused_);
  clients_.count(reply.client, accepted);
  outbox_.push(reply);
}

void FrameLoop::report_now_and_then() {
  if (SteadyTime::now() - last_report_ >= kReportInterval) report();
}

void FrameLoop::report() {
  if (in_turn_) {
    report_due_ = true;
    return;
  }
  report(idle() ? RunState::paused : RunState::playing);
}

void FrameLoop::report(RunState state) {
  drop_failed_recording();
  last_report_ = SteadyTime::now();
  const auto flag = [this](bool raised, FrameFlag which) {
    if (raised) report_.frame.flags = report_.frame.flags | which;
  };
  const auto news = [](std::uint64_t count, std::uint64_t& told) {
    return count > std::exchange(told, count);
  };
  report_.epoch = layer_.epoch();
  report_.state = state;
  report_.frame = layer_.report();
  report_.commands_limited = clients_.limited();
  flag(news(inbox_.full(), full_told_), FrameFlag::inbox_full);
  flag(news(overruns_, overruns_told_), FrameFlag::overrun);
  flag(news(late_inputs_, late_inputs_told_), FrameFlag::input_late);
  flag(news(report_.commands_limited, limited_told_), FrameFlag::rate_limited);
  flag(std::exchange(record_failed_, false), FrameFlag::record_failed);
  const auto methods = layer_.body_methods();
  report_.body_methods.assign(methods.begin(), methods.end());
  report_.frame_rate = layer_.frame_rate();
  report_.time_scale = scale_;
  report_.real_time_factor = state == RunState::playing ? meter_.factor() : 0;
  report_.real_time_factor_window = state == RunState::playing ? meter_.window_factor() : 0;
  report_.lateness = meter_.lateness();
  report_.frame_time = meter_.frame_time();
  report_.scene_bodies = layer_.scene_bodies();
  report_.scene_revision = layer_.scene_revision();
  report_.state_hash = layer_.snapshot().state_hash;
  report_.overruns = overruns_;
  report_.commands_accepted = accepted_;
  report_.commands_refused = refused_ + inbox_.refused();
  report_.held_wrenches = static_cast<std::uint32_t>(layer_.held_count());
  report_.checkpoints = static_cast<std::uint32_t>(layer_.checkpoints());
  report_.late_inputs = late_inputs_;
  report_.recording = recording_.name();
  clients_.report(
      last_report_,
      [this](ClientStatus& client) {
        client.held = layer_.held_by(client.client);
        client.lock_step = lock_step_.has(client.client);
      },
      report_.clients);
  report_.times = layer_.times();
  outbox_.push(scene_changes_.since_last(layer_));  // before the report that counts it
  outbox_.push(report_);
}

}  // namespace poinsot
