// Equality of protocol structs, field by field and bit by bit: what crosses the bus must not
// change.

#pragma once

#include <gtest/gtest.h>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/contact_snapshot.h"
#include "poinsot/protocol/frame_report.h"
#include "poinsot/protocol/held_list.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"
#include "poinsot/protocol/run_control.h"
#include "poinsot/protocol/wrench_command.h"

namespace poinsot {

inline void expect_same(const BodyState& a, const BodyState& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
  EXPECT_EQ(a.linear_velocity, b.linear_velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
}

inline void expect_same(const PoseSnapshot& a, const PoseSnapshot& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.total, b.total);
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_EQ(a.sim_time_ns, b.sim_time_ns);
  EXPECT_EQ(a.publish_time_ns, b.publish_time_ns);
  EXPECT_EQ(a.state_hash, b.state_hash);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) expect_same(a.bodies[i], b.bodies[i]);
}

inline void expect_same(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.c, b.c);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
}

inline void expect_same(const BodyInfo& a, const BodyInfo& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.revision, b.revision);
  EXPECT_EQ(a.removed, b.removed);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.is_static, b.is_static);
  EXPECT_EQ(a.is_kinematic, b.is_kinematic);
  EXPECT_EQ(a.mass_properties.mass, b.mass_properties.mass);
  EXPECT_EQ(a.mass_properties.center_of_mass, b.mass_properties.center_of_mass);
  EXPECT_EQ(a.mass_properties.J, b.mass_properties.J);
  expect_same(a.pose, b.pose);
  EXPECT_EQ(a.material.friction, b.material.friction);
  EXPECT_EQ(a.material.restitution, b.material.restitution);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    EXPECT_EQ(a.shapes[i].shape.index(), b.shapes[i].shape.index());
    expect_same(a.shapes[i].pose, b.shapes[i].pose);
  }
}

inline void expect_same(const Elapsed& a, const Elapsed& b) {
  EXPECT_EQ(a.wall_s, b.wall_s);
  EXPECT_EQ(a.cpu_s, b.cpu_s);
}

inline void expect_same(const Spread& a, const Spread& b) {
  EXPECT_EQ(a.p50, b.p50);
  EXPECT_EQ(a.p99, b.p99);
  EXPECT_EQ(a.max, b.max);
}

inline void expect_same(const ClientStatus& a, const ClientStatus& b) {
  EXPECT_EQ(a.client, b.client);
  EXPECT_EQ(a.alive, b.alive);
  EXPECT_EQ(a.lock_step, b.lock_step);
  EXPECT_EQ(a.held, b.held);
  EXPECT_EQ(a.accepted, b.accepted);
  EXPECT_EQ(a.refused, b.refused);
  EXPECT_EQ(a.limited, b.limited);
}

inline void expect_same(const RunReport& a, const RunReport& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.state, b.state);
  EXPECT_EQ(a.frame.frame, b.frame.frame);
  EXPECT_EQ(a.frame.sim_time, b.frame.sim_time);
  EXPECT_EQ(a.frame.bodies, b.frame.bodies);
  EXPECT_EQ(a.frame.contacts, b.frame.contacts);
  EXPECT_EQ(a.frame.quarantined, b.frame.quarantined);
  EXPECT_EQ(a.frame.islands, b.frame.islands);
  EXPECT_EQ(a.frame.restarts, b.frame.restarts);
  EXPECT_EQ(a.frame.impact_searches, b.frame.impact_searches);
  EXPECT_EQ(a.frame.impacts, b.frame.impacts);
  EXPECT_EQ(a.frame.impacts_so_far, b.frame.impacts_so_far);
  EXPECT_EQ(a.frame.asleep, b.frame.asleep);
  EXPECT_EQ(a.frame.soft_bodies, b.frame.soft_bodies);
  EXPECT_EQ(a.frame.direct_bodies, b.frame.direct_bodies);
  EXPECT_EQ(a.frame.solver_iterations, b.frame.solver_iterations);
  EXPECT_EQ(a.frame.unconverged, b.frame.unconverged);
  EXPECT_EQ(a.frame.contact_residual, b.frame.contact_residual);
  EXPECT_EQ(a.frame.energy, b.frame.energy);
  EXPECT_EQ(a.frame.energy_error, b.frame.energy_error);
  EXPECT_EQ(a.frame.push_out_energy, b.frame.push_out_energy);
  EXPECT_EQ(a.frame.max_penetration, b.frame.max_penetration);
  EXPECT_EQ(a.frame.position_error, b.frame.position_error);
  EXPECT_EQ(a.frame.orientation_error, b.frame.orientation_error);
  EXPECT_EQ(a.frame.momentum_error, b.frame.momentum_error);
  EXPECT_EQ(a.frame.methods, b.frame.methods);
  EXPECT_EQ(a.body_methods, b.body_methods);
  EXPECT_EQ(a.frame.flags, b.frame.flags);
  EXPECT_EQ(a.frame_rate, b.frame_rate);
  EXPECT_EQ(a.time_scale, b.time_scale);
  EXPECT_EQ(a.real_time_factor, b.real_time_factor);
  EXPECT_EQ(a.real_time_factor_window, b.real_time_factor_window);
  expect_same(a.lateness, b.lateness);
  expect_same(a.frame_time, b.frame_time);
  EXPECT_EQ(a.scene_bodies, b.scene_bodies);
  EXPECT_EQ(a.scene_revision, b.scene_revision);
  EXPECT_EQ(a.commands_limited, b.commands_limited);
  EXPECT_EQ(a.held_wrenches, b.held_wrenches);
  EXPECT_EQ(a.checkpoints, b.checkpoints);
  EXPECT_EQ(a.late_inputs, b.late_inputs);
  EXPECT_EQ(a.streams, b.streams);
  EXPECT_EQ(a.recording, b.recording);
  ASSERT_EQ(a.clients.size(), b.clients.size());
  for (std::size_t i = 0; i < a.clients.size(); ++i) expect_same(a.clients[i], b.clients[i]);
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.overruns, b.overruns);
  EXPECT_EQ(a.commands_accepted, b.commands_accepted);
  EXPECT_EQ(a.commands_refused, b.commands_refused);
  EXPECT_EQ(a.snapshots_dropped, b.snapshots_dropped);
  EXPECT_EQ(a.events_dropped, b.events_dropped);
  expect_same(a.times.presentation, b.times.presentation);
  expect_same(a.times.collision, b.times.collision);
  expect_same(a.times.contact, b.times.contact);
  expect_same(a.times.simulation, b.times.simulation);
  expect_same(a.times.publishing, b.times.publishing);
}

inline void expect_same(const WrenchCommand& a, const WrenchCommand& b) {
  EXPECT_EQ(a.client, b.client);
  EXPECT_EQ(a.seq, b.seq);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.slot, b.slot);
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.body_name, b.body_name);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.target, b.target);
  EXPECT_EQ(a.stiffness, b.stiffness);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.outlives_client, b.outlives_client);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.axes, b.axes);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.point_frame, b.point_frame);
  EXPECT_EQ(a.hold, b.hold);
  EXPECT_EQ(a.duration_ns, b.duration_ns);
  EXPECT_EQ(a.start_frame, b.start_frame);
}

inline void expect_same(const RunControl& a, const RunControl& b) {
  EXPECT_EQ(a.client, b.client);
  EXPECT_EQ(a.seq, b.seq);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.action, b.action);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.scope, b.scope);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.timeout_ns, b.timeout_ns);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.on_disk, b.on_disk);
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.body_name, b.body_name);
  EXPECT_EQ(a.sets_position, b.sets_position);
  EXPECT_EQ(a.sets_orientation, b.sets_orientation);
  EXPECT_EQ(a.sets_linear, b.sets_linear);
  EXPECT_EQ(a.sets_angular, b.sets_angular);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
  EXPECT_EQ(a.linear_velocity, b.linear_velocity);
  EXPECT_EQ(a.angular_velocity, b.angular_velocity);
}

inline void expect_same(const Reply& a, const Reply& b) {
  EXPECT_EQ(a.client, b.client);
  EXPECT_EQ(a.seq, b.seq);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.code, b.code);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.first_frame, b.first_frame);
  EXPECT_EQ(a.last_frame, b.last_frame);
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.body, b.body);
}

inline void expect_same(const ImpactedBody& a, const ImpactedBody& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.linear_before, b.linear_before);
  EXPECT_EQ(a.angular_before, b.angular_before);
  EXPECT_EQ(a.linear_after, b.linear_after);
  EXPECT_EQ(a.angular_after, b.angular_after);
}

inline void expect_same(const ImpactNotice& a, const ImpactNotice& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.time, b.time);
  expect_same(a.a, b.a);
  expect_same(a.b, b.b);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.impulse, b.impulse);
}

inline void expect_same(const ContactSnapshot& a, const ContactSnapshot& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.sim_time_ns, b.sim_time_ns);
  EXPECT_EQ(a.left_out, b.left_out);
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    EXPECT_EQ(a.contacts[i].a, b.contacts[i].a);
    EXPECT_EQ(a.contacts[i].b, b.contacts[i].b);
    EXPECT_EQ(a.contacts[i].point, b.contacts[i].point);
    EXPECT_EQ(a.contacts[i].normal, b.contacts[i].normal);
    EXPECT_EQ(a.contacts[i].force, b.contacts[i].force);
  }
}

inline void expect_same(const HeldList& a, const HeldList& b) {
  EXPECT_EQ(a.session, b.session);
  EXPECT_EQ(a.epoch, b.epoch);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.left_out, b.left_out);
  ASSERT_EQ(a.items.size(), b.items.size());
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    const HeldItem &x = a.items[i], &y = b.items[i];
    EXPECT_EQ(x.client, y.client);
    EXPECT_EQ(x.seq, y.seq);
    EXPECT_EQ(x.slot, y.slot);
    EXPECT_EQ(x.body, y.body);
    EXPECT_EQ(x.kind, y.kind);
    EXPECT_EQ(x.axes, y.axes);
    EXPECT_EQ(x.force, y.force);
    EXPECT_EQ(x.torque, y.torque);
    EXPECT_EQ(x.point_B, y.point_B);
    EXPECT_EQ(x.target, y.target);
    EXPECT_EQ(x.stiffness, y.stiffness);
    EXPECT_EQ(x.damping, y.damping);
    EXPECT_EQ(x.first_frame, y.first_frame);
    EXPECT_EQ(x.last_frame, y.last_frame);
    EXPECT_EQ(x.outlives_client, y.outlives_client);
  }
}

}  // namespace poinsot
