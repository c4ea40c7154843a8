#include "poinsot/cli/connect.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <unistd.h>

#include <spdlog/fmt/fmt.h>

#include "poinsot/wire/participant.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Duration = std::chrono::nanoseconds;

// How often "waiting" may be said, if it is to be said.
constexpr Duration kSlice = 100ms;
// Daemons on this host announce themselves within this time.
constexpr Duration kDiscovery = 1s;

// Waits in slices up to a limit, and says so when it is not over at once.
class Patience {
 public:
  explicit Patience(Duration limit) : end_(Clock::now() + std::min<Duration>(limit, 8760h)) {}

  bool is_over() const { return Clock::now() >= end_; }

  Duration next(Duration slice) {
    if (Clock::now() >= tell_at_) {
      std::fputs("waiting for server…\n", stderr);
      tell_at_ = Clock::time_point::max();
    }
    return std::clamp<Duration>(end_ - Clock::now(), 0ns, slice);
  }

 private:
  Clock::time_point end_;
  Clock::time_point tell_at_ = Clock::now() + 1s;  // a server that runs is usually met before
};

// The calls of one user on one host are one client on the bus: what one call holds, a later one can
// clear.
std::uint64_t tool_identity() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  const std::string who = std::string(host.data()) + ":" + std::to_string(getuid());
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const char c : who) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return std::max<std::uint64_t>(hash, 1);  // 0 would be none
}

}  // namespace

void route_log(const Logger& logger) {
  route_bus_log([logger](BusLogLevel level, const std::string& message) {
    const bool error = level == BusLogLevel::error;
    logger->log(error ? spdlog::level::warn : spdlog::level::info, "bus message={}",
                poinsot::quoted(message));
  });
}

void add_connection_options(CLI::App& app, ConnectionFlags& flags) {
  app.add_option("--world", flags.world, "world to talk to; may be left out if there is only one")
      ->type_name("WORLD");
  add_bus_options(app, flags.bus);
  add_duration_option(app, "--timeout", flags.timeout, "how long to wait for an answer [5s]");
}

std::string no_server_text(const ConnectionFlags& flags, std::string_view what) {
  return fmt::format(
      "{} (waited {:g} s, on {})\n"
      "Start a server with 'poinsotd run SCENE', or look elsewhere: --domain N (or the environment "
      "variable POINSOT_DOMAIN_ID), --listen lan.",
      what, std::chrono::duration<double>(flags.timeout).count(),
      flags.bus.lan ? "the local network" : "this host");
}

ClientOptions client_options(const Context& context) {
  const ConnectionFlags& flags = context.flags;
  ClientOptions options;
  options.world = flags.world;
  options.domain = flags.bus.domain;
  options.lan = flags.bus.lan;
  options.client = tool_identity();
  options.partition = flags.bus.partition;
  options.discovery_server = flags.bus.discovery_server;
  options.poses = std::nullopt;
  options.shared_memory = false;
  options.stop = context.stop;
  return options;
}

Client connect(const Context& context, const ClientOptions& options) {
  route_log(context.logger);
  Client client(options);
  Patience patience(context.flags.timeout);
  while (true) {
    try {
      client.wait_for_server(patience.next(kSlice));
      return client;
    } catch (const SeveralWorlds& several) {
      throw NoAnswer(std::string(several.what()) + " (--world NAME)");
    } catch (const NoAnswer& none) {
      if (patience.is_over()) throw NoAnswer(no_server_text(context.flags, none.what()));
    }
  }
}

Client connect(const Context& context) {
  return connect(context, client_options(context));
}

Client connect(const Context& context, const PoseFilter& filter) {
  ClientOptions options = client_options(context);
  options.poses = filter;
  options.shared_memory = true;
  return connect(context, options);
}

Client connect_to_listen(const Context& context) {
  ClientOptions options = client_options(context);
  options.shared_memory = true;
  return connect(context, options);
}

std::vector<std::string> wait_for_worlds(const Context& context) {
  const ConnectionFlags& flags = context.flags;
  route_log(context.logger);
  Patience patience(flags.timeout);
  do {
    std::vector<std::string> worlds =
        find_worlds(client_options(context), patience.next(kDiscovery));
    if (!worlds.empty()) return worlds;
  } while (!patience.is_over());
  throw NoAnswer(
      no_server_text(flags, "no daemon found on domain " + std::to_string(flags.bus.domain)));
}

}  // namespace poinsot
