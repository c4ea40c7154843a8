// The frame loop: the one thread that advances the run. Each turn waits until the next frame is
// due, obeys what has come, waits for the inputs of clients in lock step, advances, and hands the
// frame over. Paused, it blocks until something comes.
//
// Commands of one turn are taken in the order (client, seq), so that the order of arrival within a
// frame does not matter. Every command gets one reply: at once, paused or not; that of a step or
// run_until when its frames are done, that of `advance` when its frame is, that of what is on disk
// when the disk is done. Steps run as fast as they can; what changes the run's course ends one
// early.
//
// The loop never waits for the bus, a client that is not in lock step, or a disk, but for what
// `each_frame` does: a trajectory is written there. What leaves a
// trace in the physics goes through the layer in a turn, so that the log holds all of it.

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/presentation/frame_clock.h"
#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/service/clients.h"
#include "poinsot/service/command_inbox.h"
#include "poinsot/service/disk_worker.h"
#include "poinsot/service/lock_step.h"
#include "poinsot/service/outbox.h"
#include "poinsot/service/pace_meter.h"
#include "poinsot/service/recording.h"
#include "poinsot/service/reply_cache.h"
#include "poinsot/service/scene_changes.h"
#include "poinsot/service/steady_time.h"

namespace poinsot {

// Where checkpoints and logs are kept. The first two run on the disk worker's thread and throw what
// says why not; not set: there is no place for them.
struct RunStore {
  std::function<void(const Checkpoint&)> write = {};
  std::function<std::shared_ptr<const Checkpoint>(const std::string& name)> read = {};
  // A log that begins so; file and world are filled in. Opens nothing itself.
  std::function<std::shared_ptr<CommandLogWriter>(const std::string& name, LogStart)> log = {};
  std::function<void(const Checkpoint&)> autosave = {};  // on the worker's thread; does not throw
};

struct FrameLoopOptions {
  double scale = 1;              // simulated / wall time; 0: as fast as it can
  bool paused = false;           // at the start
  std::uint64_t frames = 0;      // end after so many; 0: when stopped
  std::string record = {};       // name of a log from the beginning
  std::int64_t autosave_ns = 0;  // between autosaves [ns]; 0: none
  RunStore store = {};
  std::function<void(const PresentationLayer&)> each_frame = {};  // if set, frame 0 included
};

class FrameLoop {
 public:
  FrameLoop(PresentationLayer& layer, CommandInbox& inbox, Outbox& outbox, Clients& clients,
            DiskWorker& disk, FrameLoopOptions options);

  // Runs until the stop, a shutdown or the last frame; stops the disk worker at the end. Once, on
  // one thread; that thread alone may use the layer.
  void run(const std::stop_token& stop);

  // After run(), when nothing comes any more: answers what came since its end.
  void refuse_rest();

  std::uint32_t epoch() const { return epoch_; }    // of the run now; from any thread
  std::uint64_t frames() const { return frames_; }  // advanced so far; after run()

 private:
  // Frames that a client waits for: a step or a run_until.
  struct Goal {
    RunControl control;
    std::uint64_t target;  // frame
  };

  bool idle() const { return paused_ && !goal_; }
  bool over() const { return quit_ || (options_.frames != 0 && frames_ >= options_.frames); }
  bool is_step() const { return goal_ && goal_->control.action == ControlAction::step; }
  bool is_paced() const { return scale_ > 0 && !is_step(); }

  // A turn (frame_loop.cpp).
  bool await_turn(const std::stop_token& stop);
  bool await_inputs(const std::stop_token& stop);
  void advance(std::int64_t began);
  void hand_over();
  void publish();
  void offer();
  void begin_pace();
  void obey_inbox();
  void answer_known();
  void tell_turn();
  void accept(std::span<const WrenchCommand> commands);
  void end_run();

  // What a client asks for (frame_loop_orders.cpp).
  std::optional<Refusal> check(const RunControl& control) const;
  std::optional<Refusal> check_values(const RunControl& control) const;
  std::optional<Refusal> check_state(const RunControl& control) const;
  void obey(const Order& order);
  void begin_goal(const RunControl& control);
  void end_goal(ResultCode code, const std::string& message);
  void set_scale(const RunControl& control);
  void enter_lock_step(const RunControl& control);
  void leave_lock_step(std::uint64_t client, const std::string& why);
  void answer_inputs(ResultCode code, const std::string& message);
  void obey_layer(const Order& order);
  void obey_restore(const Order& order);
  void obey_release(const Order& order);
  void follow_frame_rate();
  void begin_epoch(ControlAction action);

  // What has to do with the disk (frame_loop_disk.cpp).
  bool defer(const RunControl& control, std::function<void(Reply&)> work, Reply reply);
  void answer_behind(const RunControl& control);
  void save_to_disk(const RunControl& control, Reply reply);
  void restore_from_disk(const RunControl& control);
  void record(const RunControl& control);
  std::shared_ptr<CommandLogWriter> begin_recording(const std::string& name, std::string& fault);
  void end_recording(const RunControl& control);
  void drop_failed_recording();
  void let_go(std::shared_ptr<CommandLogWriter> log);
  bool is_unsaved() const;
  void autosave();
  void autosave_now_and_then();

  // Replies and reports (frame_loop_report.cpp).
  Reply reply_to(const RunControl& control, ResultCode code, const std::string& message) const;
  void answer(const RunControl& control, ResultCode code, const std::string& message);
  void send(const Reply& reply);
  void report();
  void report(RunState state);
  void report_now_and_then();

  PresentationLayer& layer_;
  CommandInbox& inbox_;
  Outbox& outbox_;
  Clients& clients_;
  DiskWorker& disk_;
  const FrameLoopOptions options_;

  SteadyTime time_;
  FrameClock<SteadyTime> clock_;
  PaceMeter meter_;
  bool was_paced_ = false;  // in the last turn

  double frame_rate_;  // [Hz] that the clock and the meter go by
  double scale_;
  bool paused_;
  bool quit_ = false;
  std::optional<Goal> goal_;
  LockStep lock_step_;
  std::uint64_t frames_ = 0;
  std::atomic<std::uint32_t> epoch_;
  std::uint64_t overruns_ = 0;
  std::uint64_t late_inputs_ = 0;

  Recording recording_;
  bool record_failed_ = false;                         // since the last report
  std::atomic<bool> autosave_waits_ = false;           // for the disk, or is being written
  std::int64_t last_autosave_ = 0;                     // [ns]
  std::pair<std::uint64_t, std::uint64_t> autosaved_;  // the state's hash; accepted_, for what is
                                                       // held is in the hash from the next frame on

  CommandInbox::Batch batch_;
  std::vector<Reply> replies_;
  std::vector<RunControl> inputs_;
  // A turn of many orders is told of once, at its end: the poses, the report, then the replies.
  bool in_turn_ = false;
  bool publish_due_ = false;
  bool report_due_ = false;
  std::vector<Reply> turn_replies_;
  ReplyCache answered_;
  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;

  SceneChanges scene_changes_;
  // What was handed over last of what is made only when it is wanted; their memory is reused.
  ContactSnapshot contacts_;
  HeldList held_;
  std::pair<std::uint32_t, std::uint64_t> contacts_told_;       // epoch, frame; 0: none
  static constexpr std::int64_t kReportInterval = 200'000'000;  // [ns]
  static constexpr std::uint64_t kNotTold = UINT64_MAX;
  std::uint64_t held_told_ = kNotTold;  // its revision

  // What was told last, so that the next report can say what is new.
  RunReport report_;              // its memory is reused
  std::int64_t last_report_ = 0;  // [ns]
  std::uint64_t overruns_told_ = 0;
  std::uint64_t full_told_ = 0;
  std::uint64_t late_inputs_told_ = 0;
  std::uint64_t limited_told_ = 0;
};

}  // namespace poinsot
