// Protocol structs ↔ generated message types. Private to this module.
//
// from_message() checks everything that the sender could have got wrong: finite numbers, unit
// quaternions, known enumerators, sizes, texts. Both return why not, in words, or an empty string;
// after a refusal the output is unspecified. Outputs are reused: a steady stream does not allocate.

#pragma once

#include <string>

#include "poinsot/msg/contacts.h"
#include "poinsot/msg/control.h"
#include "poinsot/msg/events.h"
#include "poinsot/msg/held.h"
#include "poinsot/msg/poses.h"
#include "poinsot/msg/reply.h"
#include "poinsot/msg/report.h"
#include "poinsot/msg/scene.h"
#include "poinsot/msg/wrench.h"
#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

std::string to_message(const PoseSnapshot& in, msg::v2::PoseFrame& out);
std::string to_message(const BodyInfo& in, msg::v3::BodyDescription& out);
std::string to_message(const RunReport& in, msg::v5::RunStatus& out);
std::string to_message(const WrenchCommand& in, msg::v2::BodyWrench& out);
std::string to_message(const RunControl& in, msg::v2::RunRequest& out);
std::string to_message(const Reply& in, msg::v2::CommandReply& out);
std::string to_message(const ImpactNotice& in, msg::v2::ImpactEvent& out);
std::string to_message(const ContactSnapshot& in, msg::v1::ContactFrame& out);
std::string to_message(const HeldList& in, msg::v1::HeldWrenches& out);

std::string from_message(const msg::v2::PoseFrame& in, PoseSnapshot& out);
std::string from_message(const msg::v3::BodyDescription& in, BodyInfo& out);
std::string from_message(const msg::v5::RunStatus& in, RunReport& out);
std::string from_message(const msg::v2::BodyWrench& in, WrenchCommand& out);
std::string from_message(const msg::v2::RunRequest& in, RunControl& out);
std::string from_message(const msg::v2::CommandReply& in, Reply& out);
std::string from_message(const msg::v2::ImpactEvent& in, ImpactNotice& out);
std::string from_message(const msg::v1::ContactFrame& in, ContactSnapshot& out);
std::string from_message(const msg::v1::HeldWrenches& in, HeldList& out);

}  // namespace poinsot
