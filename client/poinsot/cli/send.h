// One command or control: sends it, prints the answer in words or as JSON, and makes it an exit
// code.

#pragma once

#include <string_view>

#include "poinsot/cli/context.h"
#include "poinsot/client/client.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

// A wrench outlives the tool that sends it. `verb`: what a refusal is called.
ExitCode send(const Context& context, Client& client, WrenchCommand command, std::string_view verb,
              bool json);
ExitCode send(const Context& context, const WrenchCommand& command, std::string_view verb,
              bool json);

ExitCode send(const Context& context, const RunControl& control, bool json);

}  // namespace poinsot
