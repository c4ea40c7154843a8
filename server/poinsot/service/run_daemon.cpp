#include "poinsot/service/run_daemon.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <utility>

#include "poinsot/base/error.h"
#include "poinsot/protocol/methods_text.h"
#include "poinsot/service/daemon.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

constexpr double kWeight = 9.81;  // [m/s²] to suggest a force by

// Two leading digits are enough for a suggestion.
double round_to_two_digits(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::round(x / unit) * unit;
}

// A name as one word of a shell's command line.
std::string shell_word(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '/';
  });
  if (plain && !name.empty() && name[0] != '-') return name;
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The options that lead a client to this daemon.
std::string address(const DaemonOptions& options) {
  std::string words;
  if (options.domain != DaemonOptions{}.domain)
    words += " --domain " + std::to_string(options.domain);
  if (options.lan) words += " --listen lan";
  if (!options.partition.empty()) words += " --partition " + shell_word(options.partition);
  if (!options.discovery_server.empty())
    words += " --discovery-server " + shell_word(options.discovery_server);
  return words;
}

// The first body of one shape: compounds are seldom small. Else the first that moves.
std::vector<BodyDef>::const_iterator body_to_push(const std::vector<BodyDef>& bodies) {
  const auto moves = [](const BodyDef& body) { return !body.is_static; };
  const auto simple = std::find_if(bodies.begin(), bodies.end(), [&](const BodyDef& body) {
    return moves(body) && body.shapes.size() == 1;
  });
  return simple != bodies.end() ? simple : std::find_if(bodies.begin(), bodies.end(), moves);
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

void route_to(const Logger& logger) {
  route_bus_log([logger](BusLogLevel level, const std::string& message) {
    logger->log(level == BusLogLevel::error ? spdlog::level::err : spdlog::level::debug,
                "bus message={}", poinsot::quoted(message));
  });
}

// The world's first daemon stays: this one has just come.
void refuse_taken_world(const Daemon& daemon, const DaemonOptions& options, StopSignals& signals) {
  constexpr auto kLook = 50ms;
  for (auto waited = 0ms; waited < Daemon::kDiscovery; waited += kLook) {
    if (daemon.is_taken())
      throw Error("--world: another daemon serves '" + daemon.world() + "' on domain " +
                  std::to_string(options.domain) + ": choose another name, or --take-over");
    if (signals.wait_for(kLook)) return;
  }
}

}  // namespace

std::string invitation(const Scene& scene, const DaemonOptions& options) {
  const auto body = body_to_push(scene.bodies);
  const std::string client = "  " + shell_word(options.client);
  std::string text = "In another terminal:\n" + client + " watch" + address(options) + "\n";
  if (body == scene.bodies.end()) return text;
  const std::string force =
      short_number(round_to_two_digits(1.5 * kWeight * body->mass_properties.mass));
  return text + client + " push " + shell_word(body->name) + " --force 0,0," + force +
         " --for 0.5s" + address(options) + "\n";
}

std::string status_line(const RunReport& r) {
  char line[384];
  std::snprintf(line, sizeof line,
                "frame %llu  time %.2f s  real-time factor %.3g  bodies %u  contacts %u  "
                "energy error %.2g  local error %.2g m %.2g rad  momentum error %.2g",
                static_cast<unsigned long long>(r.frame.frame), r.frame.sim_time,
                r.real_time_factor, r.frame.bodies, r.frame.contacts, r.frame.energy_error,
                r.frame.position_error, r.frame.orientation_error, r.frame.momentum_error);
  std::string text = line;
  if (const std::string methods = methods_text(r.frame); !methods.empty()) text += "  " + methods;
  if (r.state == RunState::paused) text += "  paused";
  if (r.epoch > 1) text += "  epoch " + std::to_string(r.epoch);
  if (r.time_scale == 0)
    text += "  as fast as it can";
  else if (r.time_scale != 1)
    text += "  time scale " + short_number(r.time_scale);
  if (!r.recording.empty()) text += "  recording " + r.recording;
  if (r.late_inputs > 0) text += "  late inputs " + std::to_string(r.late_inputs);
  if (r.overruns > 0) text += "  late frames " + std::to_string(r.overruns);
  if (r.frame.quarantined > 0) text += "  frozen bodies " + std::to_string(r.frame.quarantined);
  return text;
}

void run_daemon(Scene scene, const DaemonOptions& options, bool json, StopSignals& signals,
                const Logger& logger, std::ostream& out) {
  route_to(logger);
  const std::string welcome = invitation(scene, options);
  const auto look = [&](const Daemon& daemon) {
    if (!options.take_over) refuse_taken_world(daemon, options, signals);
  };
  // A run that writes nothing need not wait for the look around.
  const bool writes =
      !options.record.empty() || !options.trajectory.empty() || options.autosave.count() > 0;
  Daemon daemon(
      std::move(scene), options, logger, [&signals] { signals.request_stop(); },
      writes ? look : std::function<void(const Daemon&)>{});
  if (!json) out << welcome << std::flush;
  if (!writes) look(daemon);
  while (!signals.wait_for(1s))
    if (!json) out << status_line(daemon.report()) << std::endl;
  const RunSummary summary = daemon.stop();
  logger->info("ended frames={} signal={}", summary.frames, signals.signal());
  out << (json ? to_json(summary) : to_text(summary)) << std::flush;
}

}  // namespace poinsot
