// The text of poinsot status.

#include <spdlog/fmt/fmt.h>

#include "poinsot/cli/format.h"
#include "poinsot/cli/units.h"
#include "poinsot/protocol/methods_text.h"

namespace poinsot {
namespace {

std::string flags_text(FrameFlag flags) {
  std::string text;
  for (const Named<FrameFlag>& row : kFrameFlagNames) {
    if (!has_flag(flags, row.value)) continue;
    if (!text.empty()) text += ' ';
    text += row.name;
  }
  return text.empty() ? "none" : text;
}

std::string spread_text(const Spread& spread) {
  constexpr double kMs = 1e3;
  return fmt::format("p50 {:.3f}, p99 {:.3f}, max {:.3f} ms", spread.p50 * kMs, spread.p99 * kMs,
                     spread.max * kMs);
}

std::string pace_lines(const RunReport& r) {
  const std::string asked =
      r.time_scale > 0 ? fmt::format("{:g} asked for", r.time_scale) : "as fast as it can";
  std::string text = fmt::format(
      "pace         {:g} Hz, {:.3f} of real time now, {:.3f} over the "
      "last seconds, {}\n",
      r.frame_rate, r.real_time_factor, r.real_time_factor_window, asked);
  text += fmt::format("lateness     {}; {} overruns\n", spread_text(r.lateness), r.overruns);
  return text + fmt::format("frame time   {}\n", spread_text(r.frame_time));
}

std::string command_lines(const RunReport& r) {
  return fmt::format(
      "commands     {} accepted, {} refused ({} for being too many), {} late inputs\n"
      "held         {}\n",
      r.commands_accepted, r.commands_refused, r.commands_limited, r.late_inputs, r.held_wrenches);
}

std::string client_lines(const RunReport& r) {
  if (r.clients.empty()) return {};
  std::string text = fmt::format("\n{:<16} {:<8} {:>6} {:>10} {:>10} {:>10}\n", "client", "",
                                 "held", "accepted", "refused", "limited");
  for (const ClientStatus& client : r.clients) {
    const std::string_view state = !client.alive ? "gone" : client.lock_step ? "lockstep" : "alive";
    text += fmt::format("{} {:<8} {:>6} {:>10} {:>10} {:>10}\n", hex(client.client), state,
                        client.held, client.accepted, client.refused, client.limited);
  }
  return text;
}

}  // namespace

std::string status_text(const std::string& world, const RunReport& r) {
  const FrameReport& f = r.frame;
  const LayerTimes& t = r.times;
  std::string text;
  text += fmt::format("world        {}\n", world);
  text += fmt::format("state        {}\n", name_of<RunState>(kRunStateNames, r.state));
  text += fmt::format("frame        {} ({:.3f} s), epoch {}\n", f.frame, f.sim_time, r.epoch);
  text += pace_lines(r);
  text += fmt::format("scene        {} bodies, revision {}\n", r.scene_bodies, r.scene_revision);
  text += fmt::format("bodies       {} moving, {} asleep, {} quarantined\n", f.bodies, f.asleep,
                      f.quarantined);
  text += fmt::format("contacts     {}, deepest {:.3g} m\n", f.contacts, f.max_penetration);
  text += fmt::format("islands      {}, {} restarts, {} impact searches\n", f.islands, f.restarts,
                      f.impact_searches);
  text += fmt::format(
      "solvers      {} bodies soft_step, {} convex_newton in {} iterations, {} unconverged, "
      "residual {:.3g} m/s\n",
      f.soft_bodies, f.direct_bodies, f.solver_iterations, f.unconverged, f.contact_residual);
  text += fmt::format("impacts      {}, {} in all\n", f.impacts, f.impacts_so_far);
  text += fmt::format("energy       {:.6g} J, error {:.3g}, push-out {:.3g} J\n", f.energy,
                      f.energy_error, f.push_out_energy);
  text += fmt::format("local error  {:.3g} m, {:.3g} rad\n", f.position_error, f.orientation_error);
  text += fmt::format("momentum     error {:.3g}\n", f.momentum_error);
  const std::string methods = methods_text(f);
  text += fmt::format("methods      {}\n", methods.empty() ? "none yet" : methods);
  text += command_lines(r);
  text += fmt::format("streams      {} filtered; dropped {} snapshots, {} events\n", r.streams,
                      r.snapshots_dropped, r.events_dropped);
  text += fmt::format("checkpoints  {}\n", r.checkpoints);
  text += fmt::format("recording    {}\n", r.recording.empty() ? "none" : r.recording);
  text += fmt::format(
      "cpu [s]      presentation {:.3f}, collision {:.3f}, contact {:.3f}, simulation {:.3f}, "
      "publishing {:.3f}\n",
      t.presentation.cpu_s, t.collision.cpu_s, t.contact.cpu_s, t.simulation.cpu_s,
      t.publishing.cpu_s);
  text += fmt::format("flags        {}\n", flags_text(f.flags));
  text += fmt::format("state hash   {}\n", hex(r.state_hash));
  return text + client_lines(r);
}

}  // namespace poinsot
