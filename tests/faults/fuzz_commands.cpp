// Sends spoilt commands and controls as valid RTPS samples, each acknowledged by the daemon's
// reader before it is forgotten, so that all of them arrive:
//
//   fuzz_commands DOMAIN WORLD SAMPLES [SEED]
//
// prints a line for each kind of payload: its name, samples on wrench, samples on control.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "faults/payloads.h"
#include "poinsot/wire/convert.h"
#include "support/raw_type.h"
#include "support/test_domain.h"

namespace poinsot::faults {
namespace {

namespace dds = eprosima::fastdds::dds;
using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

template <class Message>
Bytes serialized(const Message& message) {
  typename MessageType<Message>::Support support;
  typename MessageType<Message>::Support::type sample;
  if (const std::string fault = to_message(message, sample); !fault.empty())
    throw std::runtime_error(fault);
  Payload payload(support.getSerializedSizeProvider(&sample)());
  if (!support.serialize(&sample, &payload)) throw std::runtime_error("cannot serialize");
  return Bytes(payload.data, payload.data + payload.length);
}

// One topic, its valid payload and its writer.
class Target {
 public:
  template <class Message>
  Target(Participant& participant, const std::string& world, const Message& message)
      : valid_(serialized(message)) {
    typename MessageType<Message>::Support support;
    writer_ = foreign_writer<Message>(participant, world,
                                      dds::TypeSupport(new RawType(support.getName())),
                                      [](dds::DataWriterQos& qos) {
                                        qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
                                        qos.resource_limits().max_samples = 64;
                                        qos.reliability().max_blocking_time = {1, 0};
                                      });
    if (writer_ == nullptr) throw std::runtime_error("no writer");
    if (!eventually([&] { return is_matched(writer_); })) throw std::runtime_error("no daemon");
  }

  void send(Kind kind, Random& random) {
    Bytes bytes = spoil(valid_, kind, random);
    // A full history is refused early at times, long before the time that it may block.
    if (!eventually([&] { return writer_->write(&bytes); }))
      throw std::runtime_error("the daemon takes nothing any more; the next was " +
                               std::string(kKindNames[static_cast<std::size_t>(kind)]) + " of " +
                               std::to_string(bytes.size()) + " bytes");
    ++sent_[static_cast<std::size_t>(kind)];
  }

  void wait_until_taken() {
    if (writer_->wait_for_acknowledgments({20, 0}) !=
        eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      throw std::runtime_error("not all was acknowledged");
  }

  std::size_t sent(std::size_t kind) const { return sent_[kind]; }

 private:
  Bytes valid_;
  dds::DataWriter* writer_ = nullptr;
  std::array<std::size_t, kKindNames.size()> sent_ = {};
};

WrenchCommand harmless_wrench() {
  WrenchCommand command;
  command.client = 0xF0CCA;
  command.seq = 1;
  command.epoch = kNoSuchNumber;
  command.body = {kNoSuchNumber, kNoSuchNumber};
  command.body_name = kNoSuchBody;
  command.force = {1, 2, 3};
  command.hold = Hold::until_cleared;
  return command;
}

RunControl harmless_control() {
  return {.client = 0xF0CCB, .seq = 1, .epoch = kNoSuchNumber, .action = ControlAction::reset};
}

int fuzz(int domain, const std::string& world, int samples, std::uint64_t seed) {
  Participant participant({.domain = domain});
  Target wrench(participant, world, harmless_wrench());
  Target control(participant, world, harmless_control());
  Random random(seed);
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < samples; ++i) {
    const auto kind = static_cast<Kind>(static_cast<std::size_t>(i / 2) % kKindNames.size());
    (i % 2 == 0 ? wrench : control).send(kind, random);
  }
  wrench.wait_until_taken();
  control.wait_until_taken();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  for (std::size_t kind = 0; kind < kKindNames.size(); ++kind)
    std::printf("%s %zu %zu\n", kKindNames[kind], wrench.sent(kind), control.sent(kind));
  std::fprintf(stderr, "%d samples in %.2f s, all taken\n", samples, elapsed.count());
  return 0;
}

}  // namespace
}  // namespace poinsot::faults

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::fprintf(stderr, "usage: fuzz_commands DOMAIN WORLD SAMPLES [SEED]\n");
    return 2;
  }
  const std::uint64_t seed = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
  return poinsot::faults::fuzz(std::atoi(argv[1]), argv[2], std::atoi(argv[3]), seed);
} catch (const std::exception& error) {
  std::fprintf(stderr, "fuzz_commands: %s\n", error.what());
  return 1;
}
