// A type under whose name any bytes can be sent: what a careless or hostile peer may write. The
// samples of its writer are vectors of bytes, the CDR header included.

#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include "poinsot/wire/message_types.h"
#include "poinsot/wire/participant_impl.h"
#include "poinsot/wire/qos.h"

namespace poinsot {

using Bytes = std::vector<unsigned char>;

class RawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  static constexpr std::uint32_t kMaxSize = 1u << 20;  // [bytes] of a sample

  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = kMaxSize;
    m_isGetKeyDefined = false;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<Bytes*>(data);
    if (!bytes.empty()) std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return nullptr; }
  void deleteData(void*) override {}
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

// A writer of `type` on the topic of Message, under the topic's own quality of service; `change`
// may alter that. It belongs to the participant.
template <class Message>
eprosima::fastdds::dds::DataWriter* foreign_writer(
    Participant& participant, const std::string& world, eprosima::fastdds::dds::TypeSupport type,
    const std::function<void(eprosima::fastdds::dds::DataWriterQos&)>& change = {}) {
  BusCore& core = *participant.impl().core;
  auto* topic = core.topic(topic_name(world, kTopicName<Message>), type);
  auto qos = core.publisher()->get_default_datawriter_qos();
  set_writer_qos(topic_qos(kTopicName<Message>), qos);
  if (change) change(qos);
  return core.publisher()->create_datawriter(topic, qos);
}

inline bool is_matched(const eprosima::fastdds::dds::DataWriter* writer) {
  eprosima::fastdds::dds::PublicationMatchedStatus status;
  writer->get_publication_matched_status(status);
  return status.current_count == 1;
}

}  // namespace poinsot
