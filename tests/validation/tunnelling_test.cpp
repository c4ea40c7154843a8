// Nothing passes through anything: bullets against thin plates, at 60 frames per second.

#include <cmath>
#include <ostream>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "poinsot/collision/collision_layer.h"
#include "poinsot/collision/proximity.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr int kBullets = 100;

Shape hull(int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int k = 0; k < 12; ++k) {
    const double x = normal(random), y = normal(random), z = normal(random);
    points.push_back(0.015 * Vec3(x, y, z).normalized());
  }
  return convex_hull(points);
}

struct Gun {
  const char* name;
  Shape (*bullet)(int k);
  double spin;  // [rad/s]
};
const Gun kGuns[] = {
    {"Spheres", [](int) -> Shape { return Sphere{0.01}; }, 0},
    {"Boxes",
     [](int) -> Shape {
       return Box{{0.02, 0.01, 0.03}};
     },
     300},
    {"Capsules",
     [](int) -> Shape {
       return Capsule{0.01, 0.03};
     },
     300},
    {"Hulls", [](int k) -> Shape { return hull(k); }, 300},
};

enum class Plate { thin, loose, thick, mesh };

// Two triangles: the plane x = 0, 60 m wide.
Mesh wall() {
  Mesh mesh;
  mesh.vertices = {{0, -30, -30}, {0, 30, -30}, {0, 30, 30}, {0, -30, 30}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};  // looks towards −x
  return mesh;
}

BodyDef plate(Plate kind) {
  const double thickness = kind == Plate::thick ? 0.05 : 0.005;
  BodyDef body;
  if (kind == Plate::loose) {  // 18 t
    body = test::body("plate", Box{{thickness, 60, 60}}, Vec3::Zero(), 18000 / (thickness * 3600));
  } else {
    body.name = "plate";
    body.is_static = true;
    body.shapes = {{kind == Plate::mesh ? Shape(wall()) : Shape(Box{{thickness, 60, 60}}), {}}};
  }
  body.material.restitution = 0.5;
  return body;
}

Scene shots(const Gun& gun, Plate kind, double speed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> phase(0, 1), side(-1, 1);
  std::vector<BodyDef> bodies{plate(kind)};
  for (int k = 0; k < kBullets; ++k) {
    BodyDef bullet =
        test::body("bullet" + std::to_string(k), gun.bullet(k),
                   {-speed / 60 * (1.5 + phase(random)), (k % 10 - 4.5) * 5, (k / 10 - 4.5) * 5});
    bullet.linear_velocity = {speed, 0, 0};
    const double x = side(random), y = side(random), z = side(random);
    if (gun.spin > 0) bullet.angular_velocity = gun.spin * Vec3(x, y, z).normalized();
    bullet.material.restitution = 0.5;
    bodies.push_back(bullet);
  }
  Scene scene = test::scene(bodies);
  scene.simulation.gravity.setZero();
  return scene;
}

struct Case {
  Gun gun;
  Plate plate;
  double speed;
};
std::string name_of(const Case& c) {
  const char* plates[] = {"Thin", "Loose", "Thick", "Mesh"};
  return std::string(c.gun.name) + plates[static_cast<int>(c.plate)] +
         std::to_string(static_cast<int>(c.speed));
}
void PrintTo(const Case& c, std::ostream* out) {
  *out << name_of(c);
}
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Gun& gun : kGuns)
    for (const Plate plate : {Plate::thin, Plate::loose, Plate::thick, Plate::mesh})
      for (const double speed : {300.0, 1000.0}) all.push_back({gun, plate, speed});
  return all;
}

class Tunnelling : public testing::TestWithParam<Case> {};

// Penetration of the plate's near face by any bullet [m], from poses at the end of the frame.
double deepest(const Scene& scene, const World& world) {
  double depth = 0;
  const auto pose = [&](Eigen::Index i) {
    return Pose{position(world.y, i), orientation(world.y, i)};
  };
  const Collider plate(0, scene.bodies[0].shapes[0].shape, {});
  for (Eigen::Index i = 1; i < world.size(); ++i) {
    const BodyDef& def = scene.bodies[static_cast<std::size_t>(i)];
    const Pose in_body{def.shapes[0].pose.c - def.mass_properties.center_of_mass,
                       def.shapes[0].pose.q};
    const Collider bullet(i, def.shapes[0].shape, in_body);
    depth = std::max(depth, -find_gap(bullet, pose(i) * in_body, plate, pose(0)).value);
  }
  return depth;
}

TEST_P(Tunnelling, NeverHappens) {
  const Scene scene = shots(GetParam().gun, GetParam().plate, GetParam().speed);
  CollisionLayer layer(scene);
  std::uint32_t impacts = 0;
  double depth = 0;
  for (int frame = 1; frame <= 6; ++frame) {
    layer.advance_to(frame / 60.0);
    impacts += layer.report().impacts;
    depth = std::max(depth, deepest(scene, std::as_const(layer).world()));
  }
  const World& world = std::as_const(layer).world();
  for (Eigen::Index i = 1; i <= kBullets; ++i)
    EXPECT_LT(world.y(0, i), world.y(0, 0)) << "bullet " << i;
  EXPECT_GE(impacts, static_cast<std::uint32_t>(kBullets));
  EXPECT_LE(depth, 1e-6);
  EXPECT_LT(std::abs(layer.energy_error()), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Bullets, Tunnelling, testing::ValuesIn(cases()),
                         [](const auto& shot) { return name_of(shot.param); });

// Of any two shapes of the two bodies [m].
double overlap(const Scene& scene, const World& world) {
  double deepest = 0;
  const auto placed = [&](Eigen::Index body, const ShapeDef& def) {
    return Pose{position(world.y, body), orientation(world.y, body)} * def.pose;
  };
  for (const ShapeDef& a : scene.bodies[0].shapes)
    for (const ShapeDef& b : scene.bodies[1].shapes)
      deepest = std::max(deepest, -find_gap(Collider(0, a.shape, {}), placed(0, a),
                                            Collider(1, b.shape, {}), placed(1, b))
                                       .value);
  return deepest;
}

TEST(Dumbbells, ThatSpinThroughOneAnotherAlwaysMeet) {
  // Compounds against compounds, both moving: two balls on a rod each, head on and tumbling.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> side(-1, 1);
  for (int shot = 0; shot < 20; ++shot) {
    std::vector<BodyDef> pair;
    for (const double sign : {-1.0, 1.0}) {
      BodyDef body;
      body.name = sign < 0 ? "left" : "right";
      body.shapes = {{Sphere{0.05}, {.c = Vec3(0, 0, 0.2)}},
                     {Sphere{0.05}, {.c = Vec3(0, 0, -0.2)}},
                     {Capsule{0.02, 0.4}, {}}};
      body.mass_properties.mass = 2;  // as if all of it were in the balls
      body.mass_properties.J = Vec3(0.082, 0.082, 0.002).asDiagonal();
      body.pose.c = {sign * 5, 0, 0};
      body.linear_velocity = {-sign * 300, 0, 0};
      const double x = side(random), y = side(random), z = side(random);
      body.angular_velocity = 100 * Vec3(x, y, z).normalized();
      body.material = {0.3, 0.8};
      pair.push_back(body);
    }
    Scene scene = test::scene(pair);
    scene.simulation.gravity.setZero();
    CollisionLayer layer(scene);
    std::uint32_t impacts = 0;
    for (int frame = 1; frame <= 6; ++frame) {
      layer.advance_to(frame / 60.0);
      impacts += layer.report().impacts;
      EXPECT_LT(layer.report().restarts, 8u) << shot;
      EXPECT_LE(overlap(scene, std::as_const(layer).world()), 1e-6) << shot << ", frame " << frame;
    }
    EXPECT_EQ(layer.simulation().quarantined(), 0u) << shot;
    EXPECT_GE(impacts, 1u) << shot;  // the rods' middles meet head on
    const World& world = std::as_const(layer).world();
    EXPECT_NEAR((momentum(world.y, 0) + momentum(world.y, 1)).norm(), 0,
                1e-9 * world.mass[0] * 300);
  }
}

}  // namespace
}  // namespace poinsot
