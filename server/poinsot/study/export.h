// The study for programs: CSV and JSON, with all digits. Numbers that are infinite or none are null
// in JSON and inf or nan in CSV.

#pragma once

#include <string>

#include "poinsot/study/study.h"

namespace poinsot {

// One row per setting, skipped ones last with empty results:
//
//   integrator,setting,step,tolerance,position_error,orientation_error,position_certificate,
//   orientation_certificate,energy_error,momentum_error,simulation_us,collision_us,contact_us,runs,
//   frozen,pareto,scene,status
//
// step [s]; errors [m], [rad], [-], [-]; *_us CPU microseconds per simulated second; status is
// measured or skipped. Names as RFC 4180.
std::string to_csv(const StudyResult& result);

// One object: scene, bodies, frame_rate, frames {asked, compared up to, stride}, horizon [s],
// reference, rows, skipped, interrupted and, if an error is wanted (> 0), cheapest.
std::string to_json(const StudyResult& result, double wanted_error);

}  // namespace poinsot
