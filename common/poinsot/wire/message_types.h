// Protocol struct → generated type and its type support. Private to this module.

#pragma once

#include "poinsot/msg/controlPubSubTypes.h"
#include "poinsot/msg/posesPubSubTypes.h"
#include "poinsot/msg/replyPubSubTypes.h"
#include "poinsot/msg/reportPubSubTypes.h"
#include "poinsot/msg/scenePubSubTypes.h"
#include "poinsot/msg/wrenchPubSubTypes.h"
#include "poinsot/wire/topics.h"

namespace poinsot {

template <class Message>
struct MessageType;
template <>
struct MessageType<PoseSnapshot> {
  using Support = msg::v1::PoseFramePubSubType;
};
template <>
struct MessageType<BodyInfo> {
  using Support = msg::v1::BodyDescriptionPubSubType;
};
template <>
struct MessageType<RunReport> {
  using Support = msg::v1::RunStatusPubSubType;
};
template <>
struct MessageType<WrenchCommand> {
  using Support = msg::v1::BodyWrenchPubSubType;
};
template <>
struct MessageType<RunControl> {
  using Support = msg::v1::RunRequestPubSubType;
};
template <>
struct MessageType<Reply> {
  using Support = msg::v1::CommandReplyPubSubType;
};

}  // namespace poinsot
