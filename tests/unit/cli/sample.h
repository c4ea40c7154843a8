// A small world for the tests of what the client prints.

#pragma once

#include <vector>

#include "poinsot/protocol/body_info.h"
#include "poinsot/protocol/impact_notice.h"
#include "poinsot/protocol/pose_snapshot.h"

namespace poinsot::sample {

inline constexpr BodyId kBox{1, 1}, kBall{2, 1}, kTable{0, 1};

inline BodyInfo body(BodyId id, const std::string& name, Shape shape, double mass) {
  BodyInfo info;
  info.session = 7;
  info.id = id;
  info.name = name;
  info.is_static = mass == 0;
  info.mass_properties.mass = mass;
  info.shapes = {{.shape = std::move(shape), .pose = {}}};
  return info;
}

inline std::vector<BodyInfo> bodies() {
  return {body(kTable, "table", Box{{1, 1, 1}}, 0), body(kBox, "box", Box{{1, 1, 1}}, 2),
          body(kBall, "big ball", Sphere{0.5}, 0.25)};
}

inline PoseSnapshot poses() {
  PoseSnapshot snapshot;
  snapshot.session = 7;
  snapshot.frame = 12;
  snapshot.sim_time_ns = 200'000'000;
  BodyState box;
  box.id = kBox;
  box.position = {0.1, -2, 1e-17};
  box.orientation = Quat(0.5, 0.5, -0.5, 0.5);  // w x y z
  box.linear_velocity = {1, 0, -9.81};
  box.angular_velocity = {0, 0, 1.0 / 3};
  BodyState ball;
  ball.id = kBall;
  ball.position = {123456789, 0, 0.5};
  snapshot.bodies = {box, ball};
  return snapshot;
}

// The ball on the table.
inline ImpactNotice impact() {
  ImpactNotice notice;
  notice.session = 7;
  notice.epoch = 2;
  notice.frame = 28;
  notice.time = 0.1 + 0.35;
  notice.a = {kBall, {1, 0, -4}, {0, 0, 0}, {1, 0, 2}, {0, 0.25, 0}};
  notice.b = {kTable, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  notice.point = {0.5, 0, 1.0 / 3};
  notice.impulse = {0, 0, 1.5};
  return notice;
}

}  // namespace poinsot::sample
