#include "poinsot/study/settings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <span>
#include <tuple>
#include <utility>

namespace poinsot {
namespace {

constexpr std::array kFrameParts = {1, 4, 16, 64};
// 0 is the default: kPairDefault for the Runge-Kutta pairs, rounding for the others.
constexpr double kPairDefault = 1e-8;
constexpr std::array kPairTolerances = {1e-3, 1e-4, 1e-5,  1e-6,  1e-7,
                                        0.0,  1e-9, 1e-10, 1e-11, 1e-12};
constexpr std::array kSeriesTolerances = {1e-3, 1e-6, 1e-9, 1e-12, 0.0};

bool is_pair(IntegratorKind kind) {
  return kind == IntegratorKind::dop853 || kind == IntegratorKind::dopri5;
}

std::span<const double> tolerances_of(IntegratorKind kind) {
  if (is_pair(kind)) return kPairTolerances;
  return kSeriesTolerances;
}

std::string step_label(double step) {
  if (step == 0) return "contact step";
  const double rate = 1 / step;
  constexpr double kRounding = 1e-9;
  const bool whole = rate > 1.5 && std::abs(rate - std::round(rate)) < kRounding * rate;
  char text[32];
  whole ? std::snprintf(text, sizeof text, "1/%.0f s", rate)
        : std::snprintf(text, sizeof text, "%.4g s", step);
  return text;
}

std::string tolerance_label(double tolerance) {
  if (tolerance == 0) return "default";
  const auto exponent = static_cast<int>(std::floor(std::log10(tolerance) + 0.5));
  char text[32], power[32];
  std::snprintf(text, sizeof text, "%.4g", tolerance);
  std::snprintf(power, sizeof power, "1e%d", exponent);
  return std::strtod(power, nullptr) == tolerance ? power : text;
}

// Only what the method reads counts.
bool same(const Setting& a, const Setting& b) {
  const SimulationDef &x = a.simulation, &y = b.simulation;
  if (x.integrator != y.integrator) return false;
  return is_adaptive(x.integrator) ? x.tolerance == y.tolerance : x.step == y.step;
}

// Larger: fewer steps.
double coarseness(const Setting& setting, const Scene& scene) {
  const auto [integrator, step, tolerance, gravity] = setting.simulation;
  if (!is_adaptive(integrator)) return step > 0 ? step : scene.collision.contact_step;
  if (tolerance > 0) return tolerance;
  return is_pair(integrator) ? kPairDefault : 0;
}

void add(std::vector<Setting>& settings, const Scene& scene, const SimulationDef& simulation) {
  Setting setting = make_setting(simulation);
  if (validate(with(scene, setting)).empty()) settings.push_back(std::move(setting));
}

void add_scenes_own(std::vector<Setting>& settings, const Scene& scene) {
  Setting own = make_setting(scene.simulation);
  auto found = std::find_if(settings.begin(), settings.end(),
                            [&](const Setting& other) { return same(own, other); });
  if (found == settings.end()) {  // in its place on the curve
    found = std::find_if(settings.begin(), settings.end(), [&](const Setting& other) {
      return other.family == own.family && coarseness(other, scene) < coarseness(own, scene);
    });
    if (found == settings.end())
      found = std::find_if(settings.rbegin(), settings.rend(), [&](const Setting& other) {
                return other.family == own.family;
              }).base();
    found = settings.insert(found, std::move(own));
  }
  found->of_the_scene = true;
}

}  // namespace

Setting make_setting(const SimulationDef& simulation) {
  const IntegratorKind kind = simulation.integrator;
  return {.family = std::string(name_of<IntegratorKind>(kIntegratorNames, kind)),
          .label = is_adaptive(kind) ? tolerance_label(simulation.tolerance)
                                     : step_label(simulation.step),
          .simulation = simulation};
}

std::vector<Setting> settings_for(const Scene& scene) {
  std::vector<Setting> settings;
  for (const Named<IntegratorKind>& row : kIntegratorNames) {
    SimulationDef simulation = scene.simulation;
    simulation.integrator = row.value;
    if (is_adaptive(row.value)) {
      for (const double tolerance : tolerances_of(row.value)) {
        simulation.tolerance = tolerance;
        add(settings, scene, simulation);
      }
    } else {
      for (const int parts : kFrameParts) {
        simulation.step = 1 / (scene.presentation.frame_rate * parts);
        add(settings, scene, simulation);
      }
    }
  }
  add_scenes_own(settings, scene);
  return settings;
}

Scene with(Scene scene, const Setting& setting) {
  scene.simulation = setting.simulation;
  return scene;
}

bool is_default(const Setting& setting) {
  const SimulationDef& s = setting.simulation;
  return (is_adaptive(s.integrator) ? s.tolerance : s.step) == 0;
}

std::vector<std::size_t> running_order(const std::vector<Setting>& settings) {
  std::map<std::string, std::size_t> seen;
  std::vector<std::tuple<bool, std::size_t, std::size_t>> rank;  // late, place in family, position
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const bool first = settings[i].of_the_scene || is_default(settings[i]);
    rank.emplace_back(!first, seen[settings[i].family]++, i);
  }
  std::sort(rank.begin(), rank.end());
  std::vector<std::size_t> order;
  for (const auto& [late, place, position] : rank) order.push_back(position);
  return order;
}

}  // namespace poinsot
