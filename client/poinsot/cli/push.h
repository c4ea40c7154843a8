// poinsot push: a force and a torque on one body, for a while, or an impulse.

#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "poinsot/cli/context.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct PushOptions {
  std::string body;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();            // [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();           // [N·m]
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();          // [N·s]
  Eigen::Vector3d angular_impulse = Eigen::Vector3d::Zero();  // [N·m·s]
  Eigen::Vector3d at = Eigen::Vector3d::Zero();               // [m]
  Axes axes = Axes::world;
  PointFrame at_frame = PointFrame::body;
  bool has_wrench = false;
  bool has_impulse = false;
  bool has_point = false;
  bool has_duration = false;
  std::chrono::nanoseconds duration{0};  // of simulated time
  std::uint64_t from_frame = 0;
  std::uint32_t slot = 0;
  bool hold = false;
  bool clear = false;
  bool json = false;
};

void add_push_options(CLI::App& app, PushOptions& options);

// Throws Error for combinations that say nothing or two things.
WrenchCommand to_command(const PushOptions& options);

Action declare_push(CLI::App& app);

}  // namespace poinsot
