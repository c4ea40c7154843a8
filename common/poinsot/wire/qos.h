// Quality of service: one table of topics, one set of rules for all. Private to this module.
//
// A writer keeps its last few samples and never waits for a reader. Nothing is left to defaults
// that differ between vendors or that depend on the type (data sharing, preallocation).

#pragma once

#include <string_view>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "poinsot/wire/participant.h"

namespace poinsot {

// Participants of one domain on this host that find each other: an announcement goes to the port of
// each. More would leave the range of ports on the highest domain, which ends the process.
inline constexpr int kMaxLocalParticipants = 32;

struct TopicQos {
  std::string_view topic;
  bool late_joiners;      // transient local: who comes later gets what the writer keeps
  int writer_depth;       // samples kept for repair, per body if keyed
  int reader_depth;       // samples kept until taken, per body if keyed
  bool reader_keeps_all;  // a full reader refuses (and is sent again) instead of forgetting
  int instances;          // 1: not keyed
};

// POINSOT_CHECKs that the topic exists.
const TopicQos& topic_qos(std::string_view topic);

void set_writer_qos(const TopicQos& topic, eprosima::fastdds::dds::DataWriterQos& qos);
void set_reader_qos(const TopicQos& topic, eprosima::fastdds::dds::DataReaderQos& qos);

// Transports, buffers, discovery.
void set_participant_qos(const BusOptions& options,
                         eprosima::fastdds::dds::DomainParticipantQos& qos);

// Bytes of the shared-memory segment of a participant that publishes `bodies` poses a frame.
std::uint32_t segment_size(std::size_t bodies);

}  // namespace poinsot
