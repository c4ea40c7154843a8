// The JSON of poinsot status and list.

#include "poinsot/cli/json.h"
#include "poinsot/cli/json_line.h"
#include "poinsot/cli/units.h"

namespace poinsot {
namespace {

Json layers(const LayerTimes& times, double Elapsed::*clock) {
  return {{"presentation", times.presentation.*clock},
          {"collision", times.collision.*clock},
          {"contact", times.contact.*clock},
          {"simulation", times.simulation.*clock},
          {"publishing", times.publishing.*clock}};
}

Json flag_names(FrameFlag flags) {
  Json names = Json::array();
  for (const Named<FrameFlag>& row : kFrameFlagNames)
    if (has_flag(flags, row.value)) names.push_back(row.name);
  return names;
}

Json method_counts(const FrameReport& frame) {
  Json counts = Json::object();
  for (const Named<Method>& row : kMethodNames)
    counts[std::string(row.name)] = frame.methods[static_cast<std::size_t>(row.value)];
  return counts;
}

Json body_methods(const RunReport& report, const std::vector<BodyInfo>& bodies) {
  std::vector<const BodyInfo*> moving;
  for (const BodyInfo& body : bodies)
    if (!body.is_static && body.session == report.session) moving.push_back(&body);
  const bool named = moving.size() == report.body_methods.size();
  Json list = Json::array();
  for (std::size_t k = 0; k < report.body_methods.size(); ++k) {
    Json entry = Json::object();
    if (named)
      entry["name"] = moving[k]->name;
    else
      entry["index"] = k;
    entry["method"] = name_of<Method>(kMethodNames, report.body_methods[k]);
    list.push_back(std::move(entry));
  }
  return list;
}

Json spread(const Spread& values) {
  return {{"p50", values.p50}, {"p99", values.p99}, {"max", values.max}};
}

Json clients(const RunReport& report) {
  Json list = Json::array();
  for (const ClientStatus& client : report.clients)
    list.push_back({{"client", hex(client.client)},
                    {"alive", client.alive},
                    {"lock_step", client.lock_step},
                    {"held", client.held},
                    {"accepted", client.accepted},
                    {"refused", client.refused},
                    {"limited", client.limited}});
  return list;
}

}  // namespace

std::string status_json(const std::string& world, const RunReport& report,
                        const std::vector<BodyInfo>& bodies) {
  const FrameReport& frame = report.frame;
  return json_line(
      {{"world", world},
       {"session", hex(report.session)},
       {"epoch", report.epoch},
       {"state", name_of<RunState>(kRunStateNames, report.state)},
       {"frame", frame.frame},
       {"time", frame.sim_time},
       {"frame_rate", report.frame_rate},
       {"time_scale", report.time_scale},
       {"real_time_factor", report.real_time_factor},
       {"real_time_factor_window", report.real_time_factor_window},
       {"lateness", spread(report.lateness)},
       {"frame_time", spread(report.frame_time)},
       {"scene_bodies", report.scene_bodies},
       {"scene_revision", report.scene_revision},
       {"bodies", frame.bodies},
       {"contacts", frame.contacts},
       {"quarantined", frame.quarantined},
       {"asleep", frame.asleep},
       {"islands", frame.islands},
       {"restarts", frame.restarts},
       {"impact_searches", frame.impact_searches},
       {"soft_bodies", frame.soft_bodies},
       {"direct_bodies", frame.direct_bodies},
       {"solver_iterations", frame.solver_iterations},
       {"unconverged", frame.unconverged},
       {"contact_residual", frame.contact_residual},
       {"impacts", frame.impacts},
       {"impacts_so_far", frame.impacts_so_far},
       {"max_penetration", frame.max_penetration},
       {"energy", frame.energy},
       {"energy_error", frame.energy_error},
       {"push_out_energy", frame.push_out_energy},
       {"position_error", frame.position_error},
       {"orientation_error", frame.orientation_error},
       {"momentum_error", frame.momentum_error},
       {"methods", method_counts(frame)},
       {"body_methods", body_methods(report, bodies)},
       {"flags", flag_names(frame.flags)},
       {"state_hash", hex(report.state_hash)},
       {"overruns", report.overruns},
       {"commands_accepted", report.commands_accepted},
       {"commands_refused", report.commands_refused},
       {"commands_limited", report.commands_limited},
       {"held_wrenches", report.held_wrenches},
       {"checkpoints", report.checkpoints},
       {"late_inputs", report.late_inputs},
       {"streams", report.streams},
       {"recording", report.recording.empty() ? Json(nullptr) : Json(report.recording)},
       {"clients", clients(report)},
       {"snapshots_dropped", report.snapshots_dropped},
       {"events_dropped", report.events_dropped},
       {"wall_s", layers(report.times, &Elapsed::wall_s)},
       {"cpu_s", layers(report.times, &Elapsed::cpu_s)}});
}

std::string list_json(const std::string& world, const RunReport& report,
                      const std::vector<BodyInfo>& bodies) {
  Json list = Json::array();
  for (const BodyInfo& body : bodies) {
    list.push_back(
        {{"name", body.name},
         {"static", body.is_static},
         {"kinematic", body.is_kinematic},
         {"mass",
          body.is_static || body.is_kinematic ? Json(nullptr) : Json(body.mass_properties.mass)}});
  }
  return json_line({{"world", world},
                    {"state", name_of<RunState>(kRunStateNames, report.state)},
                    {"frame", report.frame.frame},
                    {"time", report.frame.sim_time},
                    {"frame_rate", report.frame_rate},
                    {"bodies", list}});
}

}  // namespace poinsot
