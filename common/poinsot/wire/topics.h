// Topic names: poinsot/<world>/<topic>. One row per topic: its name and the plain struct it
// carries.

#pragma once

#include <string>
#include <string_view>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

template <class Message>
inline constexpr std::string_view kTopicName = "";
template <>
inline constexpr std::string_view kTopicName<PoseSnapshot> = "poses";
template <>
inline constexpr std::string_view kTopicName<BodyInfo> = "scene";
template <>
inline constexpr std::string_view kTopicName<RunReport> = "report";
template <>
inline constexpr std::string_view kTopicName<WrenchCommand> = "wrench";
template <>
inline constexpr std::string_view kTopicName<RunControl> = "control";
template <>
inline constexpr std::string_view kTopicName<Reply> = "reply";
template <>
inline constexpr std::string_view kTopicName<ImpactNotice> = "events";
template <>
inline constexpr std::string_view kTopicName<ContactSnapshot> = "contacts";
template <>
inline constexpr std::string_view kTopicName<HeldList> = "held";

inline std::string topic_name(std::string_view world, std::string_view topic) {
  return "poinsot/" + std::string(world) + "/" + std::string(topic);
}

}  // namespace poinsot
