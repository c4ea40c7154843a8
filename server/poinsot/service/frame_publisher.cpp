#include "poinsot/service/frame_publisher.h"

#include <chrono>
#include <utility>

#include "poinsot/service/utc_time.h"
#include "poinsot/wire/topics.h"

namespace poinsot {
namespace {

// How long a new reader of poses may go unnoticed while no frame is advanced.
constexpr std::chrono::milliseconds kLookForReaders{100};
// How long a reader has to be told, again if need be, that a body is gone.
constexpr std::chrono::seconds kRemembered{10};

}  // namespace

FramePublisher::FramePublisher(Participant& participant, const std::string& world, Outbox& outbox,
                               std::uint64_t session, Logger logger)
    : outbox_(outbox),
      session_(session),
      streams_(participant, world, session, logger),
      scene_topic_(participant, world),
      poses_topic_(participant, world),
      report_topic_(participant, world),
      reply_topic_(participant, world),
      events_topic_(participant, world),
      contacts_topic_(participant, world),
      held_topic_(participant, world),
      logger_(std::move(logger)),
      failures_(std::chrono::seconds(1)) {
  // These change places with the outbox's: the same room on both sides, or the loop would allocate.
  const std::size_t bodies = outbox_.bodies();
  snapshot_.bodies.reserve(bodies);
  report_.body_methods.reserve(bodies);
  replies_.reserve(Outbox::kReplies);
  impacts_.reserve(Outbox::kImpacts);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void FramePublisher::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void FramePublisher::run(const std::stop_token& stop) {
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
    // What was handed over later is taken earlier: so nobody reads a reply before the frame and the
    // report that it speaks of, or a report before the bodies that it counts.
    const bool has_replies = outbox_.take(replies_);
    const bool has_report = outbox_.take(report_);
    send_scene();
    send_impacts();
    send_contacts();
    send_held(quiet);
    send_poses(quiet);
    if (has_report) write_report();
    if (has_replies)
      for (const Reply& reply : replies_) write(reply_topic_, reply);
  }
  const std::lock_guard lock(mutex_);
  elapsed_ += lap;
}

void FramePublisher::write_report() {
  report_.session = session_;
  report_.snapshots_dropped = outbox_.snapshots_dropped();
  report_.events_dropped = outbox_.impacts_dropped();
  report_.streams = streams_.count();
  report_.times.publishing = elapsed();
  write(report_topic_, report_);
}

void FramePublisher::send_scene() {
  forget_removed();
  if (!outbox_.take(change_)) return;
  for (const BodyId id : change_.removed) {
    BodyInfo gone;
    gone.session = session_;
    gone.id = id;
    gone.removed = true;
    write(scene_topic_, gone);
    removed_.push_back({std::chrono::steady_clock::now(), gone});
    streams_.remove(id);
  }
  for (BodyInfo& body : change_.added) {
    body.session = session_;
    write(scene_topic_, body);
    streams_.add({body.id, body.name});
    // A reset or a restore brings back what was removed, under its old id.
    std::erase_if(removed_, [&](const auto& entry) { return entry.second.id == body.id; });
  }
  streams_.match_anew();
}

// Late joiners need not hear of bodies that have long been gone.
void FramePublisher::forget_removed() {
  const auto now = std::chrono::steady_clock::now();
  for (; !removed_.empty() && now - removed_.front().first > kRemembered; removed_.pop_front())
    scene_topic_.forget(removed_.front().second);
}

void FramePublisher::send_poses(bool quiet) {
  of_poses_.look(poses_topic_.readers());
  streams_.look();
  outbox_.set_poses_wanted(of_poses_.readers > 0 || streams_.any());
  while ((of_poses_.readers > 0 || streams_.any()) && outbox_.take(snapshot_)) {
    if (of_poses_.readers > 0) write_poses();
    streams_.send(snapshot_);
  }
  // Again, if nothing newer comes soon; while frames come, other readers would get one twice.
  if (!quiet || snapshot_.epoch == 0) return;
  if (of_poses_.is_new()) write_poses();
  streams_.send(snapshot_);
}

void FramePublisher::send_impacts() {
  outbox_.set_impacts_wanted(events_topic_.readers() > 0);
  if (!outbox_.take(impacts_)) return;
  for (ImpactNotice& impact : impacts_) {
    impact.session = session_;
    impact.sequence = ++impacts_written_;
    write(events_topic_, impact);
  }
}

void FramePublisher::send_contacts() {
  of_contacts_.look(contacts_topic_.readers());
  outbox_.set_contacts_wanted(of_contacts_.readers > 0);
  if (of_contacts_.readers == 0) contacts_.epoch = 0;  // old news to who comes next
  const bool is_new = outbox_.take(contacts_);
  const bool again = of_contacts_.joined && contacts_.epoch != 0;
  if (of_contacts_.readers == 0 || !(is_new || again)) return;
  of_contacts_.joined = false;
  contacts_.session = session_;
  contacts_.sequence = ++contacts_written_;
  write(contacts_topic_, contacts_);
}

void FramePublisher::send_held(bool quiet) {
  of_held_.look(held_topic_.readers());
  outbox_.set_held_wanted(of_held_.readers > 0);
  if (of_held_.readers == 0) held_.epoch = 0;  // old news to who comes next
  const bool is_new = outbox_.take(held_);
  const bool again = (of_held_.joined || (quiet && of_held_.is_new())) && held_.epoch != 0;
  if (of_held_.readers == 0 || !(is_new || again)) return;
  of_held_.joined = false;
  held_.session = session_;
  held_.sequence = ++held_written_;
  write(held_topic_, held_);
}

void FramePublisher::write_poses() {
  snapshot_.session = session_;
  snapshot_.sequence = ++poses_;
  snapshot_.publish_time_ns = utc_ns();
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
