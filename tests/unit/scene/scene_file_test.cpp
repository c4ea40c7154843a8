#include "poinsot/scene/scene_file.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

Scene read(const std::string& text) {
  return read_scene_text(text, "dir/my lab.yaml");
}

TEST(SceneFile, ReadsEveryTable) {
  const Scene scene = read(R"(
world: lab-1
allow_overlap: true
presentation: {frame_rate: 120}
collision: {impact_search: none, contact_solver: soft_step, contact_step: 0.001,
            contact_tolerance: 0.01, contact_margin: 0.1, push_out_speed: 2}
simulation: {integrator: semi_implicit_euler, step: 0.0005, tolerance: 1e-9, gravity: [0, 1, 2]}
bodies: []
)");
  EXPECT_EQ(scene.world, "lab-1");
  EXPECT_TRUE(scene.allow_overlap);
  EXPECT_EQ(scene.presentation.frame_rate, 120);
  EXPECT_EQ(scene.collision.contact_step, 0.001);
  EXPECT_EQ(scene.collision.contact_solver, ContactSolverKind::soft_step);
  EXPECT_EQ(scene.collision.contact_tolerance, 0.01);
  EXPECT_EQ(scene.collision.contact_margin, 0.1);
  EXPECT_EQ(scene.collision.push_out_speed, 2);
  EXPECT_EQ(scene.simulation.integrator, IntegratorKind::semi_implicit_euler);
  EXPECT_EQ(scene.simulation.step, 0.0005);
  EXPECT_EQ(scene.simulation.tolerance, 1e-9);
  EXPECT_EQ(scene.simulation.gravity, Vec3(0, 1, 2));
}

TEST(SceneFile, HasTheDefaultsOfTheStructs) {
  const Scene scene = read("bodies: []"), fresh;
  EXPECT_EQ(scene.world, "my_lab");  // the file's name
  EXPECT_EQ(scene.presentation.frame_rate, fresh.presentation.frame_rate);
  EXPECT_EQ(scene.collision.contact_step, fresh.collision.contact_step);
  EXPECT_EQ(scene.simulation.gravity, fresh.simulation.gravity);
  EXPECT_FALSE(scene.allow_overlap);
}

TEST(SceneFile, AProfileSetsDefaultsWhereverItStands) {
  const Scene scene = read("bodies: []\ncollision: {contact_step: 0.002}\nprofile: fast");
  EXPECT_EQ(scene.collision.contact_tolerance, collision_defaults(Profile::fast).contact_tolerance);
  EXPECT_EQ(scene.collision.contact_step, 0.002);
  EXPECT_EQ(read("bodies: []\ncollision: {contact_tolerance: 0.1}\nprofile: fast")
                .collision.contact_tolerance,
            0.1);
  EXPECT_EQ(read("bodies: []\nprofile: accurate").collision.contact_tolerance,
            CollisionDef().contact_tolerance);
}

TEST(SceneFile, ReadsABody) {
  const Scene scene = read(R"(
bodies:
  - name: top
    shape: {box: [0.4, 0.2, 0.1]}
    density: 1000
    position: [1, 2, 3]
    orientation: {x: 0, y: 0, z: 0.7071, w: 0.7071}
    linear_velocity: [4, 5, 6]
    angular_velocity: [7, 8, 9]
    material: {friction: 0.25, restitution: 0.75}
)");
  ASSERT_EQ(scene.bodies.size(), 1u);
  const BodyDef& top = scene.bodies[0];
  EXPECT_EQ(top.name, "top");
  EXPECT_EQ(top.where, "dir/my lab.yaml:3:5");
  EXPECT_NEAR(top.mass_properties.mass, 8, 8 * kRounding);
  EXPECT_TRUE(top.mass_properties.J.isApprox(mass_properties(Box{Vec3(0.4, 0.2, 0.1)}, 1000).J));
  EXPECT_EQ(top.pose.c, Vec3(1, 2, 3));
  EXPECT_NEAR(top.pose.q.norm(), 1, kRounding);  // four digits in the file, normalised
  EXPECT_NEAR((top.pose.q * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 0, kRounding);
  EXPECT_EQ(top.linear_velocity, Vec3(4, 5, 6));
  EXPECT_EQ(top.angular_velocity, Vec3(7, 8, 9));
  EXPECT_EQ(top.material.friction, 0.25);
  EXPECT_EQ(top.material.restitution, 0.75);
}

TEST(SceneFile, ReadsEveryShape) {
  const Scene scene = read(R"(
bodies:
  - name: all
    static: true
    shapes:
      - {sphere: 1}
      - {box: [1, 2, 3]}
      - {capsule: {radius: 1, length: 2}}
      - {cylinder: {radius: 3, length: 4}}
      - {cone: {radius: 5, length: 6}}
      - {ellipsoid: [1, 2, 3]}
      - {convex: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
      - {half_space: {normal: [3, 0, 4], offset: 2}, position: [1, 1, 1], orientation: {rpy: [0, 0, 1]}}
)");
  const auto& shapes = scene.bodies[0].shapes;
  ASSERT_EQ(shapes.size(), kShapeNames.size() - 1);  // a mesh needs a file: mesh_file_test.cpp
  for (std::size_t i = 0; i < shapes.size(); ++i) EXPECT_EQ(shapes[i].shape.index(), i);
  EXPECT_EQ(std::get<Sphere>(shapes[0].shape).radius, 1);
  EXPECT_EQ(std::get<Box>(shapes[1].shape).size, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Capsule>(shapes[2].shape).length, 2);
  EXPECT_EQ(std::get<Cylinder>(shapes[3].shape).radius, 3);
  EXPECT_EQ(std::get<Cone>(shapes[4].shape).length, 6);
  EXPECT_EQ(std::get<Ellipsoid>(shapes[5].shape).semi_axes, Vec3(1, 2, 3));
  EXPECT_EQ(std::get<Convex>(shapes[6].shape).faces.size(), 4u);
  EXPECT_TRUE(std::get<HalfSpace>(shapes[7].shape).normal.isApprox(Vec3(0.6, 0, 0.8)));
  EXPECT_EQ(std::get<HalfSpace>(shapes[7].shape).offset, 2);
  EXPECT_EQ(shapes[7].pose.c, Vec3(1, 1, 1));
  EXPECT_NEAR(angle_between(shapes[7].pose.q, Quat::Identity()), 1, kRounding);
  EXPECT_EQ(scene.bodies[0].mass_properties.mass, 0);
}

TEST(SceneFile, AddsUpCompoundsOfDifferentDensities) {
  const Scene scene = read(R"(
bodies:
  - name: hammer
    density: 1000
    shapes:
      - {box: [1, 0.1, 0.1]}
      - {box: [0.2, 0.1, 0.1], density: 5000, position: [0.6, 0, 0]}
)");
  const MassProperties& m = scene.bodies[0].mass_properties;  // both parts weigh 10 kg
  EXPECT_NEAR(m.mass, 20, 20 * kRounding);
  EXPECT_NEAR((m.center_of_mass - Vec3(0.3, 0, 0)).norm(), 0, kRounding);
  EXPECT_NEAR(m.J(0, 0), 20 * 0.02 / 12, kRounding);
  EXPECT_NEAR(m.J(1, 1), 10 * (1.01 + 0.05) / 12 + 20 * 0.09, 2 * kRounding);
}

TEST(SceneFile, ScalesTheSolidToAGivenMass) {
  const Scene scene = read(R"(
bodies:
  - {name: cone, shape: {cone: {radius: 1, length: 4}, position: [0, 0, 1]}, mass: 3}
)");
  const MassProperties& m = scene.bodies[0].mass_properties;
  EXPECT_EQ(m.mass, 3);
  EXPECT_NEAR(m.center_of_mass.norm(), 0, kRounding);  // −length/4 + 1
  EXPECT_NEAR(m.J(2, 2), 0.3 * 3, kRounding);
  EXPECT_NEAR(m.J(0, 0), 3 * 3.0 / 80 * (4 + 16), 4 * kRounding);
}

TEST(SceneFile, TakesExplicitMassCentreAndInertia) {
  const Scene scene = read(R"(
bodies:
  - name: ghost
    mass: 2
    center_of_mass: [0.1, 0.2, 0.3]
    inertia: {ixx: 3, iyy: 4, izz: 5, ixy: 0.1, ixz: 0.2, iyz: 0.3}
  - {name: plain, mass: 2, inertia: {ixx: 3, iyy: 4, izz: 5}, shape: {sphere: 1}}
)");
  const MassProperties& m = scene.bodies[0].mass_properties;
  EXPECT_EQ(m.mass, 2);
  EXPECT_EQ(m.center_of_mass, Vec3(0.1, 0.2, 0.3));
  Mat3 J;
  J << 3, 0.1, 0.2, 0.1, 4, 0.3, 0.2, 0.3, 5;
  EXPECT_EQ(m.J, J);
  EXPECT_TRUE(scene.bodies[0].shapes.empty());
  EXPECT_EQ(scene.bodies[1].mass_properties.J, Mat3(Vec3(3, 4, 5).asDiagonal()));
}

TEST(SceneFile, ReadsDrag) {
  const Scene scene = read(R"(
bodies:
  - {name: a, density: 1, shape: {sphere: 1}, drag: {linear: 0.5, quadratic: 0.25, angular: 2}}
  - {name: b, density: 1, shape: {sphere: 1}, drag: {quadratic: 3}}
)");
  EXPECT_EQ(scene.bodies[0].drag.linear, 0.5);
  EXPECT_EQ(scene.bodies[0].drag.quadratic, 0.25);
  EXPECT_EQ(scene.bodies[0].drag.angular, 2);
  EXPECT_EQ(scene.bodies[1].drag.linear, 0);
  EXPECT_EQ(scene.bodies[1].drag.quadratic, 3);
}

TEST(SceneFile, ReadsSprings) {
  const Scene scene = read(R"(
bodies:
  - {name: a, density: 1, shape: {sphere: 1}}
  - {name: b, density: 1, shape: {sphere: 1}}
springs:
  - {a: a, point_a: [1, 2, 3], b: b, point_b: [4, 5, 6], stiffness: 7, damping: 8, rest_length: 9}
  - {a: b, point_b: [0, 0, 5], stiffness: 10}
)");
  ASSERT_EQ(scene.springs.size(), 2u);
  const SpringDef& full = scene.springs[0];
  EXPECT_EQ(full.a, "a");
  EXPECT_EQ(full.b, "b");
  EXPECT_EQ(full.point_a, Vec3(1, 2, 3));
  EXPECT_EQ(full.point_b, Vec3(4, 5, 6));
  EXPECT_EQ(full.stiffness, 7);
  EXPECT_EQ(full.damping, 8);
  EXPECT_EQ(full.rest_length, 9);
  EXPECT_EQ(full.where, "dir/my lab.yaml:6:5");
  const SpringDef& least = scene.springs[1];
  EXPECT_EQ(least.a, "b");
  EXPECT_EQ(least.b, "");
  EXPECT_EQ(least.point_a, Vec3(0, 0, 0));
  EXPECT_EQ(least.damping, 0);
  EXPECT_EQ(least.rest_length, std::nullopt);
}

TEST(SceneFile, LetsTheEndsOfAPureSpringCoincide) {
  const Scene scene = read(R"(
bodies: [{name: a, density: 1, shape: {sphere: 1}}]
springs: [{a: a, stiffness: 1, rest_length: 0}]
)");
  EXPECT_EQ(scene.springs[0].rest_length, 0);
}

TEST(SceneFile, ReadsWrenches) {
  const Scene scene = read(R"(
bodies: [{name: a, density: 1, shape: {sphere: 1}}]
wrenches:
  - {body: a, force: [1, 2, 3], torque: [4, 5, 6], frame: body, point: [7, 8, 9],
     point_frame: body, start: 0.5, duration: 2}
  - {body: a, force: [1, 0, 0], point: [0, 0, 1]}
  - {body: a, force: [1, 0, 0], point: [0, 0, 1], point_frame: world}
  - {body: a, torque: [0, 0, 1]}
)");
  ASSERT_EQ(scene.wrenches.size(), 4u);
  const WrenchDef& full = scene.wrenches[0];
  EXPECT_EQ(full.body, "a");
  EXPECT_EQ(full.force, Vec3(1, 2, 3));
  EXPECT_EQ(full.torque, Vec3(4, 5, 6));
  EXPECT_EQ(full.axes, Axes::body);
  EXPECT_EQ(full.point, Vec3(7, 8, 9));
  EXPECT_EQ(full.point_frame, PointFrame::body);
  EXPECT_EQ(full.start, 0.5);
  EXPECT_EQ(full.duration, 2);
  EXPECT_EQ(scene.wrenches[1].point_frame, PointFrame::body);  // given a point
  EXPECT_EQ(scene.wrenches[1].axes, Axes::world);
  EXPECT_EQ(scene.wrenches[2].point_frame, PointFrame::world);
  EXPECT_EQ(scene.wrenches[3].point_frame, PointFrame::center_of_mass);
  EXPECT_EQ(scene.wrenches[3].force, Vec3(0, 0, 0));
  EXPECT_EQ(scene.wrenches[3].start, 0);
  EXPECT_EQ(scene.wrenches[3].duration, std::nullopt);
}

TEST(SceneFile, LetsAStaticBodyKeepItsDensityUnused) {
  const Scene scene =
      read("bodies: [{name: wall, static: true, shape: {box: [1, 1, 1]}, density: 5}]");
  EXPECT_TRUE(scene.bodies[0].is_static);
  EXPECT_EQ(scene.bodies[0].mass_properties.mass, 0);
}

TEST(SceneFile, LetsAKinematicBodyMoveWithoutMass) {
  const Scene scene = read(R"(
bodies:
  - {name: belt, kinematic: true, shape: {box: [1, 1, 1]}, linear_velocity: [1, 0, 0]}
  - {name: wheel, kinematic: true, shape: {box: [1, 1, 1]}, mass: 5, angular_velocity: [0, 0, 2]}
)");
  for (const BodyDef& body : scene.bodies) {
    EXPECT_TRUE(body.is_kinematic);
    EXPECT_FALSE(body.is_static);
    EXPECT_EQ(body.mass_properties.mass, 0);
    EXPECT_EQ(body.mass_properties.center_of_mass, Vec3(0, 0, 0));
  }
  EXPECT_EQ(scene.bodies[0].linear_velocity, Vec3(1, 0, 0));
  EXPECT_EQ(scene.bodies[1].angular_velocity, Vec3(0, 0, 2));
}

TEST(SceneFile, ReadsPairs) {
  const Scene scene = read(R"(
bodies:
  - {name: a, density: 1, shape: {sphere: 1}}
  - {name: b, density: 1, shape: {sphere: 1}, position: [3, 0, 0]}
  - {name: c, density: 1, shape: {sphere: 1}, position: [6, 0, 0]}
pairs:
  - {a: a, b: b, friction: 0.25, restitution: 1}
  - {a: c, b: a, collide: false}
)");
  ASSERT_EQ(scene.pairs.size(), 2u);
  EXPECT_EQ(scene.pairs[0].a, "a");
  EXPECT_EQ(scene.pairs[0].b, "b");
  EXPECT_EQ(scene.pairs[0].friction, 0.25);
  EXPECT_EQ(scene.pairs[0].restitution, 1);
  EXPECT_TRUE(scene.pairs[0].collide);
  EXPECT_EQ(scene.pairs[0].where, "dir/my lab.yaml:7:5");
  EXPECT_EQ(scene.pairs[1].friction, std::nullopt);
  EXPECT_FALSE(scene.pairs[1].collide);
}

TEST(SceneFile, ReadsEveryKeyOfTheCollisionLayer) {
  const CollisionDef c = read(R"(
collision: {impact_search: backtracking, contact_band: 1.0e-9, max_impacts: 7, sleeping: false,
            sleep_acceleration: 0.001, threads: 2}
bodies: []
)")
                             .collision;
  EXPECT_EQ(c.impact_search, ImpactSearchKind::backtracking);
  EXPECT_EQ(c.contact_band, 1e-9);
  EXPECT_EQ(c.max_impacts, 7);
  EXPECT_FALSE(c.sleeping);
  EXPECT_EQ(c.sleep_acceleration, 1e-3);
  EXPECT_EQ(c.threads, 2);
}

TEST(SceneFile, AllowsAnchorsAndJson) {
  const Scene scene = read(R"({"bodies": [
    {"name": "a", "shape": &s {"box": [1, 1, 1]}, "density": 1},
    {"name": "b", "shape": *s, "density": 2}]})");
  EXPECT_EQ(std::get<Box>(scene.bodies[1].shapes[0].shape).size, Vec3(1, 1, 1));
}

TEST(SceneFile, SaysWhyItCannotBeRead) {
  const auto refusal = [](const std::filesystem::path& file) {
    try {
      read_scene_file(file);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("no/such.yaml"), "no/such.yaml: cannot be read: No such file or directory");
  EXPECT_EQ(refusal("."), ".: cannot be read: it is a directory");
  // It never ends: who reads it whole before looking at its size never comes back.
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: a scene file must not be longer than 33554432 bytes");
}

// Shipped scenes ----------------------------------------------------------------------------------

TEST(ShippedScenes, AreRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(POINSOT_SCENE_DIR)) {
    const Scene scene = read_scene_file(entry.path());
    EXPECT_EQ(scene.world, entry.path().stem().string());
    EXPECT_FALSE(scene.bodies.empty());
    ++count;
  }
  EXPECT_GE(count, 7);
}

// Scenes of the validation suite, each with its closed form in its header.
TEST(TestScenes, AreRead) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(POINSOT_TEST_SCENE_DIR)) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_FALSE(read_scene_file(entry.path()).bodies.empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

Scene shipped(const std::string& name) {
  return read_scene_file(std::filesystem::path(POINSOT_SCENE_DIR) / (name + ".yaml"));
}

TEST(ShippedScenes, TheRacketFlipsWhenItsHeaderSays) {
  const Scene scene = shipped("tennis_racket");
  const BodyDef& racket = scene.bodies.at(0);
  const Mat3& inertia = racket.mass_properties.J;
  ASSERT_TRUE(inertia.isDiagonal(1e-15));
  const Vec3 J = inertia.diagonal();
  ASSERT_TRUE(J.x() < J.y() && J.y() < J.z());
  const Vec3 L = J.cwiseProduct(racket.angular_velocity);
  const double L2 = L.squaredNorm(), E2 = L.dot(racket.angular_velocity);
  // E2 J₂ > L²: the angular momentum circles J₁, and the formula holds with J₁ and J₃ exchanged.
  const double a = L2 > E2 * J.y() ? J.x() : J.z(), c = L2 > E2 * J.y() ? J.z() : J.x();
  const double p = std::sqrt((c - J.y()) * (L2 - E2 * a) / J.prod());
  const double m = (J.y() - a) * (E2 * c - L2) / ((c - J.y()) * (L2 - E2 * a));
  EXPECT_NEAR(2 * std::comp_ellint_1(std::sqrt(m)) / p, 1.8091, 5e-5);
}

TEST(ShippedScenes, ThePileIsAThousandBoxesOf3125Kilograms) {
  const Scene scene = shipped("pile");
  double mass = 0;
  int boxes = 0;
  for (const BodyDef& body : scene.bodies) {
    mass += body.mass_properties.mass;
    boxes += !body.is_static;
  }
  EXPECT_EQ(boxes, 1000);
  EXPECT_NEAR(mass, 3125, 3125 * 1000 * std::numeric_limits<double>::epsilon());
  // Spheres around the boxes do not meet, so the boxes do not.
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const BodyDef &a = scene.bodies[i], &b = scene.bodies[j];
      if (a.is_static || b.is_static) continue;
      gap = std::min(gap, (a.pose.c - b.pose.c).norm() - bounding_radius(a.shapes[0].shape) -
                              bounding_radius(b.shapes[0].shape));
    }
  EXPECT_GT(gap, 0);
}

TEST(ShippedScenes, TheSlopeIsOneDownOnTwoAlongAndTheBoxesLieOnIt) {
  const Scene scene = shipped("incline");
  const Vec3 normal = std::get<HalfSpace>(scene.bodies.at(0).shapes[0].shape).normal;
  EXPECT_NEAR(normal.x() / normal.z(), 0.5, kRounding);
  for (const BodyDef& body : scene.bodies) {
    const auto* box =
        body.shapes[0].shape.index() == 1 ? &std::get<Box>(body.shapes[0].shape) : nullptr;
    if (!box) continue;
    EXPECT_NEAR((body.pose.q * Vec3::UnitZ() - normal).norm(), 0, kRounding) << body.name;
    EXPECT_NEAR(normal.dot(body.pose.c), box->size.z() / 2, kRounding) << body.name;
  }
}

}  // namespace
}  // namespace poinsot
