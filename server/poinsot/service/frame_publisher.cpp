#include "poinsot/service/frame_publisher.h"

#include <chrono>
#include <utility>

#include "poinsot/wire/topics.h"

namespace poinsot {
namespace {

// How long a new reader of poses may go unnoticed while no frame is advanced.
constexpr std::chrono::milliseconds kLookForReaders{100};

std::int64_t now_utc_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

FramePublisher::FramePublisher(Participant& participant, const std::string& world, Outbox& outbox,
                               std::vector<BodyInfo> scene, std::uint64_t session, Logger logger)
    : outbox_(outbox),
      session_(session),
      scene_(std::move(scene)),
      scene_topic_(participant, world),
      poses_topic_(participant, world),
      report_topic_(participant, world),
      reply_topic_(participant, world),
      events_topic_(participant, world),
      logger_(std::move(logger)),
      failures_(std::chrono::seconds(1)) {
  // These change places with the outbox's: the same room on both sides, or the loop would allocate.
  snapshot_.bodies.reserve(scene_.size());
  report_.body_methods.reserve(scene_.size());
  replies_.reserve(Outbox::kReplies);
  impacts_.reserve(Outbox::kImpacts);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void FramePublisher::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void FramePublisher::run(const std::stop_token& stop) {
  for (const BodyInfo& body : scene_) write(scene_topic_, body);
  while (!stop.stop_requested()) {
    const bool quiet = !outbox_.wait(stop, kLookForReaders);
    send(quiet);
  }
  send(false);  // what came before the stop
}

void FramePublisher::send(bool quiet) {
  Elapsed lap;
  {
    const Stopwatch::Lap timer(lap);
    send_impacts();
    send_poses(quiet);
    if (outbox_.take(report_)) {
      report_.session = session_;
      report_.snapshots_dropped = outbox_.snapshots_dropped();
      report_.events_dropped = outbox_.impacts_dropped();
      report_.times.publishing = elapsed();
      write(report_topic_, report_);
    }
    // Last: who reads a reply finds the frame and the report that it speaks of.
    if (outbox_.take(replies_))
      for (const Reply& reply : replies_) write(reply_topic_, reply);
  }
  const std::lock_guard lock(mutex_);
  elapsed_ += lap;
}

void FramePublisher::send_poses(bool quiet) {
  const int readers = poses_topic_.readers();
  joined_ |= readers > std::exchange(readers_, readers);
  outbox_.set_poses_wanted(readers > 0);
  if (readers == 0) return;
  for (; outbox_.take(snapshot_); joined_ = false) write_poses();
  // Again, if nothing newer comes soon; while frames come, other readers would get one twice.
  if (quiet && std::exchange(joined_, false) && snapshot_.epoch != 0) write_poses();
}

void FramePublisher::send_impacts() {
  outbox_.set_impacts_wanted(events_topic_.readers() > 0);
  if (!outbox_.take(impacts_)) return;
  for (ImpactNotice& impact : impacts_) {
    impact.session = session_;
    write(events_topic_, impact);
  }
}

void FramePublisher::write_poses() {
  snapshot_.session = session_;
  snapshot_.publish_time_ns = now_utc_ns();
  write(poses_topic_, snapshot_);
}

template <class Message>
void FramePublisher::write(Publisher<Message>& topic, const Message& message) {
  if (topic.write(message)) return;
  if (const auto held_back = failures_.admit(RepeatLimiter::Time::clock::now()))
    logger_->error("write_failed topic={} more={}", kTopicName<Message>, *held_back);
}

Elapsed FramePublisher::elapsed() const {
  const std::lock_guard lock(mutex_);
  return elapsed_;
}

}  // namespace poinsot
