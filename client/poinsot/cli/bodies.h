// What is in the scene: spawn, remove, set.

#pragma once

#include "poinsot/cli/context.h"
#include "poinsot/protocol/run_control.h"

namespace poinsot {

struct SetOptions {
  RunControl control;
  Eigen::Vector3d rpy = Eigen::Vector3d::Zero();  // [rad]
  bool has_rpy = false;
  bool json = false;
};

void add_set_options(CLI::App& app, SetOptions& options);

// Throws Error if nothing is to be set.
RunControl to_control(const SetOptions& options);

Action declare_spawn(CLI::App& app);
Action declare_remove(CLI::App& app);
Action declare_set(CLI::App& app);

}  // namespace poinsot
