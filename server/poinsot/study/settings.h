// The settings that a study tries: every integrator, each over its steps or tolerances.

#pragma once

#include <string>
#include <vector>

#include "poinsot/study/study.h"

namespace poinsot {

// In the order of the integrators' names, coarse ones first; the scene's own is among them. Steps
// are fractions of the frame; settings that the scene would not be valid with are left out.
std::vector<Setting> settings_for(const Scene& scene);

// The scene with the setting in the place of its own.
Scene with(Scene scene, const Setting& setting);

// A setting of these definitions, named.
Setting make_setting(const SimulationDef& simulation);

// Does the method choose for itself: no step, no tolerance given?
bool is_default(const Setting& setting);

// Positions of `settings` in the order to run them: the scene's own and the defaults, then the
// coarsest of every family, then the next ones: each family gets its share of a short budget.
std::vector<std::size_t> running_order(const std::vector<Setting>& settings);

}  // namespace poinsot
