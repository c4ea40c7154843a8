// Which number a new participant takes. Private to this module.
//
// A participant's ports follow from its domain and number, and participants of one host greet the
// ports of the first kMaxLocalParticipants numbers. Fast DDS would count a process's participants
// without end, and take the number of a participant that left or died: then those who still hold
// its receive queue in shared memory write into nowhere, and meet the new one only after seconds.

#pragma once

#include <vector>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

namespace poinsot {

// Numbers that no participant of this process has, the best first: those without a queue in shared
// memory, lowest first; then the others, from a place that differs between processes.
std::vector<int> participant_numbers(int domain,
                                     const eprosima::fastdds::dds::DomainParticipantQos& qos);

}  // namespace poinsot
