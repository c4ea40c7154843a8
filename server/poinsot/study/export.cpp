#include "poinsot/study/export.h"

#include <array>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "poinsot/runner/trajectory.h"
#include "poinsot/study/pareto.h"

namespace poinsot {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMicro = 1e-6;

constexpr std::array<Named<HorizonEnd>, 4> kHorizonEndNames = {{
    {"asked", HorizonEnd::asked},
    {"disagreement", HorizonEnd::disagreement},
    {"budget", HorizonEnd::budget},
    {"interrupted", HorizonEnd::interrupted},
}};

// A step or tolerance that the method does not read is empty; 0 is its default.
std::string step_of(const SimulationDef& s) {
  return is_adaptive(s.integrator) ? "" : fmt::format("{:.17g}", s.step);
}
std::string tolerance_of(const SimulationDef& s) {
  return is_adaptive(s.integrator) ? fmt::format("{:.17g}", s.tolerance) : "";
}

std::string csv_start(const Setting& setting) {
  return fmt::format("{},{},{},{},", csv_field(setting.family), csv_field(setting.label),
                     step_of(setting.simulation), tolerance_of(setting.simulation));
}

Json json_of(const PoseError& error) {
  return {{"position", error.position}, {"orientation", error.orientation}};
}

Json json_of(const Setting& setting) {
  const SimulationDef& s = setting.simulation;
  Json json = {{"integrator", setting.family}, {"setting", setting.label}};
  if (is_adaptive(s.integrator))
    json["tolerance"] = s.tolerance;
  else
    json["step"] = s.step;
  json["of_the_scene"] = setting.of_the_scene;
  return json;
}

Json json_of(const Row& row, const ReferenceInfo& reference) {
  Json json = json_of(row.setting);
  const PoseError& certificate = reference.certificate;
  json["position_error"] = row.measured.position;
  json["orientation_error"] = row.measured.orientation;
  json["below_certificate"] = {
      {"position", row.measured.position <= certificate.position},
      {"orientation", row.measured.orientation <= certificate.orientation}};
  json["energy_error"] = row.energy_error;
  json["momentum_error"] = row.momentum_error;
  json["cpu_us_per_s"] = {{"simulation", row.cost.simulation / kMicro},
                          {"collision", row.cost.collision / kMicro},
                          {"contact", row.cost.contact / kMicro}};
  json["runs"] = row.runs;
  json["frozen"] = row.quarantined;
  json["methods"] = Json::array();
  for (const Method method : row.methods)
    json["methods"].push_back(name_of<Method>(kMethodNames, method));
  json["equal"] = row.equal;
  json["pareto"] = row.pareto;
  return json;
}

Json json_of(const SearchRow& row) {
  return {{"search", name_of<ImpactSearchKind>(kImpactSearchNames, row.search)},
          {"of_the_scene", row.of_the_scene},
          {"position_difference", row.difference.position},
          {"orientation_difference", row.difference.orientation},
          {"energy_error", row.energy_error},
          {"per_second",
           {{"impacts", row.impacts},
            {"searches", row.searches},
            {"poses", row.poses},
            {"gaps", row.gaps}}},
          {"cpu_us_per_s",
           {{"simulation", row.cost.simulation / kMicro},
            {"collision", row.cost.collision / kMicro},
            {"contact", row.cost.contact / kMicro}}},
          {"runs", row.runs}};
}

}  // namespace

std::string to_csv(const StudyResult& result) {
  std::string text =
      "integrator,setting,step,tolerance,position_error,orientation_error,position_certificate,"
      "orientation_certificate,energy_error,momentum_error,simulation_us,collision_us,contact_us,"
      "runs,frozen,pareto,scene,status\n";
  const PoseError& certificate = result.reference.certificate;
  for (const Row& row : result.rows)
    text +=
        csv_start(row.setting) +
        fmt::format(
            "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.9g},{:.9g},{:.9g},{},{},"
            "{:d},{:d},measured\n",
            row.measured.position, row.measured.orientation, certificate.position,
            certificate.orientation, row.energy_error, row.momentum_error,
            row.cost.simulation / kMicro, row.cost.collision / kMicro, row.cost.contact / kMicro,
            row.runs, row.quarantined, row.pareto, row.setting.of_the_scene);
  for (const Setting& setting : result.skipped)
    text += csv_start(setting) + fmt::format(",,,,,,,,,,,,{:d},skipped\n", setting.of_the_scene);
  return text;
}

std::string to_json(const StudyResult& result, double wanted_error) {
  const ReferenceInfo& r = result.reference;
  Json json = {{"scene", result.scene},           {"bodies", result.bodies},
               {"frame_rate", result.frame_rate}, {"frames_asked", result.asked},
               {"frames", result.horizon},        {"stride", result.stride},
               {"horizon", result.horizon_time()}};
  json["reference"] = {{"name", r.name},
                       {"check", r.check},
                       {"independent", r.independent},
                       {"certificate", json_of(r.certificate)},
                       {"limit", json_of(r.limit)},
                       {"ends_by", name_of<HorizonEnd>(kHorizonEndNames, r.end)}};
  json["rows"] = Json::array();
  for (const Row& row : result.rows) json["rows"].push_back(json_of(row, r));
  json["skipped"] = Json::array();
  for (const Setting& setting : result.skipped) json["skipped"].push_back(json_of(setting));
  json["impact_searches"] = Json::array();
  for (const SearchRow& row : result.searches) json["impact_searches"].push_back(json_of(row));
  json["interrupted"] = result.interrupted;
  if (wanted_error > 0) {
    const Row* const row = cheapest(result, wanted_error);
    json["wanted_error"] = wanted_error;
    json["cheapest"] = row == nullptr ? Json() : json_of(row->setting);
  }
  return json.dump() + "\n";
}

}  // namespace poinsot
