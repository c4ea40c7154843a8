// The rules of pairs and of kinematic bodies, for scenes built in code.

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/limits.h"
#include "poinsot/scene/scene.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Scene good_scene() {
  Scene scene;
  scene.world = "lab";
  for (const char* name : {"ball", "cube", "belt"}) {
    BodyDef body;
    body.name = name;
    body.shapes = {{Sphere{0.5}, {}}};
    body.mass_properties = mass_properties(Sphere{0.5}, 1000);
    scene.bodies.push_back(body);
  }
  scene.bodies[2].is_kinematic = true;
  scene.bodies[2].mass_properties = {};
  scene.bodies[2].linear_velocity = Vec3(1, 0, 0);
  return scene;
}

PairDef pair_of(const std::string& a, const std::string& b) {
  PairDef pair;
  pair.a = a;
  pair.b = b;
  return pair;
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

TEST(ValidatePairs, AcceptsWhatMakesSense) {
  EXPECT_EQ(faults_after([](Scene&) {}), Faults());
  EXPECT_EQ(faults_after([](Scene& s) {
              s.pairs = {pair_of("ball", "cube"), pair_of("belt", "ball")};
              s.pairs[0].friction = 0;
              s.pairs[0].restitution = 1;
              s.pairs[1].collide = false;
            }),
            Faults());
}

TEST(ValidatePairs, ChecksNames) {
  EXPECT_EQ(faults_after([](Scene& s) {
              s.pairs = {pair_of("bal", "nothing near"), pair_of("cube", "cube"),
                         pair_of("ball", "belt"), pair_of("belt", "ball")};
            }),
            (Faults{"pairs[0].a: no body 'bal', did you mean 'ball'?",
                    "pairs[0].b: no body 'nothing near'",
                    "pairs[1].b: a pair must name two bodies, both are 'cube'",
                    "pairs[3]: duplicate pair of 'belt' and 'ball', first at pairs[2]"}));
}

TEST(ValidatePairs, ChecksCoefficients) {
  EXPECT_EQ(faults_after([](Scene& s) {
              s.pairs = {pair_of("ball", "cube")};
              s.pairs[0].friction = -0.5;
              s.pairs[0].restitution = kNaN;
            }),
            (Faults{"pairs[0].friction: friction must be >= 0 and finite, is -0.5",
                    "pairs[0].restitution: restitution must be 0 to 1, is nan"}));
  EXPECT_EQ(faults_after([](Scene& s) {
              s.pairs = {pair_of("ball", "cube")};
              s.pairs[0].friction = 0.5;
              s.pairs[0].collide = false;
            }),
            Faults{"pairs[0].collide: a pair that does not collide has no friction and no "
                   "restitution"});
}

TEST(ValidatePairs, BoundsTheirNumber) {
  const Faults faults =
      faults_after([](Scene& s) { s.pairs.assign(kMaxPairs + 1, pair_of("ball", "cube")); });
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0], "pairs: a scene has at most 131072 pairs, this one 131073");
}

TEST(ValidateKinematic, IsNeitherStaticNorHasItMassDragOrWrenches) {
  EXPECT_EQ(
      faults_after([](Scene& s) {
        s.bodies[2].mass_properties.mass = 1;
        s.bodies[2].drag.linear = 1;
        WrenchDef wrench;
        wrench.body = "belt";
        s.wrenches = {wrench};
        SpringDef spring;
        spring.a = "belt";
        spring.point_b = Vec3(3, 0, 0);
        spring.stiffness = 1;
        s.springs = {spring};
      }),
      (Faults{"bodies[2].drag: a kinematic body has no drag",
              "bodies[2].mass: a kinematic body has no mass",
              "springs[0].a: a spring to a kinematic body is not supported yet, 'belt' is one",
              "wrenches[0].body: a wrench acts on a body that forces move, 'belt' is "
              "kinematic"}));
  EXPECT_EQ(faults_after([](Scene& s) {
              s.bodies[2].is_static = true;
              s.bodies[2].linear_velocity.setZero();
            }),
            Faults{"bodies[2].kinematic: a body must be either static or kinematic"});
  EXPECT_EQ(faults_after([](Scene& s) { s.bodies[2].shapes[0].shape = HalfSpace{}; }),
            Faults{"bodies[2].shapes[0].shape: only a static body may have a half_space"});
}

}  // namespace
}  // namespace poinsot
