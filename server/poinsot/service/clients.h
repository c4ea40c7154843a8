// Clients: who sends commands to this daemon, how much each may send, and who is still there.
//
// A client is known by the number in its commands; it is alive while one of the writers that it has
// sent with is. Each has a rate of commands, and a much lower one of refusals that it gets an
// answer to, so that a flood costs neither the loop nor the bus more than any other client does.
//
// Memory is bounded: what is dead is forgotten after a while, and first when room is needed.
// Any thread; times are handed in, in [ns] of one steady clock.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "poinsot/protocol/frame_report.h"
#include "poinsot/service/token_bucket.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {

struct ClientLimits {
  // A controller of 500 bodies at 60 Hz sends 30000 in a second, 500 of them at once.
  double commands_per_second = 40'000;
  double commands_at_once = 512;
  double refusals_per_second = 200;  // that are answered
  double refusals_at_once = 64;
};

class Clients {
 public:
  static constexpr std::size_t kKnown = 1024;
  static constexpr std::size_t kClientsOfOneWriter = 64;
  static constexpr std::int64_t kRemembered = 60'000'000'000;  // [ns] of a dead one

  explicit Clients(const ClientLimits& limits)
      : limits_(limits), strangers_(limits.refusals_per_second, limits.refusals_at_once, 0) {}

  // A command of this client came from this writer. False: it is one too many; it counts as refused
  // and limited. Client 0 is the scene: no writer speaks for it.
  bool admit(std::uint64_t client, const WriterKey& writer, double cost, std::int64_t now);
  // Whether a refusal given by the receiver is to be answered; counts it as refused. Clients that
  // are not known, as when there are too many, share what one client has.
  bool refuse(std::uint64_t client, std::int64_t now);
  // The loop has answered a command.
  void count(std::uint64_t client, bool accepted);

  // A writer is gone: appends the clients that have none left, by number.
  void lose(const WriterKey& writer, std::int64_t now, std::vector<std::uint64_t>& left);

  // Those alive or holding something, by number, kMaxClients at most; `complete` fills in what the
  // loop knows of one. Forgets those dead for long that hold nothing.
  void report(std::int64_t now, const std::function<void(ClientStatus&)>& complete,
              std::vector<ClientStatus>& clients);

  std::uint64_t limited() const;     // commands, of all clients so far
  std::uint64_t unanswered() const;  // refusals without an answer
  std::size_t known() const;

 private:
  struct Client {
    std::vector<WriterKey> writers;  // that are there
    TokenBucket commands;
    TokenBucket refusals;
    std::int64_t died = 0;  // [ns] if it has no writer
    std::uint64_t accepted = 0, refused = 0, limited = 0;
  };

  Client* meet(std::uint64_t client, const WriterKey& writer, std::int64_t now);
  bool make_room();

  const ClientLimits limits_;
  mutable std::mutex mutex_;
  std::map<std::uint64_t, Client> clients_;
  std::map<WriterKey, std::size_t> clients_of_;  // how many it speaks for
  TokenBucket strangers_;                        // refusals
  std::uint64_t limited_ = 0;
  std::uint64_t unanswered_ = 0;
};

}  // namespace poinsot
