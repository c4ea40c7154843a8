// Protocol struct → generated type and its type support. Private to this module.

#pragma once

#include <exception>

#include "poinsot/msg/contactsPubSubTypes.h"
#include "poinsot/msg/controlPubSubTypes.h"
#include "poinsot/msg/eventsPubSubTypes.h"
#include "poinsot/msg/heldPubSubTypes.h"
#include "poinsot/msg/posesPubSubTypes.h"
#include "poinsot/msg/replyPubSubTypes.h"
#include "poinsot/msg/reportPubSubTypes.h"
#include "poinsot/msg/scenePubSubTypes.h"
#include "poinsot/msg/wrenchPubSubTypes.h"
#include "poinsot/wire/topics.h"

namespace poinsot {

// A generated type support that lets no exception out: bytes that are no message are a refused
// sample, not the end of the process.
template <class Support>
class SafeSupport : public Support {
 public:
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return Support::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

template <class Message>
struct MessageType;
template <>
struct MessageType<PoseSnapshot> {
  using Support = SafeSupport<msg::v2::PoseFramePubSubType>;
};
template <>
struct MessageType<BodyInfo> {
  using Support = SafeSupport<msg::v3::BodyDescriptionPubSubType>;
};
template <>
struct MessageType<RunReport> {
  using Support = SafeSupport<msg::v5::RunStatusPubSubType>;
};
template <>
struct MessageType<WrenchCommand> {
  using Support = SafeSupport<msg::v2::BodyWrenchPubSubType>;
};
template <>
struct MessageType<RunControl> {
  using Support = SafeSupport<msg::v2::RunRequestPubSubType>;
};
template <>
struct MessageType<Reply> {
  using Support = SafeSupport<msg::v2::CommandReplyPubSubType>;
};
template <>
struct MessageType<ImpactNotice> {
  using Support = SafeSupport<msg::v2::ImpactEventPubSubType>;
};
template <>
struct MessageType<ContactSnapshot> {
  using Support = SafeSupport<msg::v1::ContactFramePubSubType>;
};
template <>
struct MessageType<HeldList> {
  using Support = SafeSupport<msg::v1::HeldWrenchesPubSubType>;
};

}  // namespace poinsot
