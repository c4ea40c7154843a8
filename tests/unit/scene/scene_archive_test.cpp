#include "poinsot/scene/scene_archive.h"

#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "poinsot/scene/mesh.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot {
namespace {

std::vector<std::byte> bytes_of(const Scene& scene) {
  ByteWriter out;
  save(scene, out);
  return out.take();
}

Scene back(const Scene& scene) {
  const std::vector<std::byte> bytes = bytes_of(scene);
  ByteReader in(bytes);
  Scene read = load_scene_bytes(in);
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(bytes_of(read), bytes);
  return read;
}

Convex tetrahedron() {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return convex_hull(points);
}

Mesh triangle() {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<int, 3>> corners = {{0, 1, 2}};
  return make_mesh(points, corners);
}

// Every member is something else than its default.
Scene full() {
  Scene scene;
  scene.world = "w";
  scene.presentation.frame_rate = 50;
  scene.collision = {ImpactSearchKind::continuous,
                     ContactSolverKind::soft_step,
                     1,
                     2,
                     3,
                     4,
                     5,
                     6,
                     false,
                     7,
                     8,
                     9,
                     10,
                     11,
                     12};
  scene.simulation = {IntegratorKind::dopri5, 1, 2, Vec3(3, 4, 5)};
  scene.allow_overlap = true;
  BodyDef body;
  body.name = "body";
  body.is_static = body.is_kinematic = body.absent = true;
  body.generation = 7;
  for (const Shape& shape :
       {Shape(Sphere{1}), Shape(Box{{1, 2, 3}}), Shape(Capsule{1, 2}), Shape(Cylinder{3, 4}),
        Shape(Cone{5, 6}), Shape(Ellipsoid{{1, 2, 3}}), Shape(tetrahedron()),
        Shape(HalfSpace{Vec3::UnitX(), 2}), Shape(triangle())})
    body.shapes.push_back({shape, {Vec3(1, 2, 3), Quat(0.5, 0.5, 0.5, 0.5)}});
  body.mass_properties = {2, Vec3(1, 2, 3), Mat3::Identity()};
  body.pose = {Vec3(4, 5, 6), Quat(0.5, -0.5, 0.5, 0.5)};
  body.linear_velocity = Vec3(7, 8, 9);
  body.angular_velocity = Vec3(1, 3, 5);
  body.material = {0.25, 0.75};
  body.drag = {1, 2, 3};
  body.where = "file:1:2";
  scene.bodies = {body, {}};
  scene.springs = {{"a", "b", Vec3(1, 2, 3), Vec3(4, 5, 6), 7, 8, 9.0, "s"}};
  scene.wrenches = {{"body", Vec3(1, 2, 3), Vec3(4, 5, 6), Axes::body, Vec3(7, 8, 9),
                     PointFrame::world, 2, 3.0, "w"}};
  scene.pairs = {{"a", "b", 0.5, 0.25, false, "p"}};
  return scene;
}

TEST(SceneArchive, EveryMemberComesBack) {
  const Scene scene = full();
  const Scene read = back(scene);
  EXPECT_EQ(read.world, "w");
  EXPECT_EQ(read.presentation.frame_rate, 50);
  const auto collision = [](const CollisionDef& c) {
    return std::tuple(c.impact_search, c.contact_solver, c.contact_step, c.contact_tolerance,
                      c.contact_margin, c.push_out_speed, c.contact_band, c.max_impacts, c.sleeping,
                      c.sleep_acceleration, c.threads, c.allowed_penetration, c.push_out_rate,
                      c.touch_gap, c.overlap);
  };
  EXPECT_EQ(collision(read.collision), collision(scene.collision));
  EXPECT_EQ(read.simulation.integrator, IntegratorKind::dopri5);
  EXPECT_EQ(read.simulation.step, 1);
  EXPECT_EQ(read.simulation.tolerance, 2);
  EXPECT_EQ(read.simulation.gravity, Vec3(3, 4, 5));
  EXPECT_TRUE(read.allow_overlap);

  ASSERT_EQ(read.bodies.size(), 2u);
  const BodyDef& body = read.bodies[0];
  const BodyDef& was = scene.bodies[0];
  EXPECT_EQ(body.name, "body");
  EXPECT_TRUE(body.is_static && body.is_kinematic && body.absent);
  EXPECT_EQ(body.generation, 7u);
  EXPECT_EQ(body.mass_properties.mass, 2);
  EXPECT_EQ(body.mass_properties.center_of_mass, Vec3(1, 2, 3));
  EXPECT_EQ(body.mass_properties.J, was.mass_properties.J);
  EXPECT_EQ(body.pose.c, was.pose.c);
  EXPECT_EQ(body.pose.q.coeffs(), was.pose.q.coeffs());
  EXPECT_EQ(body.linear_velocity, was.linear_velocity);
  EXPECT_EQ(body.angular_velocity, was.angular_velocity);
  EXPECT_EQ(body.material.friction, 0.25);
  EXPECT_EQ(body.material.restitution, 0.75);
  EXPECT_EQ(body.drag.linear, 1);
  EXPECT_EQ(body.drag.quadratic, 2);
  EXPECT_EQ(body.drag.angular, 3);
  EXPECT_EQ(body.where, "file:1:2");

  const SpringDef& spring = read.springs.at(0);
  EXPECT_EQ(spring.a + spring.b + spring.where, "abs");
  EXPECT_EQ(spring.point_a, Vec3(1, 2, 3));
  EXPECT_EQ(spring.point_b, Vec3(4, 5, 6));
  EXPECT_EQ(std::tuple(spring.stiffness, spring.damping, spring.rest_length), std::tuple(7, 8, 9));
  const WrenchDef& wrench = read.wrenches.at(0);
  EXPECT_EQ(wrench.body + wrench.where, "bodyw");
  EXPECT_EQ(wrench.force, Vec3(1, 2, 3));
  EXPECT_EQ(wrench.torque, Vec3(4, 5, 6));
  EXPECT_EQ(wrench.point, Vec3(7, 8, 9));
  EXPECT_EQ(std::tuple(wrench.axes, wrench.point_frame, wrench.start, wrench.duration),
            std::tuple(Axes::body, PointFrame::world, 2, 3));
  const PairDef& pair = read.pairs.at(0);
  EXPECT_EQ(pair.a + pair.b + pair.where, "abp");
  EXPECT_EQ(std::tuple(pair.friction, pair.restitution, pair.collide),
            std::tuple(0.5, 0.25, false));
}

TEST(SceneArchive, EveryShapeComesBack) {
  const std::vector<ShapeDef> shapes = back(full()).bodies[0].shapes;
  ASSERT_EQ(shapes.size(), std::variant_size_v<Shape>);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    EXPECT_EQ(shapes[k].shape.index(), k);
    EXPECT_EQ(shapes[k].pose.c, Vec3(1, 2, 3));
  }
  EXPECT_EQ(std::get<Sphere>(shapes[0].shape).radius, 1);
  EXPECT_EQ(std::get<Box>(shapes[1].shape).size, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Capsule>(shapes[2].shape).length, 2);
  EXPECT_EQ(std::get<Cylinder>(shapes[3].shape).radius, 3);
  EXPECT_EQ(std::get<Cone>(shapes[4].shape).length, 6);
  EXPECT_EQ(std::get<Ellipsoid>(shapes[5].shape).semi_axes, Vec3(1, 2, 3));
  const auto& convex = std::get<Convex>(shapes[6].shape);
  EXPECT_EQ(convex.vertices, tetrahedron().vertices);
  ASSERT_EQ(convex.faces.size(), 4u);
  EXPECT_EQ(convex.faces[2].loop, tetrahedron().faces[2].loop);
  EXPECT_EQ(convex.faces[2].normal, tetrahedron().faces[2].normal);
  EXPECT_EQ(std::get<HalfSpace>(shapes[7].shape).offset, 2);
  EXPECT_EQ(std::get<Mesh>(shapes[8].shape).triangles, triangle().triangles);
}

TEST(SceneArchive, EveryShippedSceneComesBack) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(POINSOT_SCENE_DIR)) {
    if (entry.path().extension() != ".yaml") continue;
    SCOPED_TRACE(entry.path().filename());
    EXPECT_TRUE(validate(back(read_scene_file(entry.path()))).empty());
    ++scenes;
  }
  EXPECT_GT(scenes, 5);
}

TEST(SceneArchive, DamagedBytesAreAnErrorOrAnotherScene) {
  const std::vector<std::byte> bytes = bytes_of(full());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader in(std::span<const std::byte>(bytes).first(size));
    EXPECT_THROW(load_scene_bytes(in), Error) << size;
  }
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::vector<std::byte> damaged = bytes;
    damaged[bit / 8] ^= std::byte(1u << bit % 8);
    ByteReader in(damaged);
    try {
      static_cast<void>(validate(load_scene_bytes(in)));
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace poinsot
