// Whether two programs on this machine meet, and who is out there.

#pragma once

#include <string>

#include "poinsot/cli/context.h"
#include "poinsot/cli/findings.h"

namespace poinsot {

// Starts this program again as a peer, meets it and exchanges a message.
Finding check_meeting(const Context& context);
// The other side of it: ends after one answer, or when none is asked for. `meeting` names both.
ExitCode be_peer(const Context& context, const std::string& meeting);

// The worlds that answer, a line for each.
Findings check_worlds(const Context& context);

}  // namespace poinsot
