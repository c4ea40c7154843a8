// A client of one running daemon: read its poses and scene, push its bodies, control its run.
//
//   poinsot::Client client({.world = "push_me"});
//   client.wait_for_server(5s);
//   auto reply = client.apply({.body_name = "box", .force = {0, 0, 50}}, 1s);
//
// One thread at a time. A daemon that restarts is met again without doing anything: streams resume,
// with another session number. Waiting costs no processor time.

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct ClientOptions {
  std::string world = {};  // empty: the only one there is
  int domain = 77;         // DDS domain
  bool lan = false;        // false: this host only
  // Identity on the bus; 0: drawn at random. Who shares one counts as one client: what one holds,
  // another can clear.
  std::uint64_t client = 0;
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

// World names of the daemons that answer within `wait`, sorted.
std::vector<std::string> find_worlds(int domain, bool lan, std::chrono::nanoseconds wait);

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

  // The next frame's poses, in order; false on time-out, and `snapshot` is left alone. Its memory
  // is reused. Up to 60 frames wait; who falls farther behind misses the oldest.
  bool next_poses(PoseSnapshot& snapshot, Duration timeout);
  // The newest frame's poses; older ones are skipped. False, and `snapshot` is left alone, when
  // none came since the last call.
  bool latest_poses(PoseSnapshot& snapshot);

  // The next impact, in the order of their frames; false on time-out, and `impact` is left alone.
  // The first call begins to listen: impacts before it are not told. Up to 1000 wait; who falls
  // farther behind misses the oldest.
  bool next_impact(ImpactNotice& impact, Duration timeout);

  // All bodies in the order of the scene file, once all have arrived; throws NoAnswer on time-out.
  // After a restart: of the daemon whose poses or report were read last.
  std::vector<BodyInfo> scene(Duration timeout);
  // The newest report that was not returned before: waits for it. Throws NoAnswer on time-out.
  RunReport report(Duration timeout);

  // Fills in client and seq, sends, and resends every 250 ms until answered. Throws NoAnswer on
  // time-out (whether the command was taken is then unknown), Error if it does not fit on the bus.
  Reply apply(WrenchCommand command, Duration timeout);
  Reply control(RunControl control, Duration timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace poinsot
