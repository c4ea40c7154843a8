#include "poinsot/service/pose_streams.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "poinsot/service/steady_time.h"
#include "poinsot/service/utc_time.h"

namespace poinsot {
PoseStreams::PoseStreams(Participant& participant, std::string world, std::uint64_t session,
                         Logger logger)
    : participant_(participant),
      world_(std::move(world)),
      session_(session),
      logger_(std::move(logger)),
      failures_(std::chrono::seconds(1)) {}

void PoseStreams::add(NamedBody body) {
  if (body.id.slot >= bodies_.size()) bodies_.resize(body.id.slot + std::size_t{1});
  const std::uint32_t slot = body.id.slot;
  bodies_[slot] = std::move(body);
}

void PoseStreams::remove(BodyId id) {
  if (id.slot < bodies_.size() && bodies_[id.slot].id == id) bodies_[id.slot] = {};
}

void PoseStreams::match_anew() {
  for (auto& [suffix, stream] : streams_) stream.filter.set_bodies(bodies_);
}

void PoseStreams::look() {
  const std::uint64_t changes = participant_.pose_stream_changes();
  if (std::exchange(changes_, changes) == changes) return;
  const std::vector<std::string> wanted = participant_.pose_streams(world_);  // sorted
  std::erase_if(streams_, [&](const auto& entry) {
    return !std::binary_search(wanted.begin(), wanted.end(), entry.first);
  });
  for (const std::string& suffix : wanted)
    if (!streams_.contains(suffix)) open(suffix);
  count_ = static_cast<std::uint32_t>(streams_.size());
}

void PoseStreams::open(const std::string& suffix) {
  const auto filter = parse_stream_suffix(suffix);
  std::string reason = "no such filter";
  if (filter && streams_.size() < kMost) {
    try {
      const auto made = streams_.try_emplace(suffix, StreamFilter(*filter),
                                             Publisher<PoseSnapshot>(participant_, world_, suffix));
      return made.first->second.filter.set_bodies(bodies_);
    } catch (const std::exception& error) {
      reason = error.what();
    }
  } else if (filter) {
    reason = std::to_string(kMost) + " are written already";
  }
  if (const auto held_back = failures_.admit(RepeatLimiter::Time::clock::now()))
    logger_->warn("stream_refused suffix={} reason={} more={}", poinsot::quoted(suffix),
                  poinsot::quoted(reason), *held_back);
}

void PoseStreams::send(const PoseSnapshot& newest) {
  for (auto& [suffix, stream] : streams_) {
    const int readers = stream.topic.readers();
    if (readers > std::exchange(stream.readers, readers)) stream.filter.join();
    if (readers == 0 || !stream.filter.take(newest, SteadyTime::now(), sample_)) continue;
    sample_.session = session_;
    sample_.sequence = ++stream.sequence;
    sample_.publish_time_ns = utc_ns();
    if (!stream.topic.write(sample_))
      if (const auto held_back = failures_.admit(RepeatLimiter::Time::clock::now()))
        logger_->error("write_failed stream={} more={}", poinsot::quoted(suffix), *held_back);
  }
}

}  // namespace poinsot
