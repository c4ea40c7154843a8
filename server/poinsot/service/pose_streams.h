// Filtered streams of poses: one topic for each name that somebody reads, made when discovery tells
// of the reader and gone with the last one (wire/stream_name.h). Used by the publisher's thread
// alone.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "poinsot/program/log.h"
#include "poinsot/service/stream_filter.h"
#include "poinsot/wire/publisher.h"

namespace poinsot {

class PoseStreams {
 public:
  static constexpr std::size_t kMost = 16;  // at once; others are not written

  PoseStreams(Participant& participant, std::string world, std::uint64_t session, Logger logger);

  // What comes into the scene and goes; afterwards streams are matched anew.
  void add(NamedBody body);
  void remove(BodyId id);
  void match_anew();
  // Makes and drops streams as readers came and went. Costs nothing if none did.
  void look();
  // The newest frame, or the same again when nothing newer came. True if a sample was written.
  void send(const PoseSnapshot& newest);

  bool any() const { return !streams_.empty(); }
  std::uint32_t count() const { return count_; }  // from any thread

 private:
  struct Stream {
    StreamFilter filter;
    Publisher<PoseSnapshot> topic;
    int readers = 0;  // at the last look
    std::uint64_t sequence = 0;
  };

  void open(const std::string& suffix);

  Participant& participant_;
  std::string world_;
  std::uint64_t session_;
  std::vector<NamedBody> bodies_;          // by slot; without generation: nobody
  std::map<std::string, Stream> streams_;  // by suffix
  std::uint64_t changes_ = 0;              // of discovery, at the last look
  std::atomic<std::uint32_t> count_ = 0;
  PoseSnapshot sample_;  // reused
  Logger logger_;
  RepeatLimiter failures_;
};

}  // namespace poinsot
