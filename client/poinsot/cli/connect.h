// Finding a daemon, with patience and plain words.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "poinsot/cli/context.h"
#include "poinsot/client/client.h"

namespace poinsot {

// --world, --domain, --listen, --partition, --discovery-server, --timeout.
void add_connection_options(CLI::App& app, ConnectionFlags& flags);

// A client as the options say, that asks and leaves: no poses, no shared memory.
ClientOptions client_options(const Context& context);

// Waits for the daemon; says "waiting for server…" on stderr if it is not there at once. Throws
// NoAnswer with what to try.
Client connect(const Context& context, const ClientOptions& options);
Client connect(const Context& context);                            // client_options
Client connect(const Context& context, const PoseFilter& filter);  // that receives these poses
Client connect_to_listen(const Context& context);                  // that receives other streams

// Fast DDS's own log lines to the tool's log, for the whole process.
void route_log(const Logger& logger);

// Worlds of all daemons on the domain, sorted; at least one, else throws NoAnswer.
std::vector<std::string> wait_for_worlds(const Context& context);

// `what`, where and how long was waited, and what to try.
std::string no_server_text(const ConnectionFlags& flags, std::string_view what);

}  // namespace poinsot
