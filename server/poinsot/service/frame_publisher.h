// Frame publisher: the one thread that writes to the bus, whatever the outbox holds. However slow a
// reader is, only this thread would notice.
//
// Poses are written while somebody reads them. A reader that joins while nothing moves gets the
// newest frame at once, so that a paused run can be looked at. Impacts, contacts and what is held
// are taken from the loop while somebody reads them.

#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "poinsot/base/stopwatch.h"
#include "poinsot/program/log.h"
#include "poinsot/protocol/body_info.h"
#include "poinsot/service/outbox.h"
#include "poinsot/service/pose_streams.h"
#include "poinsot/wire/publisher.h"

namespace poinsot {

class FramePublisher {
 public:
  // Starts the thread. Throws Error if the topics cannot be made. `session` is stamped on all.
  FramePublisher(Participant& participant, const std::string& world, Outbox& outbox,
                 std::uint64_t session, Logger logger);
  ~FramePublisher() { stop(); }

  // Sends what is left in the outbox and ends the thread.
  void stop();

  Elapsed elapsed() const;  // time spent writing; from any thread

 private:
  void run(const std::stop_token& stop);
  void send(bool quiet);
  void send_poses(bool quiet);
  void write_poses();
  void write_report();
  void send_scene();
  void forget_removed();
  void send_impacts();
  void send_contacts();
  void send_held(bool quiet);
  template <class Message>
  void write(Publisher<Message>& topic, const Message& message);

  Outbox& outbox_;
  std::uint64_t session_;
  PoseStreams streams_;
  Publisher<BodyInfo> scene_topic_;
  Publisher<PoseSnapshot> poses_topic_;
  Publisher<RunReport> report_topic_;
  Publisher<Reply> reply_topic_;
  Publisher<ImpactNotice> events_topic_;
  Publisher<ContactSnapshot> contacts_topic_;
  Publisher<HeldList> held_topic_;

  PoseSnapshot snapshot_;  // the newest taken
  std::vector<Reply> replies_;
  std::vector<ImpactNotice> impacts_;
  RunReport report_;
  SceneChange change_;
  std::deque<std::pair<std::chrono::steady_clock::time_point, BodyInfo>> removed_;
  ContactSnapshot contacts_;
  HeldList held_;
  // Readers at the last look, and whether one joined since the newest was written. A reader that
  // we have met may not have met us yet (Cyclone DDS: for more than a second) and miss what is
  // written now: for three seconds it is new.
  struct Audience {
    using Clock = std::chrono::steady_clock;

    int readers = 0;
    bool joined = false;
    Clock::time_point new_until = {};

    void look(int now) {
      if (now <= std::exchange(readers, now)) return;
      joined = true;
      new_until = Clock::now() + std::chrono::seconds(3);
    }
    bool is_new() const { return readers > 0 && Clock::now() < new_until; }
  };
  Audience of_poses_, of_contacts_, of_held_;
  // Samples written of each topic.
  std::uint64_t poses_ = 0, impacts_written_ = 0, contacts_written_ = 0, held_written_ = 0;

  Logger logger_;
  RepeatLimiter failures_;

  mutable std::mutex mutex_;
  Elapsed elapsed_;  // under the mutex

  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace poinsot
