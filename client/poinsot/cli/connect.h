// Finding a daemon, with patience and plain words.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "poinsot/cli/context.h"
#include "poinsot/client/client.h"
#include "poinsot/program/signals.h"

namespace poinsot {

// --world, --domain, --listen, --timeout.
void add_connection_options(CLI::App& app, ConnectionFlags& flags);

// Waits for the daemon; says "waiting for server…" on stderr if it is not there at once. Throws
// NoAnswer with what to try, or Interrupted as soon as `stop` (if given) is asked for.
Client connect(const Context& context, StopSignals* stop = nullptr);

// Worlds of all daemons on the domain, sorted; at least one, else throws NoAnswer.
std::vector<std::string> wait_for_worlds(const Context& context);

// `what`, where and how long was waited, and what to try.
std::string no_server_text(const ConnectionFlags& flags, std::string_view what);

}  // namespace poinsot
