// Protocol structs ↔ generated message types. Private to this module.
//
// from_message() checks everything that the sender could have got wrong: finite numbers, unit
// quaternions, known enumerators, sizes, texts. Both return why not, in words, or an empty string;
// after a refusal the output is unspecified. Outputs are reused: a steady stream does not allocate.

#pragma once

#include <string>

#include "poinsot/msg/control.h"
#include "poinsot/msg/events.h"
#include "poinsot/msg/poses.h"
#include "poinsot/msg/reply.h"
#include "poinsot/msg/report.h"
#include "poinsot/msg/scene.h"
#include "poinsot/msg/wrench.h"
#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

std::string to_message(const PoseSnapshot& in, msg::v1::PoseFrame& out);
std::string to_message(const BodyInfo& in, msg::v2::BodyDescription& out);
std::string to_message(const RunReport& in, msg::v4::RunStatus& out);
std::string to_message(const WrenchCommand& in, msg::v1::BodyWrench& out);
std::string to_message(const RunControl& in, msg::v1::RunRequest& out);
std::string to_message(const Reply& in, msg::v1::CommandReply& out);
std::string to_message(const ImpactNotice& in, msg::v1::ImpactEvent& out);

std::string from_message(const msg::v1::PoseFrame& in, PoseSnapshot& out);
std::string from_message(const msg::v2::BodyDescription& in, BodyInfo& out);
std::string from_message(const msg::v4::RunStatus& in, RunReport& out);
std::string from_message(const msg::v1::BodyWrench& in, WrenchCommand& out);
std::string from_message(const msg::v1::RunRequest& in, RunControl& out);
std::string from_message(const msg::v1::CommandReply& in, Reply& out);
std::string from_message(const msg::v1::ImpactEvent& in, ImpactNotice& out);

}  // namespace poinsot
