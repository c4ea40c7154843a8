#include "poinsot/service/command_receiver.h"

#include <chrono>
#include <utility>

#include "poinsot/protocol/result.h"

namespace poinsot {

using namespace std::chrono_literals;

CommandReceiver::CommandReceiver(Participant& participant, const std::string& world,
                                 CommandInbox& inbox, Outbox& outbox,
                                 std::function<std::uint32_t()> epoch, Logger logger)
    : inbox_(inbox),
      outbox_(outbox),
      epoch_(std::move(epoch)),
      logger_(std::move(logger)),
      refusals_(1s),
      wrench_topic_(participant, world),
      control_topic_(participant, world) {
  waiter_.attach(wrench_topic_);
  waiter_.attach(control_topic_);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void CommandReceiver::stop() {
  thread_.request_stop();
  waiter_.wake();
  if (thread_.joinable()) thread_.join();
}

void CommandReceiver::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    waiter_.wait(1s);
    drain(control_topic_, control_);  // first: a flood of pushes cannot shut out a pause
    drain(wrench_topic_, wrench_);
  }
}

template <class Command>
void CommandReceiver::drain(Subscriber<Command>& topic, Command& command) {
  const auto malformed = [this](const Malformed& m) {
    inbox_.count_malformed();
    refuse(m.client, m.seq, ResultCode::invalid_value, m.reason);
  };
  // Bounded, so that neither the other topic nor a stop waits for a flood to end; what is left
  // wakes the waiter at once.
  for (std::size_t n = 0; n < CommandInbox::kCapacity && topic.take(command, malformed); ++n)
    if (!inbox_.push(command))
      refuse(command.client, command.seq, ResultCode::inbox_full,
             std::to_string(CommandInbox::kCapacity) +
                 " commands wait for the next frame: send it again later");
}

void CommandReceiver::refuse(std::uint64_t client, std::uint64_t seq, ResultCode code,
                             std::string reason) {
  if (const auto held_back = refusals_.admit(RepeatLimiter::Time::clock::now()))
    logger_->warn("command_refused client={} seq={} code={} reason={} more={}", client, seq,
                  name_of<ResultCode>(kResultCodeNames, code), poinsot::quoted(reason), *held_back);
  Reply reply;
  reply.client = client;
  reply.seq = seq;
  reply.epoch = epoch_();
  reply.code = code;
  reply.message = std::move(reason);
  outbox_.push(std::move(reply));
}

}  // namespace poinsot
