#include "poinsot/wire/qos.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fastdds/rtps/transport/TransportInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include "poinsot/base/check.h"
#include "poinsot/base/error.h"
#include "poinsot/base/limits.h"
#include "poinsot/wire/packet_check.h"
#include "poinsot/wire/packet_guard.h"
#include "poinsot/wire/queue_number.h"

namespace poinsot {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::Duration_t;

constexpr int kBodies = static_cast<int>(kMaxBodies);

// Poses: a writer depth of 4 survives the repair of a lost fragment; the reader's second of frames
// is what a busy program may fall behind without a gap. Commands: see the reader that keeps all.
constexpr std::array<TopicQos, 9> kTopics = {{
    // topic    late joiners  writer  reader  keeps all  instances
    {"poses", false, 4, 60, false, 1},
    {"scene", true, 1, 1, false, kBodies},
    {"report", true, 1, 1, false, 1},
    {"wrench", false, 256, 1024, true, 1},
    {"control", false, 256, 1024, true, 1},
    {"reply", false, 1024, 1024, false, 1},
    {"events", false, 1000, 1000, false, 1},
    {"contacts", false, 4, 60, false, 1},
    {"held", false, 1, 1, false, 1},
}};

constexpr std::uint32_t kMegabyte = 1u << 20;
constexpr std::uint32_t kPoseBytes = 112;      // of one body in a frame
constexpr std::uint32_t kFramesInSegment = 6;  // fewer, and frames arrive by repair only
constexpr std::uint32_t kMaxMessage = 65500;   // [bytes] one datagram; larger samples are fragments
constexpr std::uint32_t kSocketBuffer = 4 * kMegabyte;
constexpr int kLeaseMs = 3000;  // who is not heard of for so long is gone
constexpr const char* kLoopback = "127.0.0.1";
// Of the server with number 0, as `fastdds discovery -i 0` starts it.
constexpr const char* kServerPrefix = "44.53.00.5f.45.50.52.4f.53.49.4d.41";
constexpr const char* kMulticast = "239.255.0.1";  // RTPS default, section 9.6.1.4.1

Duration_t milliseconds(int n) {
  return {n / 1000, static_cast<std::uint32_t>(n % 1000) * 1'000'000u};
}

dds::ResourceLimitsQosPolicy limits(const TopicQos& topic, int depth) {
  dds::ResourceLimitsQosPolicy limits;
  limits.max_instances = topic.instances;
  limits.max_samples_per_instance = depth;
  limits.max_samples = topic.instances * depth;
  limits.allocated_samples = std::min(limits.max_samples, 16);
  return limits;
}

// Port 0: the ports of the first kMaxLocalParticipants participants.
eprosima::fastrtps::rtps::Locator_t udp_locator(const char* address, std::uint32_t port) {
  eprosima::fastrtps::rtps::Locator_t locator;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(locator, address);
  locator.port = port;
  return locator;
}

// Discovery through a server that passes everything on: worlds are found by their topics.
void set_discovery_server(const std::string& address,
                          eprosima::fastrtps::rtps::DiscoverySettings& discovery) {
  const std::size_t colon = address.rfind(':');
  int port = 0;
  const char* const last = address.data() + address.size();
  if (colon != std::string::npos) std::from_chars(address.data() + colon + 1, last, port);
  eprosima::fastrtps::rtps::Locator_t locator;
  if (port <= 0 || port > 65535 ||
      !eprosima::fastrtps::rtps::IPLocator::setIPv4(locator, address.substr(0, colon)))
    throw Error("discovery server '" + address +
                "': give it as address:port, like 127.0.0.1:11811");
  locator.port = static_cast<std::uint32_t>(port);
  rtps::RemoteServerAttributes server;
  server.metatrafficUnicastLocatorList.push_back(locator);
  server.ReadguidPrefix(kServerPrefix);
  discovery.discoveryProtocol = eprosima::fastrtps::rtps::DiscoveryProtocol_t::SUPER_CLIENT;
  discovery.m_DiscoveryServers.push_back(server);
}

// Only the transport knows what marks a queue as one of this host.
void add_queue(const rtps::SharedMemTransportDescriptor& descriptor, rtps::LocatorList& locators) {
  const std::unique_ptr<rtps::TransportInterface> transport(descriptor.create_transport());
  transport->getDefaultUnicastLocators(locators, draw_queue_number());
}

}  // namespace

const TopicQos& topic_qos(std::string_view topic) {
  const auto row = std::find_if(kTopics.begin(), kTopics.end(), [&](const TopicQos& candidate) {
    return candidate.topic == topic;
  });
  POINSOT_CHECK(row != kTopics.end());
  return *row;
}

void set_writer_qos(const TopicQos& topic, dds::DataWriterQos& qos) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = milliseconds(5);
  qos.durability().kind =
      topic.late_joiners ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.writer_depth;
  qos.resource_limits() = limits(topic, topic.writer_depth);
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  // A sample that was lost is noticed after this time, if no other follows it.
  qos.reliable_writer_qos().times.heartbeatPeriod = milliseconds(100);
}

void set_reader_qos(const TopicQos& topic, dds::DataReaderQos& qos) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      topic.late_joiners ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind =
      topic.reader_keeps_all ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.reader_depth;
  qos.resource_limits() = limits(topic, topic.reader_depth);
  qos.data_sharing().off();
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

std::uint32_t segment_size(std::size_t bodies) {
  const std::size_t wanted = kFramesInSegment * bodies * kPoseBytes + kMegabyte;
  return static_cast<std::uint32_t>(
      std::clamp<std::size_t>(wanted, kMegabyte, std::size_t{128} * kMegabyte));
}

void set_participant_qos(const BusOptions& options, dds::DomainParticipantQos& qos) {
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBuffer;  // the kernel grants what net.core allows
  udp->receiveBufferSize = kSocketBuffer;
  udp->maxMessageSize = kMaxMessage;
  udp->maxInitialPeersRange = static_cast<std::uint32_t>(kMaxLocalParticipants);
  if (!options.lan) udp->interfaceWhiteList.emplace_back(kLoopback);
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = {
      guarded(udp, options.commands_only ? kMaxCommandSample : kMaxSample)};

  // Discovery goes over UDP alone, data over either: shared memory under a number of our own.
  auto& wire = qos.wire_protocol();
  const eprosima::fastrtps::rtps::Locator_t any_udp;  // any allowed address, the port of our number
  wire.builtin.metatrafficUnicastLocatorList.push_back(any_udp);
  wire.default_unicast_locator_list.push_back(any_udp);
  if (options.shared_memory) {
    auto shared_memory = std::make_shared<rtps::SharedMemTransportDescriptor>();
    shared_memory->segment_size(segment_size(options.bodies));
    shared_memory->max_message_size(kMaxMessage);
    qos.transport().user_transports.push_back(shared_memory);
    add_queue(*shared_memory, wire.default_unicast_locator_list);
  }

  auto& discovery = wire.builtin.discovery_config;
  discovery.leaseDuration = milliseconds(kLeaseMs);
  // Fast DDS 2.9.1 announces a newcomer before it listens: a quick answer is lost, and it waits for
  // the next announcement.
  discovery.leaseDuration_announcementperiod = milliseconds(250);
  discovery.initial_announcements = {10, milliseconds(50)};
  // Loopback need not be able to multicast: participants of this host are greeted one by one.
  wire.builtin.initialPeersList.push_back(udp_locator(kLoopback, 0));
  if (!options.discovery_server.empty()) set_discovery_server(options.discovery_server, discovery);
  if (!options.lan) return;
  // Those of other hosts hear of us there, and we of them: with the unicast locators of our own,
  // Fast DDS does not listen there by itself.
  const auto everyone = udp_locator(
      kMulticast, wire.port.getMulticastPort(static_cast<std::uint32_t>(options.domain)));
  wire.builtin.initialPeersList.push_back(everyone);
  wire.builtin.metatrafficMulticastLocatorList.push_back(everyone);
}

}  // namespace poinsot
