// Texts for programs: one JSON object a line, numbers with all their digits (they read back as the
// same double), 64-bit hashes and session numbers as 16 hexadecimal digits in a string.

#pragma once

#include <string>
#include <vector>

#include "poinsot/cli/roster.h"
#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// {"frame", "time" [s], "bodies": [{"name", "position": [x, y, z], "orientation": {x, y, z, w},
//   "linear_velocity": [x, y, z], "angular_velocity": [x, y, z]}]}; units and frames of BodyState.
// A frame of which only some bodies were sent also has "complete": false.
std::string pose_json(const PoseSnapshot& poses, const Roster& roster, double frame_rate);

// {"frame", "epoch", "time" [s], "a": {"name", "linear_before", "angular_before", "linear_after",
//   "angular_after"}, "b": {…}, "point", "normal", "impulse"}; units and frames of ImpactNotice.
std::string impact_json(const ImpactNotice& impact, const std::string& a, const std::string& b);

// {"frame", "epoch", "time" [s], "left_out", "contacts": [{"a", "b", "point", "normal", "force"}]},
// of those of which a body is shown; units and frames of ContactState.
std::string contacts_json(const ContactSnapshot& contacts, const Roster& roster, double frame_rate);

// {"body", "kind", "slot", "code", "message", "epoch", "first_frame", "last_frame", "start_time",
// "end_time"}; last_frame and end_time are null until cleared; times [s] are those of the frames'
// boundaries.
std::string push_json(const WrenchCommand& command, const Reply& reply, double frame_rate);

// {"action", "code", "message", "epoch", "frame", "time", "state_hash"}.
std::string control_json(std::string_view action, const Reply& reply, double frame_rate);

// The report, with its fields' own names and units, spreads as {"p50", "p99", "max"} [s]. "methods"
// counts bodies by method; "body_methods" is [{"name", "method"}] in the order of the scene, or
// [{"index", "method"}] if `bodies` are not those of the report.
std::string status_json(const std::string& world, const RunReport& report,
                        const std::vector<BodyInfo>& bodies);

// {"world", "state", "frame", "time", "frame_rate", "bodies": [{"name", "static", "mass"}]}.
std::string list_json(const std::string& world, const RunReport& report,
                      const std::vector<BodyInfo>& bodies);

}  // namespace poinsot
