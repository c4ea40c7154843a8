#include "poinsot/service/command_receiver.h"

#include <chrono>
#include <memory>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/presentation/scene_wrenches.h"
#include "poinsot/protocol/result.h"
#include "poinsot/scene/fragment.h"
#include "poinsot/service/steady_time.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

// How many bytes of a fragment count as one command: about as long to read as a command to obey.
constexpr double kBytesPerCommand = 64;

double cost_of(const WrenchCommand&) {
  return 1;
}
double cost_of(const RunControl& control) {
  return 1 + static_cast<double>(control.text.size()) / kBytesPerCommand;
}

}  // namespace

CommandReceiver::CommandReceiver(Participant& participant, const std::string& world,
                                 CommandInbox& inbox, Outbox& outbox, Clients& clients,
                                 std::function<std::uint32_t()> epoch, Logger logger)
    : inbox_(inbox),
      outbox_(outbox),
      clients_(clients),
      epoch_(std::move(epoch)),
      logger_(std::move(logger)),
      refusals_(1s),
      departures_(1s),
      wrench_topic_(participant, world, {}, [this](const WriterKey& key) { note_lost(key); }),
      control_topic_(participant, world, {}, [this](const WriterKey& key) { note_lost(key); }) {
  waiter_.attach(wrench_topic_);
  waiter_.attach(control_topic_);
  {
    const std::lock_guard lock(mutex_);
    listens_ = true;
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void CommandReceiver::stop() {
  thread_.request_stop();
  {
    const std::lock_guard lock(mutex_);
    listens_ = false;
  }
  waiter_.wake();
  if (thread_.joinable()) thread_.join();
}

void CommandReceiver::run(const std::stop_token& stop) {
  std::vector<WriterKey> lost;
  while (!stop.stop_requested()) {
    waiter_.wait(1s);
    // Who has left may have left commands: they are read first. So the order is: who, then what.
    {
      const std::lock_guard lock(mutex_);
      lost.insert(lost.end(), lost_.begin(), lost_.end());
      lost_.clear();
    }
    const bool no_controls = drain(control_topic_, control_);  // first: see CommandInbox
    const bool no_wrenches = drain(wrench_topic_, wrench_);
    if (no_controls && no_wrenches) release_lost(lost);
  }
}

// Bounded, so that neither the other topic nor a stop waits for a flood to end; what is left wakes
// the waiter at once. True: nothing is left.
template <class Command>
bool CommandReceiver::drain(Subscriber<Command>& topic, Command& command) {
  const auto malformed = [&](const Malformed& m) {
    inbox_.count_refused();
    if (m.client == kSceneClient || clients_.admit(m.client, topic.writer(), 1, SteadyTime::now()))
      refuse(m.client, m.seq, ResultCode::invalid_value, m.reason);
    else
      refuse(m.client, m.seq, ResultCode::rate_limited, "more commands than a client may send");
  };
  for (std::size_t n = 0; n < CommandInbox::kWrenches; ++n) {
    if (!topic.take(command, malformed)) return true;
    if (command.seq == kOwnSeq) {
      inbox_.count_refused();
      refuse(command.client, command.seq, ResultCode::invalid_value, "seq is too large");
    } else if (!clients_.admit(command.client, topic.writer(), cost_of(command),
                               SteadyTime::now())) {
      inbox_.count_refused();
      refuse(command.client, command.seq, ResultCode::rate_limited,
             "more commands than a client may send: send it again later");
    } else {
      take(command);
    }
  }
  return false;
}

void CommandReceiver::take(WrenchCommand& command) {
  if (!inbox_.push(command))
    refuse(command.client, command.seq, ResultCode::inbox_full,
           "as many commands as may wait for the next frame do: send it again later");
}

void CommandReceiver::take(RunControl& control) {
  Order order{.control = control};
  if (control.action == ControlAction::spawn) {
    try {
      order.fragment = std::make_shared<const std::vector<BodyDef>>(parse_fragment(control.text));
    } catch (const Error& fault) {
      inbox_.count_refused();
      return refuse(control.client, control.seq, ResultCode::invalid_value, fault.what());
    }
  }
  if (!inbox_.push(std::move(order)))
    refuse(control.client, control.seq, ResultCode::inbox_full,
           "as many controls as may wait for the next frame do: send it again later");
}

void CommandReceiver::refuse(std::uint64_t client, std::uint64_t seq, ResultCode code,
                             std::string reason) {
  if (const auto held_back = refusals_.admit(RepeatLimiter::Time::clock::now()))
    logger_->warn("command_refused client={} seq={} code={} reason={} more={}", client, seq,
                  name_of<ResultCode>(kResultCodeNames, code), poinsot::quoted(reason), *held_back);
  if (!clients_.refuse(client, SteadyTime::now())) return;  // a flood gets no flood of answers
  if (inbox_.waits(client, seq)) return;  // sent again: the first one's reply is still to come
  Reply reply;
  reply.client = client;
  reply.seq = seq;
  reply.epoch = epoch_();
  reply.code = code;
  reply.message = std::move(reason);
  outbox_.push(std::move(reply));
}

void CommandReceiver::note_lost(const WriterKey& writer) {
  const std::lock_guard lock(mutex_);
  lost_.push_back(writer);
  if (listens_) waiter_.wake();
}

void CommandReceiver::release_lost(std::vector<WriterKey>& writers) {
  std::vector<std::uint64_t> clients;
  for (const WriterKey& writer : writers) clients_.lose(writer, SteadyTime::now(), clients);
  writers.clear();
  for (const std::uint64_t client : clients) {
    RunControl release;
    release.client = client;
    release.seq = kOwnSeq;
    release.action = ControlAction::release;
    inbox_.push_own(Order{.control = std::move(release)});
    if (const auto held_back = departures_.admit(RepeatLimiter::Time::clock::now()))
      logger_->info("client_left client={} more={}", client, *held_back);
  }
}

}  // namespace poinsot
