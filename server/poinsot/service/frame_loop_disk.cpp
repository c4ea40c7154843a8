// What a client asks of the loop that has to do with the disk: done by the disk worker, answered
// when it is done.

#include <exception>
#include <string>
#include <utility>

#include "poinsot/runner/store.h"
#include "poinsot/service/frame_loop.h"

namespace poinsot {

// Has the worker do it; the reply, in which the work may say what became of it, comes back through
// the inbox. What the work throws is the reason of a failure. False, and answered: no room.
bool FrameLoop::defer(const RunControl& control, std::function<void(Reply&)> work, Reply reply) {
  const auto job = [this, work = std::move(work), reply = std::move(reply)]() mutable {
    try {
      work(reply);
    } catch (const std::exception& error) {
      reply.code = ResultCode::operation_failed;
      reply.message = error.what();
    }
    if (reply.seq != 0) inbox_.push_result(std::move(reply));
  };
  if (disk_.post(job)) {
    answered_.expect(control.client, control.seq);
    return true;
  }
  answer_behind(control);
  return false;
}

void FrameLoop::answer_behind(const RunControl& control) {
  answer(control, ResultCode::operation_failed, "the disk is behind: try again later");
}

void FrameLoop::save_to_disk(const RunControl& control, Reply reply) {
  if (!options_.store.write)
    return answer(control, ResultCode::operation_failed,
                  "it is in memory, but the daemon keeps nothing on disk: it has no --data");
  report();
  defer(
      control,
      [write = options_.store.write, saved = layer_.last_saved()](Reply&) { write(*saved); },
      std::move(reply));
}

// The order comes back with its checkpoint.
void FrameLoop::restore_from_disk(const RunControl& control) {
  const auto work = [this, control, read = options_.store.read](Reply& reply) {
    inbox_.push_own(Order{.control = control, .checkpoint = read(control.name)});
    reply.seq = 0;  // answered when it is obeyed
  };
  defer(control, work, reply_to(control, ResultCode::ok, ""));
}

void FrameLoop::record(const RunControl& control) {
  drop_failed_recording();
  if (control.name.empty()) return end_recording(control);
  if (recording_.active())
    return answer(control, ResultCode::incorrect_state,
                  "the log '" + recording_.name() + "' is being written: end it first");
  if (!options_.store.log)
    return answer(control, ResultCode::operation_failed,
                  "the daemon keeps nothing on disk: it has no --data");
  if (const std::string fault = store_name_fault(control.name); !fault.empty())
    return answer(control, ResultCode::invalid_value, fault);
  if (!disk_.has_room()) return answer_behind(control);  // before there is a log
  std::string failure;
  const auto log = begin_recording(control.name, failure);
  if (!log) return answer(control, ResultCode::operation_failed, failure);
  const auto work = [log](Reply& reply) {
    if (log->wait_until_open()) return;
    reply.code = ResultCode::operation_failed;
    reply.message = log->failure();
  };
  report();
  defer(control, work, reply_to(control, ResultCode::ok, ""));
}

// Nothing, and why: it cannot even be begun.
std::shared_ptr<CommandLogWriter> FrameLoop::begin_recording(const std::string& name,
                                                             std::string& fault) {
  LogStart start;
  start.checkpoint = layer_.make_checkpoint("");
  try {
    auto log = options_.store.log(name, std::move(start));
    recording_.begin(name, log, layer_.frame() + 1, layer_.epoch());
    return log;
  } catch (const std::exception& error) {
    fault = error.what();
    return nullptr;
  }
}

void FrameLoop::end_recording(const RunControl& control) {
  if (!recording_.active())
    return answer(control, ResultCode::incorrect_state, "no log is being written");
  if (!disk_.has_room()) return answer_behind(control);  // the log goes on
  // The last to let go of the writer waits for the disk: that is the worker.
  auto log = std::make_shared<std::shared_ptr<CommandLogWriter>>(recording_.end());
  report();
  const auto work = [log](Reply& reply) {
    if ((*log)->close()) return;
    reply.code = ResultCode::operation_failed;
    reply.message = (*log)->failure();
  };
  defer(control, work, reply_to(control, ResultCode::ok, ""));
}

void FrameLoop::drop_failed_recording() {
  if (!recording_.failed()) return;
  record_failed_ = true;
  let_go(recording_.end());
}

// Its end waits for the disk, so the worker has it.
void FrameLoop::let_go(std::shared_ptr<CommandLogWriter> log) {
  disk_.post_always([log = std::move(log)]() mutable { log.reset(); });
}

void FrameLoop::autosave_now_and_then() {
  if (SteadyTime::now() - last_autosave_ >= options_.autosave_ns && is_unsaved()) autosave();
}

bool FrameLoop::is_unsaved() const {
  return options_.autosave_ns > 0 && options_.store.autosave &&
         autosaved_ != std::pair(layer_.snapshot().state_hash, accepted_);
}

void FrameLoop::autosave() {
  last_autosave_ = SteadyTime::now();
  if (autosave_waits_) return;  // the disk is slow: the next one is newer
  auto checkpoint = layer_.make_checkpoint("auto-" + std::to_string(layer_.frame()));
  autosave_waits_ = true;
  const auto job = [this, checkpoint = std::move(checkpoint)] {
    options_.store.autosave(*checkpoint);
    autosave_waits_ = false;
  };
  if (disk_.post(job))
    autosaved_ = {layer_.snapshot().state_hash, accepted_};
  else
    autosave_waits_ = false;
}

}  // namespace poinsot
