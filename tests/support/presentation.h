// Commands and controls for tests of the presentation layer.

#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "poinsot/presentation/presentation_layer.h"
#include "support/scene_builder.h"

namespace poinsot::test {

// Boxes in the air, without gravity; the second has its centre of mass off its origin.
inline Scene floor_and_two() {
  Scene scene = empty_scene();
  scene.bodies = {floor(), box("a", Vec3(0, 0, 3)), box("b", Vec3(3, 0, 3))};
  scene.bodies[2].mass_properties.center_of_mass = Vec3(0.1, 0, 0);
  return scene;
}

inline WrenchCommand push(std::uint64_t client, std::uint64_t seq, const std::string& body = "box",
                          const Vec3& force = Vec3(1, 0, 0)) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.body_name = body;
  command.force = force;
  return command;
}

inline WrenchCommand held_push(std::uint64_t client, std::uint64_t seq,
                               const std::string& body = "box", const Vec3& force = Vec3(1, 0, 0)) {
  WrenchCommand command = push(client, seq, body, force);
  command.hold = Hold::until_cleared;
  return command;
}

inline WrenchCommand impulse(std::uint64_t client, std::uint64_t seq,
                             const std::string& body = "box", const Vec3& J = Vec3(1, 0, 0)) {
  WrenchCommand command = push(client, seq, body, J);
  command.kind = WrenchKind::impulse;
  return command;
}

inline WrenchCommand tether(std::uint64_t client, std::uint64_t seq,
                            const std::string& body = "box", const Vec3& target = Vec3(1, 0, 0)) {
  WrenchCommand command = held_push(client, seq, body);
  command.kind = WrenchKind::tether;
  command.target = target;
  command.stiffness = 10;
  command.damping = 1;
  return command;
}

inline Reply accept(PresentationLayer& layer, const WrenchCommand& command) {
  std::vector<Reply> replies;
  layer.accept({&command, 1}, replies);
  return replies.at(0);
}

inline Order order(ControlAction action, const std::string& name = {}) {
  Order order;
  order.control.client = 3;
  order.control.seq = 1;
  order.control.action = action;
  order.control.name = name;
  return order;
}

inline Reply spawn(PresentationLayer& layer, std::vector<BodyDef> bodies) {
  Order with_bodies = order(ControlAction::spawn);
  with_bodies.fragment = std::make_shared<const std::vector<BodyDef>>(std::move(bodies));
  return layer.obey(with_bodies);
}

inline Reply remove(PresentationLayer& layer, const std::string& body) {
  Order of_body = order(ControlAction::remove);
  of_body.control.body_name = body;
  return layer.obey(of_body);
}

inline Order set_state(const std::string& body) {
  Order of_body = order(ControlAction::set_state);
  of_body.control.body_name = body;
  return of_body;
}

inline Reply reset(PresentationLayer& layer, std::uint8_t scope) {
  Order scoped = order(ControlAction::reset);
  scoped.control.scope = scope;
  return layer.obey(scoped);
}
inline std::uint8_t scope_of(ResetScope scope) {
  return static_cast<std::uint8_t>(scope);
}

// Of the frame now and of those to come.
inline std::vector<std::uint64_t> hashes(PresentationLayer& layer, int frames) {
  std::vector<std::uint64_t> all = {layer.snapshot().state_hash};
  for (int n = 0; n < frames; ++n) {
    layer.advance_frame();
    all.push_back(layer.snapshot().state_hash);
  }
  return all;
}

}  // namespace poinsot::test
