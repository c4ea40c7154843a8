#include "poinsot/wire/diagnosis.h"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/rtps/common/PortParameters.h>
#include <fastrtps/config.h>

#include "poinsot/wire/qos.h"

namespace poinsot {

std::string bus_library() {
  return "Fast DDS " FASTRTPS_VERSION_STR;
}

bool takes_profiles(const std::string& file) {
  auto* factory = eprosima::fastdds::dds::DomainParticipantFactory::get_instance();
  return factory->load_XML_profiles_file(file) ==
         eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}

PortPlan port_plan(int domain) {
  const eprosima::fastrtps::rtps::PortParameters ports;  // the standard's numbers
  const auto base = ports.portBase + ports.domainIDGain * domain;
  PortPlan plan;
  plan.multicast = base + ports.offsetd0;
  for (int number = 0; number < kMaxLocalParticipants; ++number) {
    plan.unicast.push_back(base + ports.offsetd1 + ports.participantIDGain * number);
    plan.unicast.push_back(base + ports.offsetd3 + ports.participantIDGain * number);
  }
  return plan;
}

}  // namespace poinsot
