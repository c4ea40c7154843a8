// The frame loop: the one thread that advances the run. Each turn waits until the next frame is
// due, obeys what has come, advances, and hands the frame over. Paused, it blocks until something
// comes.
//
// Commands of one turn are taken in the order (client, seq), so that the order of arrival within a
// frame does not matter. Every command gets one reply: at once, paused or not; a step's when its
// frames are done. Steps run as fast as they can; a pause, resume or reset ends a step early.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "poinsot/presentation/frame_clock.h"
#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/service/command_inbox.h"
#include "poinsot/service/outbox.h"
#include "poinsot/service/reply_cache.h"
#include "poinsot/service/steady_time.h"

namespace poinsot {

struct FrameLoopOptions {
  std::uint64_t session = 0;  // stamped on snapshots and reports
  bool fast = false;          // not paced
  bool paused = false;        // at the start
  std::uint64_t frames = 0;   // end after so many; 0: when stopped
  std::function<void(const PresentationLayer&)> each_frame = {};  // if set, frame 0 included
};

class FrameLoop {
 public:
  FrameLoop(PresentationLayer& layer, CommandInbox& inbox, Outbox& outbox,
            FrameLoopOptions options);

  // Runs until the stop or the last frame. Once, on one thread; that thread alone may use the
  // layer.
  void run(const std::stop_token& stop);

  std::uint32_t epoch() const { return epoch_; }    // of the run now; from any thread
  std::uint64_t frames() const { return frames_; }  // advanced so far; after run()

 private:
  struct Step {
    RunControl control;
    std::uint64_t target;  // frame
  };

  bool idle() const { return paused_ && !step_; }
  bool done() const { return options_.frames != 0 && frames_ >= options_.frames; }
  void refuse_the_rest();
  void advance();
  void hand_over();

  void obey_inbox();
  void answer_known();
  void accept(std::span<const WrenchCommand> commands);
  void obey(const RunControl& control);
  std::optional<Refusal> check(const RunControl& control) const;
  void end_step(ResultCode code, const std::string& message);
  void answer(const RunControl& control, ResultCode code, const std::string& message);
  void send(const Reply& reply);

  void report();
  void report(RunState state);
  void report_now_and_then();

  PresentationLayer& layer_;
  CommandInbox& inbox_;
  Outbox& outbox_;
  FrameLoopOptions options_;

  bool paused_;
  std::optional<Step> step_;
  std::uint64_t frames_ = 0;
  std::atomic<std::uint32_t> epoch_;
  std::uint64_t overruns_ = 0;

  CommandInbox::Batch batch_;
  std::vector<Reply> replies_;
  ReplyCache answered_;
  std::uint64_t accepted_ = 0;
  std::uint64_t refused_ = 0;

  using Clock = std::chrono::steady_clock;
  RunReport report_;  // the last one; its memory is reused
  Clock::time_point last_report_;
  std::uint64_t overruns_at_last_report_ = 0;
  std::uint64_t full_at_last_report_ = 0;

  // The real-time factor is measured over a window that a pause starts afresh.
  void start_window();
  Clock::time_point window_start_;
  std::uint64_t frames_at_window_start_ = 0;
  double real_time_factor_ = 0;
};

}  // namespace poinsot
