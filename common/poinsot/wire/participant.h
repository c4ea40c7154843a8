// A participant on the bus: the one door to Fast DDS. All quality of service, buffer and segment
// sizes are set in this module, none elsewhere; profiles named by FASTRTPS_DEFAULT_PROFILES_FILE
// are honoured for what is not set here.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace poinsot {

inline constexpr int kDefaultDomain = 77;
inline constexpr int kMaxDomain = 232;

struct BusOptions {
  int domain = kDefaultDomain;  // 0 … kMaxDomain
  bool lan = false;             // false: this host only
  std::size_t bodies = 0;       // that this side publishes: sizes the shared-memory segment
  bool commands_only =
      false;  // all that this side reads is small: what claims not to be is dropped
  std::string partition = {};  // DDS partition: who has another one is not met; empty: none
  // "host:port" of a discovery server (`fastdds discovery`), which makes participants known to one
  // another instead of greetings; empty: none.
  std::string discovery_server = {};
  // False: UDP alone, for who comes, asks little and leaves. Whoever wrote to a participant through
  // shared memory keeps its receive queue, 50 kB and a file, until it ends itself.
  bool shared_memory = true;
};

enum class BusLogLevel { error, warning };
using BusLog = std::function<void(BusLogLevel, const std::string& message)>;

// Sends Fast DDS's own log lines to `log` instead of the standard output, for the whole process.
// Call once, before the first participant; an empty function drops them.
void route_bus_log(BusLog log);

// Removes what dead processes of this host left in shared memory (segments without a live owner).
// Returns the number of files removed. Safe beside running participants.
int remove_stale_segments();

class Participant {
 public:
  // Throws Error if the bus cannot be joined.
  explicit Participant(const BusOptions& options);
  ~Participant();
  Participant(Participant&&) noexcept;
  Participant& operator=(Participant&&) noexcept;

  // World names of the other daemons discovered so far, sorted. Discovery is asynchronous.
  std::vector<std::string> worlds() const;

  // What follows poinsot/<world>/poses/ in the names of topics that somebody reads, sorted, each
  // once (stream_name.h). `changes` is another number whenever the answer may be another one.
  std::vector<std::string> pose_streams(std::string_view world) const;
  std::uint64_t pose_stream_changes() const;

  struct Impl;
  Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
