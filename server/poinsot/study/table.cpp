#include "poinsot/study/table.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "poinsot/study/pareto.h"

namespace poinsot {
namespace {

constexpr std::size_t kColumns = 100;
constexpr double kMicro = 1e-6;

// Two digits, rounded up: it is a bound.
std::string bound_text(double bound) {
  if (!(bound > 0)) return "0";
  constexpr double kRounding = 1e-9;
  const double power = std::pow(10, std::floor(std::log10(bound)) - 1);
  return fmt::format("{:.2g}", std::ceil(bound / power * (1 - kRounding)) * power);
}

// What is below the certificate is known to be at most that.
std::string error_text(double measured, double certificate) {
  return measured > certificate || certificate == 0 ? fmt::format("{:.2g}", measured)
                                                    : "≤ " + bound_text(certificate);
}

std::string cost_text(double cost) {
  const double us = cost / kMicro;
  return us >= 1000 ? fmt::format("{:.0f}", us) : fmt::format("{:.3g}", us);
}

std::string line_of(const Row& row, const PoseError& certificate) {
  return fmt::format(
      "{}{} {:<19} {:<12} {:>9} {:>11} {:>9} {:>9} {:>10} {:>10}\n", row.pareto ? '*' : ' ',
      row.setting.of_the_scene ? '>' : ' ', row.setting.family, row.setting.label,
      error_text(row.measured.position, certificate.position),
      error_text(row.measured.orientation, certificate.orientation),
      fmt::format("{:.2g}", row.energy_error), fmt::format("{:.2g}", row.momentum_error),
      cost_text(row.cost.simulation), cost_text(row.cost.collision + row.cost.contact));
}

std::string table(const StudyResult& result) {
  std::string text = fmt::format("{:<35} {:^41} {:>21}\n", "", "largest error", "CPU [us/s]");
  text += fmt::format("   {:<19} {:<12} {:>9} {:>11} {:>9} {:>9} {:>10} {:>10}\n", "integrator",
                      "setting", "position", "orientation", "energy", "momentum", "simulation",
                      "contacts");
  text += fmt::format("   {:<19} {:<12} {:>9} {:>11} {:>9} {:>9}\n", "", "", "[m]", "[rad]", "[-]",
                      "[-]");
  for (const Row& row : result.rows) text += line_of(row, result.reference.certificate);
  return text;
}

std::string count_text(double count) {
  return count >= 1000 ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

std::string search_table(const StudyResult& result) {
  if (result.searches.empty()) return {};
  std::string text = fmt::format("\n{:<16} {:^31} {:^34} {:>19}\n", "", "largest difference",
                                 "per simulated second", "CPU [us/s]");
  text += fmt::format("   {:<13} {:>9} {:>11} {:>9} {:>8} {:>8} {:>8} {:>8} {:>10} {:>9}\n",
                      "impact search", "position", "orientation", "energy", "impacts", "searches",
                      "poses", "gaps", "simulation", "contacts");
  for (const SearchRow& row : result.searches) {
    const bool is_reference = &row == &result.searches.front();
    const auto difference = [&](double x) {
      return is_reference ? std::string("-") : fmt::format("{:.2g}", x);
    };
    text += fmt::format(
        " {} {:<13} {:>9} {:>11} {:>9} {:>8} {:>8} {:>8} {:>8} {:>10} {:>9}\n",
        row.of_the_scene ? '>' : ' ', name_of<ImpactSearchKind>(kImpactSearchNames, row.search),
        difference(row.difference.position), difference(row.difference.orientation),
        fmt::format("{:.2g}", row.energy_error), count_text(row.impacts), count_text(row.searches),
        count_text(row.poses), count_text(row.gaps), cost_text(row.cost.simulation),
        cost_text(row.cost.collision + row.cost.contact));
  }
  return text +
         "Difference: from conservative, in m and rad, with the scene's integrator. Poses and "
         "gaps: evaluations of\nthe searches.\n";
}

// "title: a, b, c", broken at kColumns.
std::string list_text(const std::string& title, const std::vector<std::string>& words) {
  if (words.empty()) return {};
  std::string text, line = title + ":";
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (line.size() + words[i].size() + 2 > kColumns) {
      text += line + "\n";
      line.assign(1, ' ');
    }
    line += fmt::format(" {}{}", words[i], i + 1 < words.size() ? "," : "");
  }
  return text + line + "\n";
}

std::string notes(const StudyResult& result) {
  std::vector<std::string> skipped, frozen;
  std::string equal;
  for (const Setting& setting : result.skipped) skipped.push_back(setting.name());
  std::uint32_t fewest = UINT32_MAX, most = 0;
  for (const Row& row : result.rows) {
    equal += list_text("Same states as " + row.setting.name(), row.equal);
    if (row.quarantined > 0)
      frozen.push_back(fmt::format("{} ({})", row.setting.name(), row.quarantined));
    fewest = std::min(fewest, row.runs);
    most = std::max(most, row.runs);
  }
  std::string text =
      "* Pareto: no other is both cheaper in simulation and at least as accurate. > the scene's "
      "own.\n";
  if (!result.rows.empty())
    text += fmt::format(
        "CPU: microseconds per simulated second, median of {} to {} runs; contacts: with their "
        "search.\n",
        fewest, most);
  text += equal;
  text += list_text("Bodies frozen because they failed", frozen);
  text += list_text("Skipped, longer than their share of the time budget", skipped);
  if (result.interrupted) text += "Interrupted: not every setting was tried.\n";
  return text;
}

std::string horizon_text(const StudyResult& result) {
  const ReferenceInfo& r = result.reference;
  const std::string t = fmt::format("{:.6g} s", result.horizon_time());
  switch (r.end) {
    case HorizonEnd::asked:
      return fmt::format("Errors are measured up to t = {}, as asked for.\n", t);
    case HorizonEnd::disagreement:
      return fmt::format(
          "A reference exists up to t = {}: there they part by more than {:.1g} m or {:.1g} "
          "rad.\nErrors are measured up to there.\n",
          t, r.limit.position, r.limit.orientation);
    case HorizonEnd::budget:
      return fmt::format(
          "Errors are measured up to t = {}: the time budget allows no more (--budget).\n", t);
    case HorizonEnd::interrupted:
      return fmt::format("Interrupted at t = {}.\n", t);
  }
  return {};
}

}  // namespace

std::string reference_text(const StudyResult& result) {
  const ReferenceInfo& r = result.reference;
  if (result.horizon == 0 && r.end == HorizonEnd::interrupted)
    return "Interrupted before the first frame of the reference.\n";
  if (result.horizon == 0)
    return fmt::format(
        "No reference exists: {} and {}\npart by more than {:.1g} m or {:.1g} rad within the first "
        "frame",
        r.name, r.check, r.limit.position, r.limit.orientation);
  std::string text = fmt::format(
      "Reference: {}, certified by {}.\nThey agree to {} m and {} rad.\n", r.name, r.check,
      bound_text(r.certificate.position), bound_text(r.certificate.orientation));
  if (!r.independent)
    text +=
        "They share a method that moves bodies: what it gets wrong in all of them is not in "
        "that.\n";
  return text + horizon_text(result);
}

std::string to_text(const StudyResult& result) {
  std::string text = fmt::format("{}: {} moving {}, {} frames of {} at {:g} Hz", result.scene,
                                 result.bodies, result.bodies == 1 ? "body" : "bodies",
                                 result.horizon, result.asked, result.frame_rate);
  text += result.stride > 1 ? fmt::format(", every {} compared\n", result.stride) : "\n";
  text += reference_text(result);
  if (result.rows.empty()) return text;
  return text + "\n" + table(result) + "\n" + notes(result) + search_table(result);
}

std::string cheapest_text(const StudyResult& result, double wanted) {
  const Row* const row = cheapest(result, wanted);
  const std::string error = fmt::format("{:g} m and {:g} rad", wanted, wanted);
  if (row == nullptr) return "No setting that was tried has errors of at most " + error + ".\n";
  return fmt::format("Cheapest with errors of at most {}: {}, {} us of CPU per simulated second.\n",
                     error, row->setting.name(), cost_text(row->cost.simulation));
}

}  // namespace poinsot
