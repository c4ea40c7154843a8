#include "poinsot/service/frame_loop.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace poinsot {
namespace {

constexpr std::chrono::milliseconds kReportInterval{200};
constexpr std::chrono::milliseconds kWindow{150};  // shorter ones are too noisy to tell a pace

constexpr auto by_key = [](const auto& a, const auto& b) {
  return std::tuple(a.client, a.seq) < std::tuple(b.client, b.seq);
};
constexpr auto same_key = [](const auto& a, const auto& b) {
  return std::tuple(a.client, a.seq) == std::tuple(b.client, b.seq);
};

}  // namespace

FrameLoop::FrameLoop(PresentationLayer& layer, CommandInbox& inbox, Outbox& outbox,
                     FrameLoopOptions options)
    : layer_(layer),
      inbox_(inbox),
      outbox_(outbox),
      options_(std::move(options)),
      paused_(options_.paused),
      epoch_(layer.epoch()) {
  replies_.reserve(CommandInbox::kCapacity);
  report_.body_methods.reserve(layer_.body_methods().size());
}

void FrameLoop::run(const std::stop_token& stop) {
  SteadyTime::sharpen_sleeps();
  FrameClock clock(SteadyTime{stop}, layer_.frame_rate());
  start_window();
  hand_over();
  report();
  while (!done()) {
    if (idle()) {
      inbox_.wait(stop);
      clock.restart();
      start_window();
    } else if (!options_.fast && !step_) {
      clock.wait();
    }
    if (stop.stop_requested()) break;
    const bool was_stepping = step_.has_value();
    obey_inbox();
    if (!idle()) advance();
    if (was_stepping && !step_) clock.restart();
    overruns_ = clock.overruns();
    report_now_and_then();
  }
  end_step(ResultCode::operation_failed, "the daemon ends");
  refuse_the_rest();
  report(RunState::quitting);
}

// Every command gets its reply, those that came too late to act as well.
void FrameLoop::refuse_the_rest() {
  inbox_.take(batch_);
  answer_known();
  for (const RunControl& control : batch_.controls)
    answer(control, ResultCode::operation_failed, "the daemon ends");
  for (const WrenchCommand& command : batch_.wrenches) {
    Reply reply;
    reply.client = command.client;
    reply.seq = command.seq;
    reply.epoch = layer_.epoch();
    reply.code = ResultCode::operation_failed;
    reply.message = "the daemon ends";
    send(reply);
  }
}

void FrameLoop::advance() {
  layer_.advance_frame();
  ++frames_;
  hand_over();
  if (step_ && layer_.frame() >= step_->target) end_step(ResultCode::ok, "");
}

void FrameLoop::hand_over() {
  outbox_.push(layer_.impacts());
  outbox_.push(layer_.snapshot());
  if (options_.each_frame) options_.each_frame(layer_);
}

// Commands -------------------------------------------------------------------------------------

void FrameLoop::obey_inbox() {
  inbox_.take(batch_);
  if (batch_.empty()) return;
  answer_known();
  // Controls split the pushes: what a client sent before its reset is not taken after it.
  std::span<const WrenchCommand> left = batch_.wrenches;
  for (const RunControl& control : batch_.controls) {
    const auto before = static_cast<std::size_t>(
        std::partition_point(left.begin(), left.end(),
                             [&](const auto& wrench) { return by_key(wrench, control); }) -
        left.begin());
    accept(left.first(before));
    left = left.subspan(before);
    obey(control);
  }
  accept(left);
}

// Sorts the batch; what has been answered before is answered again and goes no further.
void FrameLoop::answer_known() {
  const auto settle = [&](auto& commands) {
    std::erase_if(commands, [&](const auto& command) {
      const Reply* reply = answered_.find(command.client, command.seq);
      if (reply) outbox_.push(*reply);
      return reply != nullptr;
    });
    std::stable_sort(commands.begin(), commands.end(), by_key);  // the first to arrive counts
    commands.erase(std::unique(commands.begin(), commands.end(), same_key), commands.end());
  };
  settle(batch_.wrenches);
  settle(batch_.controls);
}

void FrameLoop::accept(std::span<const WrenchCommand> commands) {
  replies_.clear();
  layer_.accept(commands, replies_);
  for (const Reply& reply : replies_) send(reply);
}

std::optional<Refusal> FrameLoop::check(const RunControl& control) const {
  if (control.seq == 0)
    return Refusal{ResultCode::invalid_value, "seq is 0: a client counts from 1"};
  if (control.epoch != 0 && control.epoch != layer_.epoch())
    return Refusal{ResultCode::wrong_epoch, "meant for epoch " + std::to_string(control.epoch) +
                                                "; epoch " + std::to_string(layer_.epoch()) +
                                                " runs"};
  if (control.action > ControlAction::reset)
    return Refusal{ResultCode::invalid_value, "action is " +
                                                  std::to_string(static_cast<int>(control.action)) +
                                                  ": the largest known value is 3"};
  if (control.action != ControlAction::step) return std::nullopt;
  if (control.frames == 0 || control.frames > kMaxStepFrames)
    return Refusal{ResultCode::invalid_value, "frames is " + std::to_string(control.frames) +
                                                  ": a step has 1 to " +
                                                  std::to_string(kMaxStepFrames)};
  if (!paused_)
    return Refusal{ResultCode::incorrect_state, "the run is not paused: pause it first"};
  if (step_)
    return Refusal{ResultCode::incorrect_state,
                   "a step is under way until frame " + std::to_string(step_->target)};
  return std::nullopt;
}

void FrameLoop::obey(const RunControl& control) {
  if (step_ && same_key(step_->control, control)) return;  // sent again; answered when done
  if (const auto refusal = check(control)) return answer(control, refusal->code, refusal->reason);
  if (control.action == ControlAction::step) {
    step_ = Step{control, layer_.frame() + control.frames};
    return;
  }
  end_step(
      ResultCode::operation_failed,
      "ended early by " + std::string(name_of<ControlAction>(kControlActionNames, control.action)));
  if (control.action == ControlAction::reset) {
    layer_.reset();
    epoch_ = layer_.epoch();
    hand_over();
  } else {
    paused_ = control.action == ControlAction::pause;
  }
  answer(control, ResultCode::ok, "");
}

void FrameLoop::end_step(ResultCode code, const std::string& message) {
  if (!step_) return;
  const RunControl control = std::exchange(step_, std::nullopt)->control;
  answer(control, code, message);
}

void FrameLoop::answer(const RunControl& control, ResultCode code, const std::string& message) {
  Reply reply;
  reply.client = control.client;
  reply.seq = control.seq;
  reply.epoch = layer_.epoch();
  reply.code = code;
  reply.message = message;
  reply.first_frame = reply.last_frame = layer_.frame();
  reply.state_hash = layer_.snapshot().state_hash;
  report();
  send(reply);
}

void FrameLoop::send(const Reply& reply) {
  ++(reply.code == ResultCode::ok ? accepted_ : refused_);
  if (reply.seq != 0) answered_.insert(reply);  // seq 0 is nobody's
  outbox_.push(reply);
}

// Reports --------------------------------------------------------------------------------------

void FrameLoop::start_window() {
  window_start_ = Clock::now();
  frames_at_window_start_ = frames_;
}

void FrameLoop::report_now_and_then() {
  const Clock::time_point now = Clock::now();
  if (now - window_start_ >= kWindow) {
    const double wall = std::chrono::duration<double>(now - window_start_).count();
    const auto frames = static_cast<double>(frames_ - frames_at_window_start_);
    real_time_factor_ = frames / layer_.frame_rate() / wall;
    start_window();
  }
  if (now - last_report_ >= kReportInterval) report();
}

void FrameLoop::report() {
  report(paused_ ? RunState::paused : RunState::playing);
}

void FrameLoop::report(RunState state) {
  const std::uint64_t full = inbox_.full();
  report_.epoch = layer_.epoch();
  report_.state = state;
  report_.frame = layer_.report();
  if (full > full_at_last_report_)
    report_.frame.flags = report_.frame.flags | FrameFlag::inbox_full;
  if (overruns_ > overruns_at_last_report_)
    report_.frame.flags = report_.frame.flags | FrameFlag::overrun;
  const auto methods = layer_.body_methods();
  report_.body_methods.assign(methods.begin(), methods.end());
  report_.frame_rate = layer_.frame_rate();
  report_.real_time_factor = state == RunState::playing ? real_time_factor_ : 0;
  report_.scene_bodies = layer_.scene_bodies();
  report_.scene_revision = layer_.scene_revision();
  report_.state_hash = layer_.snapshot().state_hash;
  report_.overruns = overruns_;
  report_.commands_accepted = accepted_;
  report_.commands_refused = refused_ + inbox_.refused();
  report_.times = layer_.times();
  outbox_.push(report_);

  last_report_ = Clock::now();
  overruns_at_last_report_ = overruns_;
  full_at_last_report_ = full;
}

}  // namespace poinsot
