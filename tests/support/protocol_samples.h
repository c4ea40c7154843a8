// One message of each type of the protocol in which every field differs from its default and from
// the other fields, so that a field that is lost or swapped on the way shows.

#pragma once

#include <cstdint>
#include <limits>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot::sample {

inline const Quat kTurned(0.5, -0.5, 0.5, 0.5);  // w x y z

inline BodyState body_state(std::uint32_t i) {
  const double d = i;
  return {{i, i + 1}, {d, d + 0.25, -d}, kTurned, {1 / (d + 1), 2, 3}, {-4, 5e-300, 6 + d}};
}

inline PoseSnapshot poses(std::uint64_t frame, std::size_t bodies) {
  PoseSnapshot poses{.session = 11,
                     .epoch = 12,
                     .frame = frame,
                     .sequence = 16,
                     .sim_time_ns = 14,
                     .publish_time_ns = 15,
                     .state_hash = 0xFEDCBA9876543210u,
                     .total = 17,
                     .complete = false,
                     .bodies = {}};
  for (std::uint32_t i = 0; i < bodies; ++i) poses.bodies.push_back(body_state(i));
  return poses;
}

inline BodyInfo body_info(std::uint32_t index, std::uint32_t revision) {
  BodyInfo info;
  info.session = 21;
  info.id = {index + 100, 3};
  info.index = index;
  info.revision = revision;
  info.name = "Körper " + std::to_string(index);
  info.is_static = true;
  info.mass_properties.mass = 2.5;
  info.mass_properties.center_of_mass = {0.1, 0.2, 0.3};
  info.mass_properties.J << 1, 0.1, 0.2, 0.1, 2, 0.3, 0.2, 0.3, 2.5;
  info.pose = {{7, 8, 9}, kTurned};
  info.material = {.friction = 0.75, .restitution = 0.25};
  info.shapes = {{Box{{1, 2, 3}}, {{0.5, 0, 0}, kTurned}}};
  return info;
}

inline RunReport report() {
  RunReport report;
  report.session = 31;
  report.epoch = 32;
  report.state = RunState::paused;
  report.frame = {.frame = 33,
                  .sim_time = 34.5,
                  .bodies = 35,
                  .contacts = 36,
                  .quarantined = 37,
                  .islands = 137,
                  .restarts = 138,
                  .impact_searches = 139,
                  .impacts = 140,
                  .impacts_so_far = 1'000'000'000'000,
                  .asleep = 1141,
                  .soft_bodies = 1142,
                  .direct_bodies = 1143,
                  .solver_iterations = 1144,
                  .unconverged = 1145,
                  .contact_residual = 46e-6,
                  .energy = -38.5,
                  .energy_error = 39e-12,
                  .push_out_energy = 40.5,
                  .max_penetration = 41e-6,
                  .position_error = 41e-15,
                  .orientation_error = 42e-15,
                  .momentum_error = 43e-15,
                  .methods = {141, 142, 143, 144, 145, 146, 147, 148, 149},
                  .flags = FrameFlag::inbox_full | FrameFlag::overrun | FrameFlag::stiff |
                           FrameFlag::crowded | FrameFlag::input_late | FrameFlag::record_failed |
                           FrameFlag::rate_limited};
  report.body_methods = {Method::flight, Method::explicit_euler, Method::none, Method::taylor};
  report.frame_rate = 42.5;
  report.time_scale = 2.5;
  report.real_time_factor = 43.5;
  report.real_time_factor_window = 43.25;
  report.lateness = {1e-6, 2e-6, 3e-6};
  report.frame_time = {4e-6, 5e-6, 6e-6};
  report.scene_bodies = 61;
  report.scene_revision = 62;
  report.state_hash = 44;
  report.overruns = 45;
  report.commands_accepted = 46;
  report.commands_refused = 47;
  report.commands_limited = 147;
  report.held_wrenches = 148;
  report.checkpoints = 149;
  report.late_inputs = 150;
  report.streams = 151;
  report.recording = "log-1";
  report.clients = {{152, false, true, 153, 154, 155, 156}, {157, true, false, 158, 159, 160, 161}};
  report.snapshots_dropped = 48;
  report.events_dropped = 49;
  report.times = {{51, 52}, {53, 54}, {55, 56}, {57, 58}, {59, 60}};
  return report;
}

inline WrenchCommand wrench() {
  WrenchCommand command;
  command.client = 0xABCDEF0123456789u;
  command.seq = 62;
  command.epoch = 63;
  command.slot = 163;
  command.body = {64, 65};
  command.body_name = "box";
  command.kind = WrenchKind::tether;
  command.force = {66, 67, -68};
  command.torque = {69, -70, 71};
  command.axes = Axes::body;
  command.point = {-72, 73, 74};
  command.point_frame = PointFrame::world;
  command.target = {77, -78, 79};
  command.stiffness = 80.5;
  command.damping = 81.5;
  command.hold = Hold::duration;
  command.duration_ns = 75;
  command.start_frame = 76;
  command.outlives_client = true;
  return command;
}

inline RunControl control() {
  RunControl control;
  control.client = 81;
  control.seq = 82;
  control.epoch = 83;
  control.action = ControlAction::spawn;
  control.frames = 84;
  control.scope = 5;
  control.timeout_ns = 85;
  control.name = "check-1";
  control.on_disk = true;
  control.text = "bodies:\n  - {name: b, shape: {sphere: 1}}\n";
  control.body = {86, 87};
  control.body_name = "box";
  control.sets_position = control.sets_orientation = true;
  control.sets_linear = control.sets_angular = true;
  control.position = {1, 2, -3};
  control.orientation = kTurned;
  control.linear_velocity = {4, -5, 6};
  control.angular_velocity = {-7, 8, 9};
  return control;
}

inline Reply reply() {
  return {.client = 91,
          .seq = 92,
          .epoch = 93,
          .code = ResultCode::too_late,
          .message = "start_frame 3 has passed",
          .first_frame = 94,
          .last_frame = kForever,
          .state_hash = 95,
          .body = {96, 97}};
}

inline ImpactNotice impact() {
  return {.session = 101,
          .epoch = 102,
          .frame = 103,
          .sequence = 109,
          .time = 104.25,
          .a = {{105, 106}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}},
          .b = {{107, 108}, {-1, -2, -3}, {-4, -5, -6}, {-7, -8, -9}, {-10, -11, -12}},
          .point = {0.1, 0.2, 0.3},
          .normal = {0.6, 0, -0.8},
          .impulse = {1e-3, 2e-3, -3e-3}};
}

inline ContactSnapshot contacts() {
  return {.session = 111,
          .epoch = 112,
          .frame = 113,
          .sequence = 114,
          .sim_time_ns = 115,
          .left_out = 116,
          .contacts = {{{117, 118}, {119, 120}, {1, 2, 3}, {0, 0.6, 0.8}, {4, 5, -6}},
                       {{121, 122}, {123, 124}, {7, 8, 9}, {1, 0, 0}, {-4, 5, 6}}}};
}

inline HeldList held() {
  HeldItem item;
  item.client = 131;
  item.seq = 132;
  item.slot = 133;
  item.body = {134, 135};
  item.kind = WrenchKind::tether;
  item.axes = Axes::body;
  item.force = {1, 2, 3};
  item.torque = {4, 5, 6};
  item.point_B = {7, 8, 9};
  item.target = {10, 11, 12};
  item.stiffness = 13.5;
  item.damping = 14.5;
  item.first_frame = 136;
  item.last_frame = kForever;
  item.outlives_client = true;
  return {.session = 137,
          .epoch = 138,
          .frame = 139,
          .sequence = 140,
          .left_out = 141,
          .items = {item}};
}

}  // namespace poinsot::sample
