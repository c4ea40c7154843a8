// The daemon: one run of a scene on the bus. Wires loop, publisher and receiver together and owns
// their lifetimes.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/program/log.h"
#include "poinsot/runner/run_summary.h"
#include "poinsot/runner/store.h"
#include "poinsot/runner/trajectory.h"
#include "poinsot/service/clients.h"
#include "poinsot/service/command_inbox.h"
#include "poinsot/service/command_receiver.h"
#include "poinsot/service/daemon_options.h"
#include "poinsot/service/disk_worker.h"
#include "poinsot/service/frame_loop.h"
#include "poinsot/service/frame_publisher.h"
#include "poinsot/service/outbox.h"
#include "poinsot/wire/participant.h"

namespace poinsot {

class Daemon {
 public:
  // Joins the bus and starts the run; calls `ended` from the loop's thread when the last frame of
  // options.frames is done or a client has asked for the end. `before_start`, if set, is called in
  // between, when nothing is on disk yet, and may throw. Throws Error if the bus cannot be joined,
  // the trajectory not created or the checkpoint to begin with not read.
  Daemon(Scene scene, const DaemonOptions& options, Logger logger, std::function<void()> ended,
         const std::function<void(const Daemon&)>& before_start = {});
  ~Daemon();

  const std::string& world() const { return world_; }
  RunReport report() const { return outbox_.newest_report(); }

  // Whether another daemon that serves this world has been heard of. One that was there before is
  // heard of within kDiscovery.
  bool is_taken() const;
  static constexpr std::chrono::milliseconds kDiscovery{1000};

  // Ends the run: the loop after its frame, then the receiver, then the publisher when all is sent.
  // Throws std::runtime_error if the trajectory could not be written.
  RunSummary stop();

 private:
  void join_threads();
  PresentationLayer first_state(Scene scene, const DaemonOptions& options) const;
  FrameLoopOptions loop_options(const DaemonOptions& options);

  Logger logger_;
  std::string world_;
  std::uint64_t session_;
  std::optional<Store> store_;
  PresentationLayer layer_;
  std::optional<Trajectory> trajectory_;
  CommandInbox inbox_;
  Outbox outbox_;
  Clients clients_;
  DiskWorker disk_;
  FrameLoop loop_;
  Participant participant_;
  FramePublisher publisher_;
  CommandReceiver receiver_;
  Elapsed elapsed_;  // of the loop
  std::jthread loop_thread_;
};

}  // namespace poinsot
