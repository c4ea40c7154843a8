#include "poinsot/wire/participant_numbers.h"

#include <algorithm>
#include <set>
#include <string>
#include <unistd.h>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "poinsot/wire/participant.h"
#include "poinsot/wire/qos.h"

namespace poinsot {
namespace {

namespace dds = eprosima::fastdds::dds;

bool has_queue(std::uint32_t port) {
  return access(("/dev/shm/fastrtps_port" + std::to_string(port)).c_str(), F_OK) == 0;
}

std::set<int> taken_in_this_process() {
  std::set<int> taken;
  const auto* factory = dds::DomainParticipantFactory::get_instance();
  for (int domain = 0; domain <= kMaxDomain; ++domain)
    for (const auto* other : factory->lookup_participants(static_cast<std::uint32_t>(domain)))
      taken.insert(other->get_qos().wire_protocol().participant_id);
  return taken;
}

}  // namespace

std::vector<int> participant_numbers(int domain, const dds::DomainParticipantQos& qos) {
  const auto ports = qos.wire_protocol().port;
  // Ports of number n, RTPS 9.6.1: discovery at d1 + gain n, data at d3 + gain n.
  const auto is_unused = [&](int number) {
    const std::uint32_t discovery = ports.getUnicastPort(static_cast<std::uint32_t>(domain),
                                                         static_cast<std::uint32_t>(number));
    return !has_queue(discovery) && !has_queue(discovery - ports.offsetd1 + ports.offsetd3);
  };
  const std::set<int> taken = taken_in_this_process();
  std::vector<int> numbers;
  for (int number = 0; number < kMaxLocalParticipants; ++number)
    if (!taken.contains(number)) numbers.push_back(number);
  const auto used = std::stable_partition(numbers.begin(), numbers.end(), is_unused);
  if (used != numbers.end())
    std::rotate(used, used + getpid() % (numbers.end() - used), numbers.end());
  return numbers;
}

}  // namespace poinsot
