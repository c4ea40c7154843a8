// Small scenes in code, for tests: a few boxes, with or without a floor.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "poinsot/scene/scene.h"

namespace poinsot::test {

// A scene without bodies and without gravity.
inline Scene empty_scene(std::string world = "test") {
  Scene scene;
  scene.world = std::move(world);
  scene.simulation.gravity = Vec3::Zero();
  return scene;
}

// A homogeneous box [m], [kg], at rest.
inline BodyDef box(std::string name, const Vec3& position, const Vec3& size = Vec3(1, 1, 1),
                   double mass = 2) {
  BodyDef body;
  body.name = std::move(name);
  body.shapes.resize(1);
  body.shapes[0].shape = Box{size};
  const Vec3 s = size.cwiseAbs2();
  body.mass_properties.mass = mass;
  body.mass_properties.J =
      (mass / 12 * Vec3(s.y() + s.z(), s.z() + s.x(), s.x() + s.y())).asDiagonal();
  body.pose.c = position;
  return body;
}

// A static box whose top is the plane z = 0.
inline BodyDef floor(const std::string& name = "floor") {
  BodyDef body = box(name, Vec3(0, 0, -0.5), Vec3(20, 20, 1));
  body.is_static = true;
  body.mass_properties = {};
  return body;
}

// A homogeneous body of one shape [m], [kg/m³], at rest.
inline BodyDef body(std::string name, const Shape& shape, const Vec3& position,
                    double density = 1000) {
  BodyDef def;
  def.name = std::move(name);
  def.shapes = {{shape, {}}};
  def.mass_properties = mass_properties(shape, density);
  def.pose.c = position;
  return def;
}

// A body without a shape: nothing touches it [kg], [kg·m²].
inline BodyDef free_body(std::string name, double mass, const Vec3& principal_moments) {
  BodyDef def;
  def.name = std::move(name);
  def.mass_properties.mass = mass;
  def.mass_properties.J = principal_moments.asDiagonal();
  return def;
}

// The half-space z ≤ 0.
inline BodyDef ground(double friction = 0.5, double restitution = 0) {
  BodyDef def;
  def.name = "ground";
  def.is_static = true;
  def.shapes = {{HalfSpace{}, {}}};
  def.material = {friction, restitution};
  return def;
}

// A scene of these bodies under gravity.
inline Scene scene(std::vector<BodyDef> bodies) {
  Scene result;
  result.world = "test";
  result.bodies = std::move(bodies);
  return result;
}

}  // namespace poinsot::test
