#include <algorithm>
#include <cstdint>
#include <vector>

#include "poinsot/base/limits.h"
#include "poinsot/wire/checks.h"
#include "poinsot/wire/convert.h"

namespace poinsot {
namespace {

constexpr FrameFlag kAllFlags =
    FrameFlag::body_quarantined | FrameFlag::inbox_full | FrameFlag::overrun | FrameFlag::stiff |
    FrameFlag::crowded | FrameFlag::input_late | FrameFlag::record_failed | FrameFlag::rate_limited;

constexpr auto kLastMethod = static_cast<std::uint8_t>(kMethodNames.back().value);

void assign(msg::v5::LayerTime& out, const Elapsed& in) {
  out.wall_s(in.wall_s);
  out.cpu_s(in.cpu_s);
}

void assign(msg::v5::Spread& out, const Spread& in) {
  out.p50(in.p50);
  out.p99(in.p99);
  out.max(in.max);
}

Spread spread(Checks& checks, const msg::v5::Spread& in, std::string_view name) {
  checks.number(in.p50(), name);
  checks.number(in.p99(), name);
  checks.number(in.max(), name);
  return {in.p50(), in.p99(), in.max()};
}

void put_clients(const std::vector<ClientStatus>& in, std::vector<msg::v5::ClientStatus>& out) {
  out.resize(std::min(in.size(), kMaxClients));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].client(in[i].client);
    out[i].alive(in[i].alive);
    out[i].lock_step(in[i].lock_step);
    out[i].held(in[i].held);
    out[i].accepted(in[i].accepted);
    out[i].refused(in[i].refused);
    out[i].limited(in[i].limited);
  }
}

void read_clients(Checks& checks, const std::vector<msg::v5::ClientStatus>& in,
                  std::vector<ClientStatus>& out) {
  checks.require(in.size() <= kMaxClients, "clients: more than " + std::to_string(kMaxClients));
  if (!checks.ok()) return;
  out.clear();
  for (const msg::v5::ClientStatus& c : in)
    out.push_back({.client = c.client(),
                   .alive = c.alive(),
                   .lock_step = c.lock_step(),
                   .held = c.held(),
                   .accepted = c.accepted(),
                   .refused = c.refused(),
                   .limited = c.limited()});
}

Elapsed time(Checks& checks, const msg::v5::LayerTime& in, std::string_view name) {
  checks.number(in.wall_s(), name);
  checks.number(in.cpu_s(), name);
  return {in.wall_s(), in.cpu_s()};
}

double finite(Checks& checks, double value, std::string_view name) {
  checks.number(value, name);
  return value;
}

void read_methods(Checks& checks, const std::vector<std::uint8_t>& in, std::vector<Method>& out) {
  checks.require(in.size() <= kMaxBodies,
                 "body_methods: more than " + std::to_string(kMaxBodies) + " in one report");
  if (!checks.ok()) return;
  const auto unknown =
      std::ranges::find_if(in, [](std::uint8_t method) { return method > kLastMethod; });
  if (unknown != in.end())
    return checks.require(false, "body_methods " + std::to_string(*unknown) + " is unknown");
  out.resize(in.size());
  std::ranges::transform(in, out.begin(),
                         [](std::uint8_t method) { return static_cast<Method>(method); });
}

}  // namespace

std::string to_message(const RunReport& in, msg::v5::RunStatus& out) {
  if (in.body_methods.size() > kMaxBodies)
    return "body_methods: more than " + std::to_string(kMaxBodies) + " in one report";
  if (in.recording.size() > kMaxStoreName) return "recording: too long a name";
  out.session(in.session);
  out.epoch(in.epoch);
  out.state(static_cast<msg::v5::RunStateKind>(in.state));
  out.frame_index(in.frame.frame);
  out.sim_time(in.frame.sim_time);
  out.bodies(in.frame.bodies);
  out.contacts(in.frame.contacts);
  out.quarantined(in.frame.quarantined);
  out.islands(in.frame.islands);
  out.restarts(in.frame.restarts);
  out.impact_searches(in.frame.impact_searches);
  out.impacts(in.frame.impacts);
  out.impacts_so_far(in.frame.impacts_so_far);
  out.asleep(in.frame.asleep);
  out.soft_bodies(in.frame.soft_bodies);
  out.direct_bodies(in.frame.direct_bodies);
  out.solver_iterations(in.frame.solver_iterations);
  out.unconverged(in.frame.unconverged);
  out.contact_residual(in.frame.contact_residual);
  out.energy(in.frame.energy);
  out.energy_error(in.frame.energy_error);
  out.push_out_energy(in.frame.push_out_energy);
  out.max_penetration(in.frame.max_penetration);
  out.position_error(in.frame.position_error);
  out.orientation_error(in.frame.orientation_error);
  out.momentum_error(in.frame.momentum_error);
  out.methods(in.frame.methods);
  out.body_methods().resize(in.body_methods.size());
  std::ranges::transform(in.body_methods, out.body_methods().begin(),
                         [](Method method) { return static_cast<std::uint8_t>(method); });
  out.flags(static_cast<std::uint32_t>(in.frame.flags));
  out.frame_rate(in.frame_rate);
  out.time_scale(in.time_scale);
  out.real_time_factor(in.real_time_factor);
  out.real_time_factor_window(in.real_time_factor_window);
  assign(out.lateness(), in.lateness);
  assign(out.frame_time(), in.frame_time);
  out.scene_bodies(in.scene_bodies);
  out.scene_revision(in.scene_revision);
  out.state_hash(in.state_hash);
  out.overruns(in.overruns);
  out.commands_accepted(in.commands_accepted);
  out.commands_refused(in.commands_refused);
  out.commands_limited(in.commands_limited);
  out.held_wrenches(in.held_wrenches);
  out.checkpoints(in.checkpoints);
  out.late_inputs(in.late_inputs);
  out.streams(in.streams);
  out.recording(in.recording);
  put_clients(in.clients, out.clients());
  out.snapshots_dropped(in.snapshots_dropped);
  out.events_dropped(in.events_dropped);
  assign(out.presentation_time(), in.times.presentation);
  assign(out.collision_time(), in.times.collision);
  assign(out.contact_time(), in.times.contact);
  assign(out.simulation_time(), in.times.simulation);
  assign(out.publishing_time(), in.times.publishing);
  return {};
}

std::string from_message(const msg::v5::RunStatus& in, RunReport& out) {
  Checks checks;
  out.session = in.session();
  out.epoch = in.epoch();
  out.state = known(checks, in.state(), RunState::quitting, "state");
  out.frame.frame = in.frame_index();
  out.frame.sim_time = finite(checks, in.sim_time(), "sim_time");
  out.frame.bodies = in.bodies();
  out.frame.contacts = in.contacts();
  out.frame.quarantined = in.quarantined();
  out.frame.islands = in.islands();
  out.frame.restarts = in.restarts();
  out.frame.impact_searches = in.impact_searches();
  out.frame.impacts = in.impacts();
  out.frame.impacts_so_far = in.impacts_so_far();
  out.frame.asleep = in.asleep();
  out.frame.soft_bodies = in.soft_bodies();
  out.frame.direct_bodies = in.direct_bodies();
  out.frame.solver_iterations = in.solver_iterations();
  out.frame.unconverged = in.unconverged();
  out.frame.contact_residual = finite(checks, in.contact_residual(), "contact_residual");
  out.frame.energy = finite(checks, in.energy(), "energy");
  out.frame.energy_error = finite(checks, in.energy_error(), "energy_error");
  out.frame.push_out_energy = finite(checks, in.push_out_energy(), "push_out_energy");
  out.frame.max_penetration = finite(checks, in.max_penetration(), "max_penetration");
  out.frame.position_error = finite(checks, in.position_error(), "position_error");
  out.frame.orientation_error = finite(checks, in.orientation_error(), "orientation_error");
  out.frame.momentum_error = finite(checks, in.momentum_error(), "momentum_error");
  out.frame.methods = in.methods();
  read_methods(checks, in.body_methods(), out.body_methods);
  checks.require((in.flags() & ~static_cast<std::uint32_t>(kAllFlags)) == 0, "flags are unknown");
  out.frame.flags = static_cast<FrameFlag>(in.flags());
  out.frame_rate = finite(checks, in.frame_rate(), "frame_rate");
  out.time_scale = finite(checks, in.time_scale(), "time_scale");
  out.real_time_factor = finite(checks, in.real_time_factor(), "real_time_factor");
  out.real_time_factor_window =
      finite(checks, in.real_time_factor_window(), "real_time_factor_window");
  out.lateness = spread(checks, in.lateness(), "lateness");
  out.frame_time = spread(checks, in.frame_time(), "frame_time");
  out.scene_bodies = in.scene_bodies();
  out.scene_revision = in.scene_revision();
  out.state_hash = in.state_hash();
  out.overruns = in.overruns();
  out.commands_accepted = in.commands_accepted();
  out.commands_refused = in.commands_refused();
  out.commands_limited = in.commands_limited();
  out.held_wrenches = in.held_wrenches();
  out.checkpoints = in.checkpoints();
  out.late_inputs = in.late_inputs();
  out.streams = in.streams();
  out.recording = in.recording().c_str();
  checks.text(out.recording, "recording", kMaxStoreName);
  read_clients(checks, in.clients(), out.clients);
  out.snapshots_dropped = in.snapshots_dropped();
  out.events_dropped = in.events_dropped();
  out.times.presentation = time(checks, in.presentation_time(), "presentation_time");
  out.times.collision = time(checks, in.collision_time(), "collision_time");
  out.times.contact = time(checks, in.contact_time(), "contact_time");
  out.times.simulation = time(checks, in.simulation_time(), "simulation_time");
  out.times.publishing = time(checks, in.publishing_time(), "publishing_time");
  return checks.take();
}

}  // namespace poinsot
