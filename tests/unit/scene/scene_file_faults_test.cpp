// Malformed scenes: each gets exactly its message, at its place.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot {
namespace {

struct Malformed {
  std::string name;
  std::string text;
  std::string error;
};

std::string refusal(const std::string& text) {
  try {
    read_scene_text(text, "s.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class MalformedScene : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedScene, GetsItsMessageAtItsPlace) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().error);
}

// A body with one more key, on line 2 from column 24.
std::string with(const std::string& keys) {
  return "bodies:\n  - {name: a, mass: 1, " + keys + "}\n";
}
// A body of some shape, which begins on line 2 in column 22.
std::string of(const std::string& shape) {
  return "bodies:\n  - {name: a, shape: {" + shape + "}, density: 1}\n";
}

const std::string kKnown =
    ", known here: world, presentation, collision, simulation, allow_overlap, bodies";

const std::vector<Malformed> kMalformed = {
    // The whole
    {"Empty", "", "s.yaml:1:1: the scene file is empty"},
    {"NotATable", "[1, 2]", "s.yaml:1:1: a scene must be a table of keys, is a list of 2"},
    {"SyntaxAlone", "spring: 1\nbodies: [\n", "s.yaml:3:1: YAML: end of sequence flow not found"},
    {"TwoDocuments", "bodies: []\n---\nbodies: []\n",
     "s.yaml:2:1: a scene file must be one YAML document"},
    {"NoBodies", "world: a", "s.yaml:1:1: a scene needs the key 'bodies'"},
    {"BodiesNothing", "bodies:\n", "s.yaml:1:1: bodies must be a list, is nothing"},
    {"UnknownKey", "bodys: []\nbodies: []",
     "s.yaml:1:1: unknown key 'bodys', did you mean 'bodies'?"},
    {"UnknownKeyFarFromAll", "bodies: []\nhumidity_of_air: 1",
     "s.yaml:2:1: unknown key 'humidity_of_air'" + kKnown},
    {"MisplacedKey", "bodies: []\ngravity: [0, 0, 0]",
     "s.yaml:2:1: unknown key 'gravity' here, it belongs in simulation"},
    {"DuplicateKey", "bodies: []\nworld: a\nbodies: []",
     "s.yaml:3:1: duplicate key 'bodies', first at line 1, column 1"},
    {"KeyIsAList", "bodies: []\n? [a]\n: 1", "s.yaml:2:3: a key must be a word, is a list of 1"},
    {"MergeKey", "bodies: []\n<<: {}", "s.yaml:2:1: unknown key '<<'" + kKnown},
    {"WorldName", "world: a b\nbodies: []",
     "s.yaml:1:8: world must be 1 to 127 letters, digits, '_' or '-', is 'a b'"},
    {"OverlapWord", "allow_overlap: yes\nbodies: []",
     "s.yaml:1:16: allow_overlap must be true or false, is 'yes'"},

    // Later keys
    {"Springs", "bodies: []\nsprings: []", "s.yaml:2:1: 'springs' is not supported yet"},
    {"Profile", "bodies: []\nprofile: fast", "s.yaml:2:1: 'profile' is not supported yet"},
    {"Drag", with("inertia: {ixx: 1, iyy: 1, izz: 1}, drag: {linear: 1}"),
     "s.yaml:2:59: 'drag' is not supported yet"},
    {"StaticFriction", with("shape: {sphere: 1}, material: {static_friction: 1}"),
     "s.yaml:2:55: 'static_friction' is not supported yet"},
    {"MeshShape", of("mesh: {file: a.obj}"), "s.yaml:2:23: 'mesh' is not supported yet"},
    {"ConvexFile", of("convex: {file: a.obj}"), "s.yaml:2:32: 'file' is not supported yet"},
    {"Threads", "bodies: []\ncollision: {threads: 2}",
     "s.yaml:2:13: 'threads' is not supported yet"},
    {"LaterSearch", "bodies: []\ncollision: {impact_search: conservative}",
     "s.yaml:2:28: impact_search 'conservative' is not supported yet, known: none"},
    {"LaterIntegrator", "bodies: []\nsimulation: {integrator: exact}",
     "s.yaml:2:26: integrator 'exact' is not supported yet, known: rk4, semi_implicit_euler"},

    // Layer tables
    {"UnknownSolver", "bodies: []\ncollision: {contact_solver: sequential_impulse}",
     "s.yaml:2:29: unknown contact_solver 'sequential_impulse', did you mean "
     "'sequential_impulses'?"},
    {"FrameRate", "bodies: []\npresentation: {frame_rate: 0}",
     "s.yaml:2:28: frame_rate must be 0.001 to 1000000 Hz, is 0"},
    {"ContactStep", "bodies: []\ncollision: {contact_step: -0.1}",
     "s.yaml:2:27: contact_step must be 1e-09 to 1 s, is -0.1"},
    {"Iterations", "bodies: []\ncollision: {iterations: 2.5}",
     "s.yaml:2:25: iterations must be a whole number, is '2.5'"},
    {"HexNumber", "bodies: []\nsimulation: {step: 0x10}",
     "s.yaml:2:20: step must be a finite decimal number, is '0x10'"},
    {"GravityNaN", "bodies: []\nsimulation: {gravity: [0, 0, .nan]}",
     "s.yaml:2:30: gravity must be a finite decimal number, is '.nan'"},
    {"GravityOfTwo", "bodies: []\nsimulation: {gravity: [0, 9.81]}",
     "s.yaml:2:23: gravity must be a list of 3 numbers, is a list of 2"},
    {"GravityAbsurd", "bodies: []\nsimulation: {gravity: [0, 0, 1e13]}",
     "s.yaml:2:23: gravity must be finite and at most 1e+12 m/s²"},

    // Bodies
    {"BodyIsANumber", "bodies: [5]", "s.yaml:1:10: a body must be a table of keys, is '5'"},
    {"NameMissing", "bodies:\n  - {static: true}", "s.yaml:2:5: a body needs the key 'name'"},
    {"NameEmpty", "bodies:\n  - {name: '', static: true}",
     "s.yaml:2:12: a body's name must not be empty"},
    {"NameTwice", "bodies:\n  - {name: a, static: true}\n  - {name: a, static: true}",
     "s.yaml:3:12: duplicate body name 'a', first at s.yaml:2:5"},
    {"NoMass", "bodies:\n  - {name: a, shape: {sphere: 1}}",
     "s.yaml:2:5: a body that is not static needs density or mass"},
    {"NoShapeNoMass", "bodies:\n  - {name: a}",
     "s.yaml:2:5: a body that is not static needs a shape with a density, or mass and inertia"},
    {"MassWithoutShape", "bodies:\n  - {name: a, mass: 1}",
     "s.yaml:2:5: a body without a shape needs the key 'inertia'"},
    {"MassAndDensity", with("density: 1, shape: {sphere: 1}"),
     "s.yaml:2:24: a body must have either density or mass"},
    {"MassAndShapeDensity", with("shape: {sphere: 1, density: 2}"),
     "s.yaml:2:5: a body must have either mass or shapes with a density"},
    {"SomeDensities", "bodies:\n  - {name: a, shapes: [{sphere: 1, density: 2}, {sphere: 1}]}",
     "s.yaml:2:5: a body that is not static needs a density for each of its shapes"},
    {"MassZero", "bodies:\n  - {name: a, mass: 0, shape: {sphere: 1}}",
     "s.yaml:2:21: mass must be > 0 kg, is 0"},
    {"DensityNegative", "bodies:\n  - {name: a, density: -1, shape: {sphere: 1}}",
     "s.yaml:2:24: density must be > 0 kg/m³, is -1"},
    {"MassQuoted", "bodies:\n  - {name: a, mass: '1', shape: {sphere: 1}}",
     "s.yaml:2:21: mass must be a finite decimal number, is the quoted text '1'"},
    {"MassTooLarge", "bodies:\n  - {name: a, mass: 1e400, shape: {sphere: 1}}",
     "s.yaml:2:21: mass must be a finite decimal number, is '1e400'"},
    {"MassVanishes", "bodies:\n  - {name: a, density: 1, shape: {sphere: 1e-120}}",
     "s.yaml:2:24: mass must be > 0 kg and finite, is 0"},
    {"InertiaTriangle", with("inertia: {ixx: 1, iyy: 2, izz: 4}"),
     "s.yaml:2:33: no solid has this inertia: its principal moments are 1, 2 and 4 kg·m²; the "
     "greatest must not exceed the sum of the other two"},
    {"InertiaIndefinite", with("inertia: {ixx: 1, iyy: 1, izz: 1, ixy: 2}"),
     "s.yaml:2:33: no solid has this inertia: its principal moments are -1, 1 and 3 kg·m²; all "
     "must be > 0"},
    {"InertiaIncomplete", with("inertia: {ixx: 1, iyy: 1}"),
     "s.yaml:2:33: inertia needs the key 'izz'"},
    {"InertiaWithoutMass",
     "bodies:\n  - {name: a, density: 1, inertia: {ixx: 1, iyy: 1, izz: 1}, shape: {sphere: 1}}",
     "s.yaml:2:27: inertia needs the key 'mass'"},
    {"CentreWithoutInertia", with("center_of_mass: [0, 0, 0], shape: {sphere: 1}"),
     "s.yaml:2:24: center_of_mass needs the key 'inertia'"},
    {"StaticMoves", "bodies:\n  - {name: a, static: true, linear_velocity: [1, 0, 0]}",
     "s.yaml:2:46: a static body has no linear_velocity"},
    {"Restitution", with("shape: {sphere: 1}, material: {restitution: 1.1}"),
     "s.yaml:2:68: restitution must be 0 to 1, is 1.1"},
    {"Friction", with("shape: {sphere: 1}, material: {friction: -0.1}"),
     "s.yaml:2:65: friction must be >= 0 and finite, is -0.1"},
    {"Misspelt", with("shape: {sphere: 1}, postion: [0, 0, 0]"),
     "s.yaml:2:44: unknown key 'postion', did you mean 'position'?"},

    // Orientations
    {"QuaternionAsList", with("shape: {sphere: 1}, orientation: [0, 0, 0, 1]"),
     "s.yaml:2:57: orientation must be {x, y, z, w} or {rpy: [roll, pitch, yaw]}: a bare list does "
     "not tell the order"},
    {"QuaternionZero", with("shape: {sphere: 1}, orientation: {x: 0, y: 0, z: 0, w: 0}"),
     "s.yaml:2:57: orientation must not be the zero quaternion"},
    {"QuaternionLong", with("shape: {sphere: 1}, orientation: {x: 1, y: 0, z: 0, w: 1}"),
     "s.yaml:2:57: orientation must have norm 1, has 1.41421356"},
    {"QuaternionIncomplete", with("shape: {sphere: 1}, orientation: {x: 0, y: 0, w: 1}"),
     "s.yaml:2:57: orientation needs the key 'z'"},
    {"BothOrientations", with("shape: {sphere: 1}, orientation: {rpy: [0, 0, 0], w: 1}"),
     "s.yaml:2:57: orientation must have either rpy or x, y, z, w"},

    // Shapes
    {"BoxNegative", of("box: [1, -1, 1]"),
     "s.yaml:2:28: box size y must be > 0 m and at most 1e+12 m, is -1"},
    {"BoxOfWords", of("box: [1, one, 1]"),
     "s.yaml:2:32: box must be a finite decimal number, is 'one'"},
    {"SphereInfinite", of("sphere: .inf"),
     "s.yaml:2:31: sphere must be a finite decimal number, is '.inf'"},
    {"CapsuleIncomplete", of("capsule: {radius: 1}"),
     "s.yaml:2:32: capsule needs the key 'length'"},
    {"TwoKinds", of("sphere: 1, box: [1, 1, 1]"),
     "s.yaml:2:22: a shape must have exactly one of sphere, box, capsule, cylinder, cone, "
     "ellipsoid, convex, half_space"},
    {"NoKind", of("position: [0, 0, 0]"),
     "s.yaml:2:22: a shape must have exactly one of sphere, box, capsule, cylinder, cone, "
     "ellipsoid, convex, half_space"},
    {"KindMisspelt", of("spheer: 1"), "s.yaml:2:23: unknown key 'spheer', did you mean 'sphere'?"},
    {"ShapeAndShapes", with("shape: {sphere: 1}, shapes: [{sphere: 1}]"),
     "s.yaml:2:44: a body must have either shape or shapes"},
    {"ShapesEmpty", with("shapes: []"), "s.yaml:2:32: shapes must not be empty"},
    {"ConvexFlat", of("convex: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]}"),
     "s.yaml:2:40: a convex shape's points must not lie in a plane"},
    {"ConvexPointOfTwo", of("convex: {points: [[0, 0], [1, 0, 0]]}"),
     "s.yaml:2:41: a point must be a list of 3 numbers, is a list of 2"},
    {"HalfSpaceMoves", of("half_space: {normal: [0, 0, 1]}"),
     "s.yaml:2:35: only a static body may have a half_space"},
    {"HalfSpaceNormal", of("half_space: {normal: [0, 0, 0]}"),
     "s.yaml:2:44: normal must not be zero"},
};

INSTANTIATE_TEST_SUITE_P(Corpus, MalformedScene, testing::ValuesIn(kMalformed),
                         [](const auto& one) { return one.param.name; });

TEST(SceneFaults, ComeAllAtOnceInFileOrder) {
  EXPECT_EQ(refusal(R"(simulation: {integrator: rk5}
bodies:
  - name: a
    shape: {box: [1, 1, -1]}
    density: 1
    postion: [0, 0, 0]
  - name: a
    mass: -2
    shape: {capsule: {radius: 1, lenght: 2}}
    orientation: {x: 0, y: 0, z: 0, w: 0}
springs: []
)"),
            "s.yaml:1:26: unknown integrator 'rk5', did you mean 'rk4'?\n"
            "s.yaml:4:18: box size z must be > 0 m and at most 1e+12 m, is -1\n"
            "s.yaml:6:5: unknown key 'postion', did you mean 'position'?\n"
            "s.yaml:7:11: duplicate body name 'a', first at s.yaml:3:5\n"
            "s.yaml:8:11: mass must be > 0 kg, is -2\n"
            "s.yaml:9:22: capsule needs the key 'length'\n"
            "s.yaml:9:34: unknown key 'lenght', did you mean 'length'?\n"
            "s.yaml:10:18: orientation must not be the zero quaternion\n"
            "s.yaml:11:1: 'springs' is not supported yet");
}

TEST(SceneFaults, OfAnAliasAreReportedOnce) {
  EXPECT_EQ(refusal("bodies:\n"
                    "  - {name: a, shape: &s {sphere: x}, density: 1}\n"
                    "  - {name: b, shape: *s, density: 1}\n"),
            "s.yaml:2:34: sphere must be a finite decimal number, is 'x'");
}

}  // namespace
}  // namespace poinsot
