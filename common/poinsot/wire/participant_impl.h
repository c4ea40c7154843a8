// The inside of a Participant, shared with its endpoints so that it outlives them. Private to this
// module.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "poinsot/wire/participant.h"

namespace poinsot {

// Who publishes poinsot/<world>/report, and who reads filtered streams of poses: kept up to date
// from discovery, on a thread of Fast DDS.
class WorldDirectory : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  explicit WorldDirectory(std::string partition) : partition_(std::move(partition)) {}

  std::vector<std::string> worlds() const;
  std::vector<std::string> pose_streams(std::string_view world) const;
  std::uint64_t pose_stream_changes() const { return stream_changes_; }

  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;

 private:
  mutable std::mutex mutex_;
  std::string partition_;
  std::map<eprosima::fastrtps::rtps::GUID_t, std::string> worlds_;   // by writer
  std::map<eprosima::fastrtps::rtps::GUID_t, std::string> streams_;  // topic, by reader
  std::atomic<std::uint64_t> stream_changes_ = 0;
};

// Owns the Fast DDS participant. Endpoints are made through it and removed by themselves.
class BusCore {
 public:
  explicit BusCore(const BusOptions& options);
  ~BusCore();
  BusCore(const BusCore&) = delete;
  BusCore& operator=(const BusCore&) = delete;

  // The topic, made on first use. Throws Error naming it.
  eprosima::fastdds::dds::Topic* topic(const std::string& name,
                                       eprosima::fastdds::dds::TypeSupport type);

  // Nobody of this participant uses the topic any more, or not this one.
  void forget(eprosima::fastdds::dds::Topic* topic);

  eprosima::fastdds::dds::Publisher* publisher() const { return publisher_; }
  eprosima::fastdds::dds::Subscriber* subscriber() const { return subscriber_; }
  const WorldDirectory& directory() const { return directory_; }

 private:
  WorldDirectory directory_;
  std::mutex topics_mutex_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
};

struct Participant::Impl {
  std::shared_ptr<BusCore> core;
};

// "poinsot/<world>/<topic>", or with "/<suffix>"; throws Error if the world's name has other
// characters than letters, digits, '_' and '-'.
std::string checked_topic_name(std::string_view world, std::string_view topic,
                               std::string_view suffix = {});

}  // namespace poinsot
