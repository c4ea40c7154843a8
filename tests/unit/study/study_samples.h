// Results of studies as they might come out, for tests of what is made of them.

#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/study/settings.h"
#include "poinsot/study/study.h"

namespace poinsot::test {

// A fixed method at `step` [s] or an adaptive one at `step` as its tolerance.
inline Setting setting(IntegratorKind kind, double step) {
  SimulationDef simulation;
  simulation.integrator = kind;
  (is_adaptive(kind) ? simulation.tolerance : simulation.step) = step;
  return make_setting(simulation);
}

// Costs in microseconds per simulated second.
inline Row row(const Setting& setting, PoseError error, double cost_us) {
  Row row;
  row.setting = setting;
  row.measured = error;
  row.cost.simulation = cost_us * 1e-6;
  row.runs = 5;
  return row;
}

// Rows with a certificate of 1e-12 m and 2e-13 rad.
inline StudyResult result(std::vector<Row> rows) {
  StudyResult result;
  result.scene = "top_spin";
  result.bodies = 2;
  result.asked = result.horizon = 600;
  result.reference.name = "taylor default";
  result.reference.check = "dop853 1e-13";
  result.reference.certificate = {1e-12, 2e-13};
  result.reference.limit = {1e-7, 1e-6};
  result.rows = std::move(rows);
  return result;
}

// Curves of several methods, as one free body gives them.
inline StudyResult full_result() {
  using enum IntegratorKind;
  std::vector<Row> rows;
  const auto add = [&rows](IntegratorKind kind, double number, double error, double cost_us) {
    rows.push_back(row(setting(kind, number), {error / 10, error}, cost_us));
  };
  add(exact, 0, 4e-14, 5.4);
  const double tolerances[] = {1e-3, 1e-5, 1e-7, 1e-9, 1e-11};
  const double taylor_cost[] = {8, 8.2, 9, 9.5, 11},
               taylor_error[] = {2e-5, 3e-8, 1e-10, 3e-12, 1e-13};
  const double dop853_cost[] = {14, 15, 17, 22, 34},
               dop853_error[] = {2e-2, 3e-4, 4e-6, 5e-8, 4e-10};
  const double dopri5_cost[] = {13, 18, 31, 62, 140},
               dopri5_error[] = {0.2, 5e-3, 4e-5, 5e-7, 5e-9};
  for (int i = 0; i < 5; ++i) add(taylor, tolerances[i], taylor_error[i], taylor_cost[i]);
  for (int i = 0; i < 5; ++i) add(dop853, tolerances[i], dop853_error[i], dop853_cost[i]);
  for (int i = 0; i < 5; ++i) add(dopri5, tolerances[i], dopri5_error[i], dopri5_cost[i]);
  for (int i = 0; i < 4; ++i) {
    const double parts = 1 << (2 * i), step = 1 / (60 * parts);
    add(rk4, step, 1e-5 / (parts * parts * parts * parts), 10 * parts);
    add(semi_implicit_euler, step, 3 / parts, 4 * parts);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return a.setting.simulation.integrator < b.setting.simulation.integrator;
  });
  return result(std::move(rows));
}

}  // namespace poinsot::test
