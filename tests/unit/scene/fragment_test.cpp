#include "poinsot/scene/fragment.h"

#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot {
namespace {

std::string fault_of(const std::string& text) {
  try {
    parse_fragment(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

constexpr const char* kTwo = R"(bodies:
  - {name: crate, shape: {box: [1, 2, 3]}, density: 500, position: [0, 0, 4]}
  - {name: post, static: true, shape: {cylinder: {radius: 0.1, length: 2}}}
)";

TEST(Fragment, ReadsBodiesAsASceneFileDoes) {
  const std::vector<BodyDef> bodies = parse_fragment(kTwo);
  const Scene scene = read_scene_text(kTwo, "two.yaml");
  ASSERT_EQ(bodies.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(bodies[k].name, scene.bodies[k].name);
    EXPECT_EQ(bodies[k].pose.c, scene.bodies[k].pose.c);
    EXPECT_EQ(bodies[k].mass_properties.mass, scene.bodies[k].mass_properties.mass);
    EXPECT_EQ(bodies[k].mass_properties.J, scene.bodies[k].mass_properties.J);
    EXPECT_EQ(bodies[k].shapes[0].shape.index(), scene.bodies[k].shapes[0].shape.index());
  }
  EXPECT_EQ(bodies[1].where, "spawn:3:5");
}

TEST(Fragment, AShapeMayBeSharedByAnAlias) {
  const auto bodies = parse_fragment(
      "bodies:\n"
      "  - {name: a, density: 1, shape: &s {sphere: 0.5}}\n"
      "  - {name: b, density: 1, shape: *s}\n");
  EXPECT_EQ(std::get<Sphere>(bodies[1].shapes[0].shape).radius, 0.5);
}

TEST(Fragment, OtherKeysAreRefusedAtTheirPlace) {
  EXPECT_EQ(fault_of("bodies: [{name: a, static: true}]\nworld: x\n"),
            "spawn:2:1: unknown key 'world' here, it belongs in scene");
  EXPECT_EQ(fault_of("bodys: [{name: a, static: true}]\n"),
            "spawn:1:1: unknown key 'bodys', did you mean 'bodies'?\n"
            "spawn:1:1: a fragment needs the key 'bodies'");
  EXPECT_EQ(fault_of("bodies:\n  - {name: a, static: true, shap: {sphere: 1}}\n"),
            "spawn:2:29: unknown key 'shap', did you mean 'shape'?");
}

TEST(Fragment, AllFaultsComeAtOnce) {
  EXPECT_EQ(fault_of("bodies:\n"
                     "  - {name: a, density: 1, shape: {sphere: -1}}\n"
                     "  - {name: b}\n"
                     "  - {name: b, static: true, material: {friction: -1}}\n"),
            "spawn:2:43: sphere radius must be > 0 m and at most 1e+12 m, is -1\n"
            "spawn:3:5: a body that is neither static nor kinematic needs a shape with a density, "
            "or mass and inertia\n"
            "spawn:4:12: duplicate body name 'b', first at spawn:3:5\n"
            "spawn:4:50: friction must be >= 0 and finite, is -1");
}

TEST(Fragment, NamesNoFile) {
  EXPECT_EQ(fault_of("bodies:\n  - {name: a, static: true, shape: {mesh: {file: /etc/passwd}}}\n"),
            "spawn:2:44: a fragment may name no file");
  EXPECT_EQ(fault_of("bodies:\n  - {name: a, density: 1, shape: {convex: {file: hull.obj}}}\n"),
            "spawn:2:44: a fragment may name no file");
}

TEST(Fragment, IsNeitherEmptyNorNothing) {
  EXPECT_EQ(fault_of("bodies: []\n"), "spawn:1:9: bodies must not be empty");
  EXPECT_EQ(fault_of("bodies:\n"), "spawn:1:1: bodies must be a list, is nothing");
  EXPECT_EQ(fault_of("7"), "spawn:1:1: a fragment must be a table of keys, is '7'");
  EXPECT_NE(fault_of(""), "no fault");
  EXPECT_NE(fault_of("bodies: [{name: a"), "no fault");
}

TEST(Fragment, IsBounded) {
  EXPECT_EQ(fault_of(std::string(kMaxFragmentText + 1, '#')),
            "spawn: a fragment must not be longer than 65535 bytes, has 65536");
  // A few kilobytes that would be a million bodies.
  std::string text = "bodies:\n  - &a {name: a, density: 1, shapes: [";
  for (int k = 0; k < 60; ++k) text += "{sphere: 1},";
  text += "]}\n";
  for (int k = 0; k < 8000; ++k) text += "  - *a\n";
  const std::string fault = fault_of(text);
  EXPECT_NE(fault.find("must not hold more than 65536 values, aliases counted"), std::string::npos)
      << fault.substr(0, 200);
}

}  // namespace
}  // namespace poinsot
