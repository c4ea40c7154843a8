// Command receiver: a thread that waits for commands and controls on the bus and puts them into the
// inbox. What cannot be read, is one too many, or finds no room is answered here. Scene fragments
// are parsed here, so that the loop need not. It keeps account of the clients: of whom the last
// writer is gone, what it holds is released.

#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "poinsot/program/log.h"
#include "poinsot/service/clients.h"
#include "poinsot/service/command_inbox.h"
#include "poinsot/service/outbox.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {

class CommandReceiver {
 public:
  // Starts the thread. Throws Error if the topics cannot be made. `epoch` tells the run's epoch,
  // for the replies that are given here.
  CommandReceiver(Participant& participant, const std::string& world, CommandInbox& inbox,
                  Outbox& outbox, Clients& clients, std::function<std::uint32_t()> epoch,
                  Logger logger);
  ~CommandReceiver() { stop(); }

  void stop();

 private:
  void run(const std::stop_token& stop);
  template <class Command>
  bool drain(Subscriber<Command>& topic, Command& command);
  void take(WrenchCommand& command);
  void take(RunControl& control);
  void refuse(std::uint64_t client, std::uint64_t seq, ResultCode code, std::string reason);
  void note_lost(const WriterKey& writer);
  void release_lost(std::vector<WriterKey>& writers);

  CommandInbox& inbox_;
  Outbox& outbox_;
  Clients& clients_;
  std::function<std::uint32_t()> epoch_;
  Logger logger_;
  RepeatLimiter refusals_, departures_;

  std::mutex mutex_;
  std::vector<WriterKey> lost_;  // under the mutex; filled by threads of the bus
  bool listens_ = false;         // under the mutex: there is a waiter to wake

  Subscriber<WrenchCommand> wrench_topic_;
  Subscriber<RunControl> control_topic_;
  Waiter waiter_;
  WrenchCommand wrench_;
  RunControl control_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace poinsot
