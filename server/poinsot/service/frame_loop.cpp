#include "poinsot/service/frame_loop.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace poinsot {
namespace {

// The longest [ns] that a paced run waits for a frame without looking into its inbox: a run that is
// slowed down answers nevertheless.
constexpr std::int64_t kDeaf = 100'000'000;

const WrenchCommand& identity(const WrenchCommand& command) {
  return command;
}
const RunControl& identity(const Order& order) {
  return order.control;
}
auto key(const auto& command) {
  return std::pair(identity(command).client, identity(command).seq);
}
// Where an order of the daemon's own stands among its client's: before what came after it.
std::uint64_t place(const WrenchCommand& command) {
  return command.seq;
}
std::uint64_t place(const Order& order) {
  return order.control.seq == kOwnSeq ? order.after + 1 : order.control.seq;
}
constexpr auto by_key = [](const auto& a, const auto& b) {
  return std::pair(identity(a).client, place(a)) < std::pair(identity(b).client, place(b));
};
constexpr auto same_key = [](const auto& a, const auto& b) { return key(a) == key(b); };

}  // namespace

FrameLoop::FrameLoop(PresentationLayer& layer, CommandInbox& inbox, Outbox& outbox,
                     Clients& clients, DiskWorker& disk, FrameLoopOptions options)
    : layer_(layer),
      inbox_(inbox),
      outbox_(outbox),
      clients_(clients),
      disk_(disk),
      options_(std::move(options)),
      clock_(SteadyTime{}, layer.frame_rate()),
      meter_(layer.frame_rate(), SteadyTime::now()),
      frame_rate_(layer.frame_rate()),
      scale_(options_.scale),
      paused_(options_.paused),
      epoch_(layer.epoch()) {
  replies_.reserve(CommandInbox::kWrenches);
  turn_replies_.reserve(CommandInbox::kWrenches + CommandInbox::kOrders);
  report_.body_methods.reserve(layer_.body_methods().size());
  report_.clients.reserve(kMaxClients);
}

void FrameLoop::run(const std::stop_token& stop) {
  SteadyTime::sharpen_sleeps();
  clock_ = FrameClock(SteadyTime{stop}, layer_.frame_rate());
  if (scale_ > 0) clock_.set_rate(layer_.frame_rate() * scale_);
  begin_pace();
  if (std::string fault; !options_.record.empty() && !begin_recording(options_.record, fault))
    record_failed_ = true;
  hand_over();
  report();
  if (is_unsaved()) autosave();  // the newest on disk is of this run from its beginning
  while (!over()) {
    const bool due = await_turn(stop);
    if (stop.stop_requested()) break;
    const std::int64_t began = SteadyTime::now();
    obey_inbox();
    if (due && !idle() && !over() && await_inputs(stop)) advance(began);
    overruns_ = clock_.overruns();
    autosave_now_and_then();
    report_now_and_then();
  }
  end_run();
}

// True if a frame is due.
bool FrameLoop::await_turn(const std::stop_token& stop) {
  const bool paced = !idle() && is_paced();
  if (paced && !was_paced_) begin_pace();
  was_paced_ = paced;
  if (paced) {
    if (!clock_.approach(kDeaf)) return false;
    clock_.wait();
  } else if (idle()) {
    inbox_.wait(stop, is_unsaved() ? last_autosave_ + options_.autosave_ns : INT64_MAX);
    meter_.restart(SteadyTime::now());
  }
  return true;
}

void FrameLoop::begin_pace() {
  clock_.restart();
  meter_.restart(SteadyTime::now());
}

// Until every client in lock step has said that its input is complete; not longer than the shortest
// of their time-outs. False: what came meanwhile stopped the run.
bool FrameLoop::await_inputs(const std::stop_token& stop) {
  if (lock_step_.ready()) return true;
  const std::int64_t began = SteadyTime::now();
  while (!lock_step_.ready()) {
    const std::int64_t deadline = began + lock_step_.timeout_ns();
    if (inbox_.wait(stop, std::min(deadline, last_report_ + kReportInterval))) {
      obey_inbox();
    } else if (stop.stop_requested()) {
      return false;
    } else if (SteadyTime::now() >= deadline) {
      ++late_inputs_;
      break;
    }
    autosave_now_and_then();
    report_now_and_then();
    if (idle() || over()) return false;
  }
  clock_.postpone(SteadyTime::now() - began);
  return true;
}

void FrameLoop::advance(std::int64_t began) {
  layer_.advance_frame();
  ++frames_;
  recording_.frame(layer_.frame(), layer_.snapshot().state_hash);
  outbox_.push(layer_.impacts());  // here only: another publish tells of the same frame
  hand_over();
  answer_inputs(ResultCode::ok, "");
  const std::int64_t now = SteadyTime::now();
  meter_.frame(now);
  if (is_paced()) meter_.paced(clock_.lateness(), now - began);
  if (goal_ && layer_.frame() >= goal_->target) {
    paused_ = true;
    end_goal(ResultCode::ok, "");
  }
}

void FrameLoop::hand_over() {
  publish();
  if (options_.each_frame) options_.each_frame(layer_);
}

void FrameLoop::publish() {
  publish_due_ = in_turn_;
  if (in_turn_) return;
  outbox_.push(scene_changes_.since_last(layer_));
  outbox_.push(layer_.snapshot());
  offer();
}

// What is made only while somebody wants it.
void FrameLoop::offer() {
  const auto now = std::pair(layer_.epoch(), layer_.frame());
  if (!outbox_.contacts_wanted()) {
    contacts_told_ = {};
  } else if (std::exchange(contacts_told_, now) != now) {
    layer_.contacts(contacts_);
    outbox_.swap_in(contacts_);
  }
  if (!outbox_.held_wanted()) {
    held_told_ = kNotTold;
  } else if (std::exchange(held_told_, layer_.held_revision()) != layer_.held_revision()) {
    layer_.held(held_);
    outbox_.swap_in(held_);
  }
}

void FrameLoop::obey_inbox() {
  inbox_.take(batch_);
  if (batch_.empty()) return offer();  // a nudge, perhaps
  for (const Reply& result : batch_.results) send(result);
  answer_known();
  layer_.begin_turn();
  recording_.begin_turn(layer_.frame() + 1, layer_.epoch());
  in_turn_ = true;
  // Orders split the pushes: what a client sent before its reset is not taken after it.
  std::span<const WrenchCommand> left = batch_.wrenches;
  for (const Order& order : batch_.orders) {
    const auto before = static_cast<std::size_t>(
        std::partition_point(left.begin(), left.end(),
                             [&](const auto& wrench) { return by_key(wrench, order); }) -
        left.begin());
    accept(left.first(before));
    left = left.subspan(before);
    obey(order);
  }
  accept(left);
  recording_.end_turn();
  tell_turn();
  if (idle()) offer();  // what is held may be another list
}

void FrameLoop::tell_turn() {
  in_turn_ = false;
  if (publish_due_) publish();
  if (std::exchange(report_due_, false)) report();
  for (const Reply& reply : turn_replies_) send(reply);
  turn_replies_.clear();
}

// Sorts the batch; what has been answered before is answered again and goes no further, nor does
// what is under way.
void FrameLoop::answer_known() {
  const auto settle = [&](auto& commands) {
    std::erase_if(commands, [&](const auto& command) {
      const auto& [client, seq] = key(command);
      const Reply* reply = answered_.find(client, seq);
      if (reply) outbox_.push(*reply);
      return reply != nullptr || answered_.is_under_way(client, seq);
    });
    std::stable_sort(commands.begin(), commands.end(), by_key);  // the first to arrive counts
    commands.erase(std::unique(commands.begin(), commands.end(), same_key), commands.end());
  };
  settle(batch_.wrenches);
  settle(batch_.orders);
  if (batch_.own.empty()) return;
  batch_.orders.insert(batch_.orders.begin(), std::make_move_iterator(batch_.own.begin()),
                       std::make_move_iterator(batch_.own.end()));
  std::stable_sort(batch_.orders.begin(), batch_.orders.end(), by_key);
}

void FrameLoop::accept(std::span<const WrenchCommand> commands) {
  if (commands.empty()) return;
  recording_.note(commands);
  replies_.clear();
  layer_.accept(commands, replies_);
  for (const Reply& reply : replies_) send(reply);
}

// Every command gets its reply, those that came too late to act as well.
void FrameLoop::end_run() {
  const std::string why = "the daemon ends";
  end_goal(ResultCode::operation_failed, why);
  answer_inputs(ResultCode::operation_failed, why);
  std::shared_ptr<CommandLogWriter> log = recording_.end();
  disk_.stop();  // what waits for it is done, and answered below
  log.reset();
  refuse_rest();
  report(RunState::quitting);
}

void FrameLoop::refuse_rest() {
  const std::string why = "the daemon ends";
  inbox_.take(batch_);
  for (const Reply& result : batch_.results) send(result);
  answer_known();
  for (const Order& order : batch_.orders)
    if (order.control.seq != kOwnSeq)
      send(reply_to(order.control, ResultCode::operation_failed, why));
  RunControl late;
  for (const WrenchCommand& command : batch_.wrenches) {
    late.client = command.client;
    late.seq = command.seq;
    send(reply_to(late, ResultCode::operation_failed, why));
  }
}

}  // namespace poinsot
