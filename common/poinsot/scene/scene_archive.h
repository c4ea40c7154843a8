// A scene as bytes and back (base/archive.h): for checkpoints, which keep the scene that a run has
// come to. The same scene gives the same bytes. Every struct is bound to as many names as it has
// members, so that a new one does not compile until it is written too.
//
// What is read has the types' values and sound meshes and polyhedra; that it is a scene that can
// run, validate() says.

#pragma once

#include <algorithm>

#include "poinsot/base/archive.h"
#include "poinsot/scene/scene.h"

namespace poinsot {

template <class Archive>
void archive(Archive& with, Sphere& shape) {
  auto& [radius] = shape;
  with(radius);
}
template <class Archive>
void archive(Archive& with, Box& shape) {
  auto& [size] = shape;
  with(size);
}
template <class Archive>
void archive(Archive& with, Capsule& shape) {
  auto& [radius, length] = shape;
  with(radius, length);
}
template <class Archive>
void archive(Archive& with, Cylinder& shape) {
  auto& [radius, length] = shape;
  with(radius, length);
}
template <class Archive>
void archive(Archive& with, Cone& shape) {
  auto& [radius, length] = shape;
  with(radius, length);
}
template <class Archive>
void archive(Archive& with, Ellipsoid& shape) {
  auto& [semi_axes] = shape;
  with(semi_axes);
}
template <class Archive>
void archive(Archive& with, Convex::Face& face) {
  auto& [normal, offset, loop] = face;
  with(normal, offset, loop);
}
template <class Archive>
void archive(Archive& with, HalfSpace& shape) {
  auto& [normal, offset] = shape;
  with(normal, offset);
}

namespace archive_detail {

// Throws unless all are indices into something of `size` elements.
template <class Indices>
void check_indices(const Indices& indices, std::size_t size) {
  const bool sound = std::all_of(indices.begin(), indices.end(), [&](int index) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
  });
  if (!sound) ByteReader::fail();
}

}  // namespace archive_detail

template <class Archive>
void archive(Archive& with, Convex& shape) {
  auto& [vertices, faces] = shape;
  with(vertices, faces);
  if constexpr (Archive::kReads) {
    if (vertices.empty() || faces.empty()) with.fail();
    for (const Convex::Face& face : faces) {
      if (face.loop.size() < 3) with.fail();
      archive_detail::check_indices(face.loop, vertices.size());
    }
  }
}
template <class Archive>
void archive(Archive& with, Mesh& shape) {
  auto& [vertices, triangles, left_out] = shape;
  with(vertices, triangles, left_out);
  if constexpr (Archive::kReads) {
    if (triangles.empty()) with.fail();
    for (const std::array<int, 3>& corners : triangles)
      archive_detail::check_indices(corners, vertices.size());
  }
}

template <class Archive>
void archive(Archive& with, Material& material) {
  auto& [friction, restitution] = material;
  with(friction, restitution);
}
template <class Archive>
void archive(Archive& with, DragDef& drag) {
  auto& [linear, quadratic, angular] = drag;
  with(linear, quadratic, angular);
}
template <class Archive>
void archive(Archive& with, MassProperties& properties) {
  auto& [mass, center_of_mass, J] = properties;
  with(mass, center_of_mass, J);
}
template <class Archive>
void archive(Archive& with, ShapeDef& def) {
  auto& [shape, pose] = def;
  with(shape, pose);
}
template <class Archive>
void archive(Archive& with, BodyDef& body) {
  auto& [name, is_static, is_kinematic, shapes, mass_properties, pose, linear_velocity,
         angular_velocity, material, drag, where, absent, generation] = body;
  with(name, is_static, is_kinematic, shapes, mass_properties, pose, linear_velocity,
       angular_velocity, material, drag, where, absent, generation);
}
template <class Archive>
void archive(Archive& with, SpringDef& spring) {
  auto& [a, b, point_a, point_b, stiffness, damping, rest_length, where] = spring;
  with(a, b, point_a, point_b, stiffness, damping, rest_length, where);
}
template <class Archive>
void archive(Archive& with, WrenchDef& wrench) {
  auto& [body, force, torque, axes, point, point_frame, start, duration, where] = wrench;
  with(body, force, torque, point, start, duration, where);
  with.choice(axes, Axes::body);
  with.choice(point_frame, PointFrame::body);
}
template <class Archive>
void archive(Archive& with, PairDef& pair) {
  auto& [a, b, friction, restitution, collide, where] = pair;
  with(a, b, friction, restitution, collide, where);
}

template <class Archive>
void archive(Archive& with, SimulationDef& def) {
  auto& [integrator, step, tolerance, gravity] = def;
  with.choice(integrator, IntegratorKind::explicit_euler);
  with(step, tolerance, gravity);
}
template <class Archive>
void archive(Archive& with, CollisionDef& def) {
  auto& [impact_search, contact_solver, contact_step, contact_tolerance, contact_margin,
         push_out_speed, contact_band, max_impacts, sleeping, sleep_acceleration, threads,
         allowed_penetration, push_out_rate, touch_gap, overlap] = def;
  with.choice(impact_search, ImpactSearchKind::none);
  with.choice(contact_solver, ContactSolverKind::convex_newton);
  with(contact_step, contact_tolerance, contact_margin, push_out_speed, contact_band, max_impacts,
       sleeping, sleep_acceleration, threads, allowed_penetration, push_out_rate, touch_gap,
       overlap);
}
template <class Archive>
void archive(Archive& with, PresentationDef& def) {
  auto& [frame_rate] = def;
  with(frame_rate);
}
template <class Archive>
void archive(Archive& with, Scene& scene) {
  auto& [world, presentation, collision, simulation, allow_overlap, bodies, springs, wrenches,
         pairs] = scene;
  with(world, presentation, collision, simulation, allow_overlap, bodies, springs, wrenches, pairs);
}

inline void save(const Scene& scene, ByteWriter& out) {
  out(scene);
}
// Throws Error for bytes that are no scene.
inline Scene load_scene_bytes(ByteReader& in) {
  Scene scene;
  in(scene);
  return scene;
}

}  // namespace poinsot
