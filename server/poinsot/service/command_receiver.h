// Command receiver: a thread that waits for commands and controls on the bus and puts them into the
// inbox. What cannot be read, and what finds no room, is answered here.

#pragma once

#include <functional>
#include <string>
#include <thread>

#include "poinsot/program/log.h"
#include "poinsot/service/command_inbox.h"
#include "poinsot/service/outbox.h"
#include "poinsot/wire/subscriber.h"

namespace poinsot {

class CommandReceiver {
 public:
  // Starts the thread. Throws Error if the topics cannot be made. `epoch` tells the run's epoch,
  // for the replies that are given here.
  CommandReceiver(Participant& participant, const std::string& world, CommandInbox& inbox,
                  Outbox& outbox, std::function<std::uint32_t()> epoch, Logger logger);
  ~CommandReceiver() { stop(); }

  void stop();

 private:
  void run(const std::stop_token& stop);
  template <class Command>
  void drain(Subscriber<Command>& topic, Command& command);
  void refuse(std::uint64_t client, std::uint64_t seq, ResultCode code, std::string reason);

  CommandInbox& inbox_;
  Outbox& outbox_;
  std::function<std::uint32_t()> epoch_;
  Logger logger_;
  RepeatLimiter refusals_;
  Subscriber<WrenchCommand> wrench_topic_;
  Subscriber<RunControl> control_topic_;
  Waiter waiter_;
  WrenchCommand wrench_;
  RunControl control_;
  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace poinsot
