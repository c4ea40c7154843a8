#include "poinsot/cli/json.h"

#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "poinsot/cli/units.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

// The shortest digits that read back as the same double, always as a floating-point number.
void append(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string_view text(digits.data(), static_cast<std::size_t>(end - digits.data()));
  out += text;
  if (text.find_first_of(".e") == std::string_view::npos) out += ".0";
}

void append(std::string& out, std::string_view key, const Vec3& v) {
  out += ",\"";
  out += key;
  out += "\":[";
  for (int i = 0; i < 3; ++i) {
    if (i > 0) out += ',';
    append(out, v[i]);
  }
  out += ']';
}

void append(std::string& out, std::string_view key, const Quat& q) {
  out += ",\"";
  out += key;
  out += "\":{";
  constexpr std::string_view kNames = "xyzw";
  for (int i = 0; i < 4; ++i) {
    out += i > 0 ? ",\"" : "\"";
    out += kNames[static_cast<std::size_t>(i)];
    out += "\":";
    append(out, q.coeffs()[i]);
  }
  out += '}';
}

std::string quoted_name(const std::string& name) {
  return Json(name).dump();
}

Json code_name(ResultCode code) {
  return name_of<ResultCode>(kResultCodeNames, code);
}

std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

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

}  // namespace

// Written by hand: a thousand bodies at full frame rate would keep a tree of values busy.
std::string pose_json(const PoseSnapshot& poses, const Roster& roster, double frame_rate) {
  std::string out = "{\"frame\":" + std::to_string(poses.frame) + ",\"time\":";
  append(out, end_time(poses.frame, frame_rate));
  out += ",\"bodies\":[";
  const char* separator = "";
  for (const BodyState& body : poses.bodies) {
    const std::string* const name = roster.shown(body.id);
    if (name == nullptr) continue;
    out += std::exchange(separator, ",");
    out += "{\"name\":" + quoted_name(*name);
    append(out, "position", body.position);
    append(out, "orientation", body.orientation);
    append(out, "linear_velocity", body.linear_velocity);
    append(out, "angular_velocity", body.angular_velocity);
    out += '}';
  }
  return out + "]}\n";
}

std::string impact_json(const ImpactNotice& impact, const std::string& a, const std::string& b) {
  const auto vector = [](const Vec3& v) { return Json{v.x(), v.y(), v.z()}; };
  const auto body = [&](const ImpactedBody& from, const std::string& name) {
    return Json{{"name", name},
                {"linear_before", vector(from.linear_before)},
                {"angular_before", vector(from.angular_before)},
                {"linear_after", vector(from.linear_after)},
                {"angular_after", vector(from.angular_after)}};
  };
  return line({{"frame", impact.frame},
               {"epoch", impact.epoch},
               {"time", impact.time},
               {"a", body(impact.a, a)},
               {"b", body(impact.b, b)},
               {"point", vector(impact.point)},
               {"normal", vector(impact.normal)},
               {"impulse", vector(impact.impulse)}});
}

std::string push_json(const WrenchCommand& command, const Reply& reply, double frame_rate) {
  Json json = {{"body", command.body_name},
               {"code", code_name(reply.code)},
               {"message", reply.message},
               {"epoch", reply.epoch}};
  if (reply.code != ResultCode::ok) return line(json);
  json["first_frame"] = reply.first_frame;
  json["last_frame"] = nullptr;
  json["start_time"] = start_time(reply.first_frame, frame_rate);
  json["end_time"] = nullptr;
  if (reply.last_frame != kForever) {
    json["last_frame"] = reply.last_frame;
    json["end_time"] = end_time(reply.last_frame, frame_rate);
  }
  return line(json);
}

std::string control_json(std::string_view action, const Reply& reply, double frame_rate) {
  return line({{"action", action},
               {"code", code_name(reply.code)},
               {"message", reply.message},
               {"epoch", reply.epoch},
               {"frame", reply.last_frame},
               {"time", end_time(reply.last_frame, frame_rate)},
               {"state_hash", hex(reply.state_hash)}});
}

std::string status_json(const std::string& world, const RunReport& report,
                        const std::vector<BodyInfo>& bodies) {
  const FrameReport& frame = report.frame;
  return line({{"world", world},
               {"session", hex(report.session)},
               {"epoch", report.epoch},
               {"state", name_of<RunState>(kRunStateNames, report.state)},
               {"frame", frame.frame},
               {"time", frame.sim_time},
               {"frame_rate", report.frame_rate},
               {"real_time_factor", report.real_time_factor},
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
  return line({{"world", world},
               {"state", name_of<RunState>(kRunStateNames, report.state)},
               {"frame", report.frame.frame},
               {"time", report.frame.sim_time},
               {"frame_rate", report.frame_rate},
               {"bodies", list}});
}

}  // namespace poinsot
