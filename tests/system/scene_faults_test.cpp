// Malformed scene files: each is refused with its place and its reason, by `run` and by `check`.

#include <ostream>
#include <regex>

#include <gtest/gtest.h>

#include "system/programs.h"

namespace poinsot {
namespace {

struct Fault {
  const char* name;
  int line;
  const char* words;  // of the message
  const char* yaml;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

constexpr Fault kFaults[] = {
    {"UnknownKey", 1, "'gravity'", "simulation: {gravty: [0, 0, -9.81]}\nbodies: []\n"},
    {"UnknownTable", 1, "'simulation'", "simulatoin: {}\nbodies: []\n"},
    {"UnknownBodyKey", 2, "'density'", "bodies:\n  - {name: a, shape: {sphere: 1}, densty: 1}\n"},
    {"UnknownShape", 2, "'sphere'", "bodies:\n  - {name: a, shape: {sphere_: 1}, density: 1}\n"},
    {"UnknownIntegrator", 1, "'rk4'", "simulation: {integrator: rk5}\nbodies: []\n"},
    {"KeyOfLater", 2, "surface_velocity",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, surface_velocity: [1, 0, 0]}\n"},
    {"PairWithNobody", 4, "did you mean 'box'",
     "bodies:\n  - {name: box, shape: {sphere: 1}, density: 1}\npairs:\n"
     "  - {a: bax, b: box, collide: false}\n"},
    {"Tolerance", 1, "tolerance", "simulation: {tolerance: 1}\nbodies: []\n"},
    {"Drag", 2, "linear drag",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, drag: {linear: -1}}\n"},
    {"DragOfAStaticBody", 2, "static",
     "bodies:\n  - {name: a, static: true, drag: {quadratic: 1}}\n"},
    {"SpringOnNobody", 4, "did you mean 'box'",
     "bodies:\n  - {name: box, shape: {sphere: 1}, density: 1}\nsprings:\n"
     "  - {a: bax, point_b: [0, 0, 2], stiffness: 1}\n"},
    {"SpringOfNothing", 4, "stiffness",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nsprings:\n"
     "  - {a: a, point_b: [0, 0, 2]}\n"},
    {"SpringOnOneBody", 4, "two bodies",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nsprings:\n"
     "  - {a: a, b: a, point_b: [0, 0, 2], stiffness: 1}\n"},
    {"SpringOnTheWorldAlone", 4, "moves",
     "bodies:\n  - {name: a, static: true}\nsprings:\n"
     "  - {a: a, point_b: [0, 0, 2], stiffness: 1}\n"},
    {"SpringWithoutDirection", 4, "coincide",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nsprings:\n"
     "  - {a: a, stiffness: 1, rest_length: 1}\n"},
    {"SpringNegative", 4, "damping",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nsprings:\n"
     "  - {a: a, point_b: [0, 0, 2], stiffness: 1, damping: -1}\n"},
    {"WrenchOnNobody", 4, "did you mean 'box'",
     "bodies:\n  - {name: box, shape: {sphere: 1}, density: 1}\nwrenches:\n"
     "  - {body: bax, force: [1, 0, 0]}\n"},
    {"WrenchOnAStaticBody", 4, "static",
     "bodies:\n  - {name: a, static: true}\nwrenches:\n  - {body: a, torque: [1, 0, 0]}\n"},
    {"WrenchNotFinite", 4, "finite",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nwrenches:\n"
     "  - {body: a, force: [.nan, 0, 0]}\n"},
    {"WrenchTooLarge", 4, "1e+12 N",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nwrenches:\n"
     "  - {body: a, force: [1e13, 0, 0]}\n"},
    {"WrenchPointInTheWorldLater", 4, "time 0",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nwrenches:\n"
     "  - {body: a, force: [1, 0, 0], point: [1, 0, 0], point_frame: world, start: 1}\n"},
    {"WrenchTimes", 4, "duration",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\nwrenches:\n"
     "  - {body: a, force: [1, 0, 0], duration: -1}\n"},
    {"NoBodies", 1, "bodies", "world: empty\n"},
    {"NoName", 2, "name", "bodies:\n  - {shape: {sphere: 1}, density: 1}\n"},
    {"NoMass", 2, "density", "bodies:\n  - {name: a, shape: {sphere: 1}}\n"},
    {"WrongType", 2, "number", "bodies:\n  - {name: a, shape: {sphere: big}, density: 1}\n"},
    {"WrongLength", 2, "3", "bodies:\n  - {name: a, shape: {box: [1, 2]}, density: 1}\n"},
    {"NotFinite", 2, "finite", "bodies:\n  - {name: a, shape: {sphere: .nan}, density: 1}\n"},
    {"TooLarge", 2, "1e400", "bodies:\n  - {name: a, shape: {sphere: 1e400}, density: 1}\n"},
    {"NegativeSize", 2, "-1", "bodies:\n  - {name: a, shape: {sphere: -1}, density: 1}\n"},
    {"ZeroMass", 2, "mass", "bodies:\n  - {name: a, shape: {sphere: 1}, mass: 0}\n"},
    {"NegativeDensity", 2, "density", "bodies:\n  - {name: a, shape: {sphere: 1}, density: -7}\n"},
    {"Triangle", 2, "inertia",
     "bodies:\n  - {name: a, mass: 1, inertia: {ixx: 1, iyy: 1, izz: 3}}\n"},
    {"ZeroQuaternion", 2, "quaternion",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, orientation: {x: 0, y: 0, z: 0, w: "
     "0}}\n"},
    {"QuaternionList", 2, "orientation",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, orientation: [0, 0, 0, 1]}\n"},
    {"DuplicateName", 3, "'a'",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\n"
     "  - {name: a, shape: {sphere: 1}, density: 1, position: [9, 0, 0]}\n"},
    {"DuplicateKey", 2, "'density'",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, density: 2}\n"},
    {"Overlap", 3, "'a'",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1}\n"
     "  - {name: b, shape: {sphere: 1}, density: 1, position: [1, 0, 0]}\n"},
    {"MovingHalfSpace", 2, "half_space",
     "bodies:\n  - {name: a, shape: {half_space: {normal: [0, 0, 1]}}, mass: 1}\n"},
    {"FlatHull", 2, "convex",
     "bodies:\n  - {name: a, density: 1, shape: {convex: {points: [[0, 0, 0], [1, 0, 0], [0, 1, "
     "0], "
     "[1, 1, 0]]}}}\n"},
    {"Friction", 2, "friction",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, material: {friction: -0.1}}\n"},
    {"Restitution", 2, "restitution",
     "bodies:\n  - {name: a, shape: {sphere: 1}, density: 1, material: {restitution: 1.5}}\n"},
    {"FrameRate", 1, "frame_rate", "presentation: {frame_rate: 0}\nbodies: []\n"},
    {"Syntax", 3, "", "bodies:\n  - {name: a, shape: {sphere: 1}\n"},
};

class SceneFaults : public testing::TestWithParam<Fault> {};

TEST_P(SceneFaults, AreRefusedWithTheirPlaceByRunAndByCheck) {
  const Fault& fault = GetParam();
  const TemporaryFile file("bad.yaml", fault.yaml);
  for (const Words& arguments : {Words{"check", file.path()}, Words{"run", file.path()}}) {
    const Ended ended = run_daemon(arguments);
    EXPECT_EQ(ended.code, 2) << arguments[0];
    EXPECT_EQ(ended.out, "") << arguments[0];
    EXPECT_NE(ended.errors.find(fault.words), std::string::npos) << ended.errors;
    const std::regex place("bad\\.yaml:(\\d+):\\d+: ");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(ended.errors, match, place)) << ended.errors;
    EXPECT_EQ(match[1], std::to_string(fault.line)) << ended.errors;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, SceneFaults, testing::ValuesIn(kFaults),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(SceneFaults, OfAFileComeAllInOneGo) {
  const TemporaryFile file("bad.yaml",
                           "bodies:\n"
                           "  - {name: a, shape: {sphere: -1}, density: 1}\n"
                           "  - {name: b, shape: {sphere: 1}, densty: 1, position: [9, 0, 0]}\n");
  const std::string errors = run_daemon({"check", file.path()}).errors;
  EXPECT_NE(errors.find("bad.yaml:2:"), std::string::npos) << errors;
  EXPECT_NE(errors.find("bad.yaml:3:"), std::string::npos) << errors;
}

TEST(SceneFaults, AreNoneInTheShippedScenes) {
  for (const char* scene : {"bouncing_balls", "crowd", "incline", "pile", "projectile", "push_me",
                            "tennis_racket", "tower"}) {
    for (const std::string& name :
         {std::string(scene), std::string(POINSOT_SCENES) + "/" + scene + ".yaml"}) {
      const Ended ended = run_daemon({"check", name});
      EXPECT_EQ(ended.code, 0) << name << ended.errors;
      EXPECT_NE(ended.out.find("valid"), std::string::npos) << name;
    }
  }
}

TEST(SceneFaults, AreNoneInTheScenesOfTheTests) {
  for (const char* scene : {"drag_linear", "drag_quadratic", "racket", "spring", "torque", "tumble",
                            "two_bodies_spring"}) {
    const Ended ended =
        run_daemon({"check", std::string(POINSOT_TEST_SCENES) + "/" + scene + ".yaml"});
    EXPECT_EQ(ended.code, 0) << scene << ended.errors;
  }
}

TEST(SceneFaults, OfAFileThatIsNotThereNameIt) {
  const Ended ended = run_daemon({"check", "nowhere/nothing.yaml"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.errors.find("nowhere/nothing.yaml"), std::string::npos) << ended.errors;
}

}  // namespace
}  // namespace poinsot
