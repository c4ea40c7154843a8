// poinsot drag: a tether, a spring with damping, from a point of a body to a point in the world.

#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "poinsot/cli/context.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

struct DragOptions {
  std::string body;
  Eigen::Vector3d to = Eigen::Vector3d::Zero();  // [m] in W
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // [m]
  PointFrame at_frame = PointFrame::body;
  bool has_point = false;
  double stiffness = 0;                  // [N/m]; 0: from the mass
  double damping = -1;                   // [N·s/m]; negative: critical
  std::chrono::nanoseconds duration{0};  // of simulated time
  bool has_duration = false;
  std::uint32_t slot = 0;  // 0: the body's own
  bool json = false;
};

void add_drag_options(CLI::App& app, DragOptions& options);

// Stiffness and damping of a body of this mass [kg], so that it is within 1 % of the way after
// kDragTime without overshooting: x″ + 2ω x′ + ω² x = 0, where (1 + ωt) exp(−ωt) = 0.01 at
// ωt = 6.64.
inline constexpr double kDragTime = 0.3;  // [s]
double drag_stiffness(double mass);
double critical_damping(double stiffness, double mass);

WrenchCommand to_command(const DragOptions& options, double mass);

Action declare_drag(CLI::App& app);

}  // namespace poinsot
