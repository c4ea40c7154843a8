// validate() for scenes built in code; what files add to it is in scene_file_faults_test.cpp.

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/scene/scene.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Scene good_scene() {
  Scene scene;
  scene.world = "lab";
  BodyDef ball;
  ball.name = "ball";
  ball.shapes = {{Sphere{0.5}, {}}};
  ball.mass_properties = mass_properties(Sphere{0.5}, 1000);
  BodyDef ground;
  ground.name = "ground";
  ground.is_static = true;
  ground.shapes = {{HalfSpace{}, {}}};
  scene.bodies = {ball, ground};
  return scene;
}

template <class Change>
std::vector<std::string> faults_after(Change change) {
  Scene scene = good_scene();
  change(scene);
  std::vector<std::string> result;
  for (const SceneFault& fault : validate(scene)) result.push_back(fault.path + ": " + fault.what);
  return result;
}

using Faults = std::vector<std::string>;

TEST(Validate, AcceptsAGoodScene) {
  EXPECT_EQ(faults_after([](Scene&) {}), Faults());
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies.clear(); }), Faults());
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].shapes.clear(); }), Faults());
}

TEST(Validate, ChecksTheTables) {
  EXPECT_EQ(faults_after([](Scene& s) {
              s.world = "a/b";
              s.presentation.frame_rate = 0;
              s.collision.contact_step = -1;
              s.collision.contact_tolerance = 0;
              s.collision.contact_margin = kNaN;
              s.collision.push_out_speed = -1;
              s.collision.contact_band = 0;
              s.collision.max_impacts = -1;
              s.collision.sleep_acceleration = kNaN;
              s.collision.threads = 0;
              s.simulation.step = 2;
              s.simulation.tolerance = kNaN;
              s.simulation.gravity.y() = kNaN;
            }),
            (Faults{"world: world must be 1 to 127 letters, digits, '_' or '-', is 'a/b'",
                    "presentation.frame_rate: frame_rate must be 0.001 to 1000000 Hz, is 0",
                    "collision.contact_step: contact_step must be 1e-09 to 1 s, is -1",
                    "collision.contact_tolerance: contact_tolerance must be > 0 and < 1, is 0",
                    "collision.contact_margin: contact_margin must be 0 to 1, is nan",
                    "collision.push_out_speed: push_out_speed must be >= 0 m/s and finite, is -1",
                    "collision.contact_band: contact_band must be 1e-13 to 0.001, is 0",
                    "collision.max_impacts: max_impacts must be 0 to 1000000, is -1",
                    "collision.sleep_acceleration: sleep_acceleration must be >= 0 m/s² and "
                    "finite, is nan",
                    "collision.threads: threads must be 1 to 256, is 0",
                    "simulation.step: step must be 0 (one per contact step) or 1e-09 to 1 s, is 2",
                    "simulation.tolerance: tolerance must be 0 (the integrator's own) or 1e-15 to "
                    "0.1, is nan",
                    "simulation.gravity: gravity must be finite and at most 1e+12 m/s²"}));
}

TEST(Validate, ChecksMassAndInertia) {
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].mass_properties = {}; }),
            Faults{"bodies[0].mass: mass must be > 0 kg and finite, is 0"});
  EXPECT_EQ(
      faults_after([](Scene& s) { s.bodies[0].mass_properties.J = Vec3(1, 2, 4).asDiagonal(); }),
      Faults{"bodies[0].inertia: no solid has this inertia: its principal moments are 1, 2 "
             "and 4 kg·m²; the greatest must not exceed the sum of the other two"});
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].mass_properties.J(0, 1) = 1; }),
            Faults{"bodies[0].inertia: inertia must be symmetric"});
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].mass_properties.J.setConstant(kNaN); }),
            Faults{"bodies[0].inertia: inertia must be finite"});
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].mass_properties.center_of_mass.x() = 1e13; }),
            Faults{"bodies[0].center_of_mass: center_of_mass must be finite and at most 1e+12 m"});
}

TEST(Validate, ChecksPosesAndMaterials) {
  EXPECT_EQ(
      faults_after([](Scene& s) {
        s.bodies[0].pose.c.z() = kNaN;
        s.bodies[0].pose.q = Quat(2, 0, 0, 0);
        s.bodies[0].shapes[0].pose.q.coeffs().setZero();
        s.bodies[0].linear_velocity.x() = 1e13;
        s.bodies[0].material = {-1, 1.5};
      }),
      (Faults{"bodies[0].position: position must be finite and at most 1e+12 m",
              "bodies[0].linear_velocity: linear_velocity must be finite and at most 1e+12 m/s",
              "bodies[0].orientation: orientation must be a unit quaternion, has norm 2",
              "bodies[0].material.friction: friction must be >= 0 and finite, is -1",
              "bodies[0].material.restitution: restitution must be 0 to 1, is 1.5",
              "bodies[0].shapes[0].orientation: orientation must be a unit quaternion, has "
              "norm 0"}));
}

TEST(Validate, ChecksStaticBodies) {
  EXPECT_EQ(faults_after([](Scene& s) {
              s.bodies[1].linear_velocity.x() = 1;
              s.bodies[1].angular_velocity.x() = 1;
              s.bodies[1].mass_properties.mass = 1;
            }),
            (Faults{"bodies[1].mass: a static body has no mass",
                    "bodies[1].linear_velocity: a static body has no linear_velocity",
                    "bodies[1].angular_velocity: a static body has no angular_velocity"}));
  EXPECT_EQ(faults_after([](Scene& s) {
              s.bodies[0].shapes.push_back({HalfSpace{}, {}});
            }),
            Faults{"bodies[0].shapes[1].shape: only a static body may have a half_space"});
}

TEST(Validate, TakesAnyToleranceInItsRange) {
  for (const double tolerance : {0.0, 1e-15, 1e-8, 1e-1})
    EXPECT_EQ(faults_after([&](Scene& s) { s.simulation.tolerance = tolerance; }), Faults());
  for (const double tolerance : {9e-16, 0.11, -1e-8})
    EXPECT_EQ(faults_after([&](Scene& s) { s.simulation.tolerance = tolerance; }).size(), 1u);
}

TEST(Validate, ChecksDrag) {
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[0].drag = {1, 2, 3}; }), Faults());
  EXPECT_EQ(faults_after([](Scene& s) {
              s.bodies[0].drag = {-1, kNaN, 1e13};
            }),
            (Faults{"bodies[0].drag.linear: linear drag must be 0 to 1e+12 N·s/m, is -1",
                    "bodies[0].drag.quadratic: quadratic drag must be 0 to 1e+12 N·s²/m², is nan",
                    "bodies[0].drag.angular: angular drag must be 0 to 1e+12 N·m·s/rad, is "
                    "1e+13"}));
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[1].drag.quadratic = 1; }),
            Faults{"bodies[1].drag: a static body has no drag"});
}

TEST(Validate, ChecksNames) {
  const auto named = [](std::string name) {
    return faults_after([&](Scene& s) { s.bodies[0].name = name; });
  };
  EXPECT_EQ(named("Stößel, links"), Faults());
  EXPECT_EQ(named(""), Faults{"bodies[0].name: a body's name must not be empty"});
  EXPECT_EQ(named("ground"),
            Faults{"bodies[1].name: duplicate body name 'ground', first at bodies[0]"});
  EXPECT_EQ(named(std::string(129, 'a')),
            Faults{"bodies[0].name: a body's name must have at most 127 bytes, has 129"});
  // Control characters; a lone continuation; cut short; overlong '/'; a surrogate; beyond Unicode.
  for (const char* bad : {"a\nb", "\x7f", "\xc2\x85", "\x80", "\xc3", "\xe2\x82", "\xc0\xaf",
                          "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"})
    EXPECT_EQ(named(bad), Faults{"bodies[0].name: a body's name must be printable UTF-8 text"});
  for (const char* fine : {"é", "€", "𝄞", "a b"}) EXPECT_EQ(named(fine), Faults()) << fine;
}

TEST(ShapeFault, NamesTheBadSize) {
  EXPECT_EQ(shape_fault(Box{Vec3(1, 2, 3)}), "");
  EXPECT_EQ(shape_fault(Sphere{-1}), "sphere radius must be > 0 m and at most 1e+12 m, is -1");
  EXPECT_EQ(shape_fault(Box{Vec3(1, 0, 3)}), "box size y must be > 0 m and at most 1e+12 m, is 0");
  EXPECT_EQ(shape_fault(Capsule{1, 0}), "capsule length must be > 0 m and at most 1e+12 m, is 0");
  EXPECT_EQ(shape_fault(Cylinder{kNaN, 1}),
            "cylinder radius must be > 0 m and at most 1e+12 m, is nan");
  EXPECT_EQ(shape_fault(Cone{1, 1e13}), "cone length must be > 0 m and at most 1e+12 m, is 1e+13");
  EXPECT_EQ(shape_fault(Ellipsoid{Vec3(1, 1, -2)}),
            "ellipsoid semi-axis z must be > 0 m and at most 1e+12 m, is -2");
  EXPECT_EQ(shape_fault(HalfSpace{Vec3(0, 0, 2), 0}), "half_space normal must have length 1");
  EXPECT_EQ(shape_fault(Convex{}),
            "convex must be made by convex_hull(): it has 0 vertices and 0 faces");
}

TEST(ThrowFaults, GivesALineToEachFault) {
  try {
    throw_faults({{"a.yaml:1:2", "one", "x"}, {"", "two", "bodies[0].mass"}, {"", "three", ""}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.yaml:1:2: one\nbodies[0].mass: two\nthree");
  }
}

TEST(Validate, AbsentBodiesAreNoFaultsAndPairsMayNameWhoWent) {
  Scene scene = good_scene();
  PairDef pair;
  pair.a = "gone";
  pair.b = "ball";
  pair.collide = false;
  scene.pairs.push_back(pair);
  EXPECT_EQ(validate(scene).size(), 1u);
  for (int k = 0; k < 2; ++k) {
    scene.bodies.emplace_back();
    scene.bodies.back().absent = true;
  }
  EXPECT_TRUE(validate(scene).empty());
  scene.bodies.back().shapes = {{Sphere{0.5}, {}}};
  EXPECT_EQ(validate(scene).size(), 1u);
  scene.bodies.back().shapes.clear();
  scene.bodies.back().generation = 0;
  EXPECT_EQ(validate(scene).size(), 1u);
}

}  // namespace
}  // namespace poinsot
