// A client of one running daemon: read its poses and scene, push its bodies, control its run.
//
//   poinsot::Client client({.world = "push_me"});
//   client.wait_for_server(5s);
//   auto reply = client.apply({.body_name = "box", .force = {0, 0, 50}}, 1s);
//
// One thread at a time. A daemon that restarts is met again without doing anything: streams resume,
// with another session number. Waiting costs no processor time.
//
// What a client holds on bodies ends with it, whether it leaves or dies, unless the command says
// `outlives_client`.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"
#include "poinsot/wire/stream_name.h"

namespace poinsot {

struct ClientOptions {
  std::string world = {};  // empty: the only one there is
  int domain = 77;         // DDS domain
  bool lan = false;        // false: this host only
  // Identity on the bus; 0: drawn at random. Who shares one counts as one client: what one holds,
  // another can clear.
  std::uint64_t client = 0;
  std::string partition = {};         // DDS partition; empty: the default one
  std::string discovery_server = {};  // "address:port"; empty: participants greet each other
  // The poses that are received: all, those of a filter, which the daemon then chooses and thins
  // out, or none, for whom the daemon writes nothing.
  std::optional<PoseFilter> poses = PoseFilter{};
  // False: UDP alone, for who comes, asks little and leaves; the daemon keeps 50 kB of shared
  // memory for each client that it wrote to through it, until it ends.
  bool shared_memory = true;
  // Once it is requested, all calls that wait throw Stopped, within a tenth of a second.
  std::stop_token stop = {};
};

// No answer within the time allowed, or no (single) daemon to talk to. The text says which.
class NoAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// No world was named and there are several; the text lists them.
class SeveralWorlds : public NoAnswer {
 public:
  using NoAnswer::NoAnswer;
};

// ClientOptions::stop was requested.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

// World names of the daemons that answer within `wait`, sorted. Only what says which bus is of use.
std::vector<std::string> find_worlds(const ClientOptions& bus, std::chrono::nanoseconds wait);

class Client {
 public:
  using Duration = std::chrono::nanoseconds;

  // Joins the bus; does not wait. Throws Error if the bus cannot be joined.
  explicit Client(const ClientOptions& options);
  ~Client();
  Client(Client&&) noexcept;
  Client& operator=(Client&&) noexcept;

  // Waits until the daemon is matched in both directions. Throws NoAnswer if none is found in time
  // (it may be called again), SeveralWorlds as soon as they have been met: if none was named it
  // waits for others, 0.4 s at least. If a world was named, the other calls need not wait for it.
  void wait_for_server(Duration timeout);

  const std::string& world() const;  // after wait_for_server
  std::uint64_t id() const;          // its identity on the bus

  // Streams --------------------------------------------------------------------------------------

  // The next frame's poses, in order; false on time-out, and `snapshot` is left alone. Its memory
  // is reused. Up to 60 frames wait; who falls farther behind misses the oldest: a gap in
  // `sequence`. Of a filtered stream a snapshot may hold only what moved (`complete`).
  bool next_poses(PoseSnapshot& snapshot, Duration timeout);
  // The newest frame's poses; older ones are skipped. False, and `snapshot` is left alone, when
  // none came since the last call.
  bool latest_poses(PoseSnapshot& snapshot);

  // Samples of the stream of poses that did not arrive since the first that did, by their sequence
  // numbers; those that the daemon dropped before they reached the bus included.
  std::uint64_t lost_poses() const;

  // The next impact, in the order of their frames; false on time-out, and `impact` is left alone.
  // The first call begins to listen: impacts before it are not told. Up to 1000 wait; who falls
  // farther behind misses the oldest.
  bool next_impact(ImpactNotice& impact, Duration timeout);

  // All contacts of the next frame, likewise.
  bool next_contacts(ContactSnapshot& contacts, Duration timeout);

  // What is there -------------------------------------------------------------------------------

  // All bodies by slot, so in the order of the scene file, then spawned ones; once all have
  // arrived: as many as the report says, and all of the poses read last. Throws NoAnswer on
  // time-out. After a restart: of the daemon whose poses or report came last.
  std::vector<BodyInfo> scene(Duration timeout);
  // Of the scene that was last reported: another number means that bodies came or went.
  std::uint32_t scene_revision() const;
  // The newest report that was not returned before: waits for it. Throws NoAnswer on time-out.
  RunReport report(Duration timeout);
  // What is held on bodies now, by everyone. Throws NoAnswer on time-out.
  HeldList held(Duration timeout);

  // Commands ------------------------------------------------------------------------------------

  // Fills in client and seq, sends, and resends every 250 ms until answered. Throws NoAnswer on
  // time-out (whether the command was taken is then unknown), Error if it does not fit on the bus.
  Reply apply(WrenchCommand command, Duration timeout);
  // The same. A step, a run_until and a save to disk are answered when they are done, however long
  // that takes: for these the time-out is that of silence, without an answer or progress.
  Reply control(RunControl control, Duration timeout);

  // Lock step: before each frame the daemon waits until this client has called advance(), but not
  // longer than `patience`; what it sent before acts in that frame. 0, or leaving, ends it.
  Reply lock_step(Duration patience, Duration timeout);
  Reply advance(Duration timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
