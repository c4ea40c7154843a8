// Springs and wrenches of scenes built in code; what files add to it is in
// scene_file_faults_test.cpp.

#include "poinsot/scene/validate_forces.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/limits.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Two bodies that move, 2 m apart, the second turned by 180° about z, and a wall.
Scene good_scene() {
  Scene scene;
  scene.world = "lab";
  for (const char* name : {"a", "b", "wall"}) {
    BodyDef body;
    body.name = name;
    body.mass_properties = mass_properties(Sphere{0.5}, 1000);
    scene.bodies.push_back(body);
  }
  scene.bodies[0].pose.c = Vec3(1, 0, 0);
  scene.bodies[1].pose = {Vec3(3, 0, 0), Quat(0, 0, 0, 1)};
  scene.bodies[2].is_static = true;
  scene.bodies[2].mass_properties = {};
  return scene;
}

SpringDef good_spring() {
  SpringDef spring;
  spring.a = std::string("a");
  spring.b = std::string("b");
  spring.stiffness = 10;
  spring.damping = 1;
  spring.rest_length = 1;
  return spring;
}

WrenchDef good_wrench() {
  WrenchDef wrench;
  wrench.body = std::string("a");
  wrench.force = Vec3(1, 0, 0);
  return wrench;
}

using Faults = std::vector<std::string>;

Faults faults_of(const Scene& scene) {
  Faults result;
  for (const SceneFault& fault : validate(scene)) result.push_back(fault.path + ": " + fault.what);
  return result;
}

template <class Change>
Faults with_spring(Change change) {
  Scene scene = good_scene();
  scene.springs.push_back(good_spring());
  change(scene.springs[0]);
  return faults_of(scene);
}

template <class Change>
Faults with_wrench(Change change) {
  Scene scene = good_scene();
  scene.wrenches.push_back(good_wrench());
  change(scene.wrenches[0]);
  return faults_of(scene);
}

TEST(ValidateSprings, AcceptsGoodOnes) {
  EXPECT_EQ(with_spring([](SpringDef&) {}), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.damping = 0; }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.stiffness = 0; }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.rest_length = 0; }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.rest_length.reset(); }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.b = ""; }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.b = "wall"; }), Faults());
  EXPECT_EQ(with_spring([](SpringDef& s) { s.a = "wall"; }), Faults());
}

TEST(ValidateSprings, ChecksNames) {
  EXPECT_EQ(with_spring([](SpringDef& s) { s.a = ""; }), Faults{"springs[0].a: no body ''"});
  EXPECT_EQ(with_spring([](SpringDef& s) {
              s.a = "walls";
              s.b = "wal";
            }),
            (Faults{"springs[0].a: no body 'walls', did you mean 'wall'?",
                    "springs[0].b: no body 'wal', did you mean 'wall'?"}));
  EXPECT_EQ(with_spring([](SpringDef& s) { s.b = "a"; }),
            Faults{"springs[0].b: a spring must have its ends on two bodies, both are on 'a'"});
}

TEST(ValidateSprings, NeedAnEndThatMoves) {
  const Faults expected{"springs[0]: a spring needs an end on a body that moves"};
  EXPECT_EQ(with_spring([](SpringDef& s) {
              s.a = "wall";
              s.b = "";
            }),
            expected);
  Scene scene = good_scene();
  scene.bodies.push_back(scene.bodies[2]);
  scene.bodies[3].name = "floor";
  scene.springs.push_back(good_spring());
  scene.springs[0].a = "wall";
  scene.springs[0].b = "floor";
  EXPECT_EQ(faults_of(scene), expected);
}

TEST(ValidateSprings, ChecksNumbers) {
  EXPECT_EQ(with_spring([](SpringDef& s) {
              s.point_a.x() = kNaN;
              s.point_b.y() = -2e9;
              s.stiffness = kNaN;
              s.damping = -1;
              s.rest_length = 2e12;
            }),
            (Faults{"springs[0].point_a: point_a must be finite and at most 1e+09 m",
                    "springs[0].point_b: point_b must be finite and at most 1e+09 m",
                    "springs[0].stiffness: stiffness must be 0 to 1e+12 N/m, is nan",
                    "springs[0].damping: damping must be 0 to 1e+12 N·s/m, is -1",
                    "springs[0].rest_length: rest_length must be 0 to 1e+12 m, is 2e+12"}));
  EXPECT_EQ(with_spring([](SpringDef& s) { s.stiffness = s.damping = 0; }),
            Faults{"springs[0]: a spring needs a stiffness or a damping > 0"});
}

TEST(ValidateSprings, NeedADirectionUnlessTheForceIsTheSameWithoutOne) {
  const Faults undefined{
      "springs[0]: the ends of a spring with a rest_length or a damping must not coincide at time "
      "0: the direction of its force would be undefined"};
  // (1, 0, 0) + (1, 2, 0) and (3, 0, 0) + the half turn of (1, −2, 0).
  const auto meet = [](SpringDef& s) {
    s.point_a = Vec3(1, 2, 0);
    s.point_b = Vec3(1, -2, 0);
  };
  EXPECT_EQ(with_spring(meet), undefined);
  const auto changed = [&](auto change) {
    return with_spring([&](SpringDef& s) {
      meet(s);
      change(s);
    });
  };
  EXPECT_EQ(changed([](SpringDef& s) { s.damping = 0; }), undefined);
  EXPECT_EQ(changed([](SpringDef& s) { s.rest_length = 0; }), undefined);
  EXPECT_EQ(changed([](SpringDef& s) { s.rest_length.reset(); }), undefined);
  EXPECT_EQ(changed([](SpringDef& s) { s.damping = 0, s.rest_length = 0; }), Faults());
  EXPECT_EQ(changed([](SpringDef& s) { s.damping = 0, s.rest_length.reset(); }), Faults());
  EXPECT_EQ(changed([](SpringDef& s) { s.point_a.y() += 1e-15; }), undefined);  // rounding
  EXPECT_EQ(changed([](SpringDef& s) { s.point_a.y() += 1e-9; }), Faults());
  // A point of the world, and both at the origin.
  EXPECT_EQ(with_spring([](SpringDef& s) {
              s.b = "";
              s.point_b = Vec3(1, 0, 0);
            }),
            undefined);
  Scene scene = good_scene();
  scene.bodies[0].pose.c.setZero();
  scene.springs.push_back(good_spring());
  scene.springs[0].b = "";
  EXPECT_EQ(faults_of(scene), undefined);
}

TEST(ValidateSprings, AreBounded) {
  Scene scene = good_scene();
  scene.springs.assign(kMaxSprings + 1, good_spring());
  EXPECT_EQ(faults_of(scene),
            Faults{"springs: a scene has at most 131072 springs, this one 131073"});
}

TEST(ValidateWrenches, AcceptsGoodOnes) {
  EXPECT_EQ(with_wrench([](WrenchDef&) {}), Faults());
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.axes = Axes::body;
              w.point = Vec3(1, 2, 3);
              w.point_frame = PointFrame::body;
              w.start = 1e9;
              w.duration = 1e9;
            }),
            Faults());
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.point = Vec3(1, 2, 3);
              w.point_frame = PointFrame::world;
              w.duration = 1e-12;
            }),
            Faults());
  EXPECT_EQ(with_wrench([](WrenchDef& w) { w.point.x() = kNaN; }), Faults());  // not used
}

TEST(ValidateWrenches, NeedABodyThatMoves) {
  EXPECT_EQ(with_wrench([](WrenchDef& w) { w.body = "wale"; }),
            Faults{"wrenches[0].body: no body 'wale', did you mean 'wall'?"});
  EXPECT_EQ(with_wrench([](WrenchDef& w) { w.body = "wall"; }),
            Faults{"wrenches[0].body: a wrench acts on a body that forces move, 'wall' is static"});
}

TEST(ValidateWrenches, ChecksNumbers) {
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.force.x() = 2e12;
              w.torque.y() = kNaN;
              w.point.z() = -2e9;
              w.point_frame = PointFrame::body;
              w.start = kNaN;
              w.duration = kNaN;
            }),
            (Faults{"wrenches[0].force: force must be finite and at most 1e+12 N",
                    "wrenches[0].torque: torque must be finite and at most 1e+12 N·m",
                    "wrenches[0].point: point must be finite and at most 1e+09 m",
                    "wrenches[0].start: start must be 0 to 1e+09 s, is nan",
                    "wrenches[0].duration: duration must be > 0 s and at most 1e+09 s, is nan"}));
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.start = -1;
              w.duration = 0;
            }),
            (Faults{"wrenches[0].start: start must be 0 to 1e+09 s, is -1",
                    "wrenches[0].duration: duration must be > 0 s and at most 1e+09 s, is 0"}));
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.axes = static_cast<Axes>(2);
              w.point_frame = static_cast<PointFrame>(3);
            }),
            (Faults{"wrenches[0].frame: frame must be world or body",
                    "wrenches[0].point_frame: point_frame must be center_of_mass, world or body"}));
}

TEST(ValidateWrenches, TakeAPointOfTheWorldFromTime0Only) {
  EXPECT_EQ(with_wrench([](WrenchDef& w) {
              w.point_frame = PointFrame::world;
              w.start = 0.5;
            }),
            Faults{"wrenches[0].point_frame: a point in the world becomes fixed to the body at "
                   "time 0: with a start > 0 it must be given in the body"});
}

TEST(ValidateWrenches, AreBounded) {
  Scene scene = good_scene();
  scene.wrenches.assign(kMaxHeldWrenches + 1, good_wrench());
  EXPECT_EQ(faults_of(scene),
            Faults{"wrenches: a scene has at most 65536 wrenches, this one 65537"});
}

TEST(ValidateForces, SuggestsOnlyAFewNames) {
  Scene scene = good_scene();
  scene.wrenches.assign(100, good_wrench());
  for (WrenchDef& wrench : scene.wrenches) wrench.body = "wal";
  int suggestions = 0;
  for (const std::string& fault : faults_of(scene))
    suggestions += fault.find("did you mean") != std::string::npos;
  EXPECT_EQ(suggestions, 8);
}

}  // namespace
}  // namespace poinsot
