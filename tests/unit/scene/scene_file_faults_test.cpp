// Malformed scenes: each gets exactly its message, at its place.

#include <chrono>
#include <sstream>
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

// A spring or a wrench on line 4 from column 5, on the bodies 'box', 'ball' and 'wall'.
const std::string kBodies =
    "bodies: [{name: box, density: 1, shape: {sphere: 1}, position: [1, 2, 3]},\n"
    "  {name: ball, density: 1, shape: {sphere: 1}}, {name: wall, static: true}]\n";
std::string spring(const std::string& keys) {
  return kBodies + "springs:\n  - {" + keys + "}\n";
}
std::string pair(const std::string& keys) {
  return kBodies + "pairs:\n  - {" + keys + "}\n";
}
std::string wrench(const std::string& keys) {
  return kBodies + "wrenches:\n  - {" + keys + "}\n";
}

const std::string kKnown =
    ", known here: world, profile, presentation, collision, simulation, allow_overlap, bodies, "
    "springs, "
    "wrenches, pairs";

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
    {"Profile", "bodies: []\nprofile: quick",
     "s.yaml:2:10: unknown profile 'quick', known: accurate, fast"},
    {"StaticFriction", with("shape: {sphere: 1}, material: {static_friction: 1}"),
     "s.yaml:2:55: 'static_friction' is not supported yet"},
    {"ConvexFile", of("convex: {file: a.obj}"), "s.yaml:2:32: 'file' is not supported yet"},

    // Layer tables
    {"UnknownSearch", "bodies: []\ncollision: {impact_search: backtrack}",
     "s.yaml:2:28: unknown impact_search 'backtrack', did you mean 'backtracking'?"},
    {"Threads", "bodies: []\ncollision: {threads: 0}",
     "s.yaml:2:22: threads must be 1 to 256, is 0"},
    {"ThreadsInPart", "bodies: []\ncollision: {threads: 1.5}",
     "s.yaml:2:22: threads must be a whole number, is '1.5'"},
    {"MaxImpacts", "bodies: []\ncollision: {max_impacts: -1}",
     "s.yaml:2:26: max_impacts must be 0 to 1000000, is -1"},
    {"ContactBand", "bodies: []\ncollision: {contact_band: 0.01}",
     "s.yaml:2:27: contact_band must be 1e-13 to 0.001, is 0.01"},
    {"SleepAcceleration", "bodies: []\ncollision: {sleep_acceleration: -1}",
     "s.yaml:2:33: sleep_acceleration must be >= 0 m/s² and finite, is -1"},
    {"Sleeping", "bodies: []\ncollision: {sleeping: 1}",
     "s.yaml:2:23: sleeping must be true or false, is '1'"},
    {"UnknownIntegrator", "bodies: []\nsimulation: {integrator: simpson}",
     "s.yaml:2:26: unknown integrator 'simpson', known: exact, taylor, dop853, dopri5, rk4, "
     "semi_implicit_euler, explicit_euler"},
    {"Tolerance", "bodies: []\nsimulation: {tolerance: 0.5}",
     "s.yaml:2:25: tolerance must be 0 (the integrator's own) or 1e-15 to 0.1, is 0.5"},
    {"ToleranceNegative", "bodies: []\nsimulation: {tolerance: -1e-9}",
     "s.yaml:2:25: tolerance must be 0 (the integrator's own) or 1e-15 to 0.1, is -1e-09"},
    {"ToleranceMisplaced", "bodies: []\ncollision: {tolerance: 1e-9}",
     "s.yaml:2:13: unknown key 'tolerance' here, it belongs in simulation"},
    {"UnknownSolver", "bodies: []\ncollision: {contact_solver: soft_steps}",
     "s.yaml:2:29: unknown contact_solver 'soft_steps', did you mean 'soft_step'?"},
    {"FrameRate", "bodies: []\npresentation: {frame_rate: 0}",
     "s.yaml:2:28: frame_rate must be 0.001 to 1000000 Hz, is 0"},
    {"ContactStep", "bodies: []\ncollision: {contact_step: -0.1}",
     "s.yaml:2:27: contact_step must be 1e-09 to 1 s, is -0.1"},
    {"ContactTolerance", "bodies: []\ncollision: {contact_tolerance: 0}",
     "s.yaml:2:32: contact_tolerance must be > 0 and < 1, is 0"},
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
     "s.yaml:2:5: a body that is neither static nor kinematic needs density or mass"},
    {"NoShapeNoMass", "bodies:\n  - {name: a}",
     "s.yaml:2:5: a body that is neither static nor kinematic needs a shape with a density, or "
     "mass and inertia"},
    {"MassWithoutShape", "bodies:\n  - {name: a, mass: 1}",
     "s.yaml:2:5: a body without a shape needs the key 'inertia'"},
    {"MassAndDensity", with("density: 1, shape: {sphere: 1}"),
     "s.yaml:2:24: a body must have either density or mass"},
    {"MassAndShapeDensity", with("shape: {sphere: 1, density: 2}"),
     "s.yaml:2:5: a body must have either mass or shapes with a density"},
    {"SomeDensities", "bodies:\n  - {name: a, shapes: [{sphere: 1, density: 2}, {sphere: 1}]}",
     "s.yaml:2:5: a body that is neither static nor kinematic needs a density for each of its "
     "shapes"},
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

    // Drag
    {"DragNegative", with("shape: {sphere: 1}, drag: {linear: -1}"),
     "s.yaml:2:59: linear drag must be 0 to 1e+12 N·s/m, is -1"},
    {"DragAbsurd", with("shape: {sphere: 1}, drag: {quadratic: 1e13}"),
     "s.yaml:2:62: quadratic drag must be 0 to 1e+12 N·s²/m², is 1e+13"},
    {"DragNotANumber", with("shape: {sphere: 1}, drag: {angular: much}"),
     "s.yaml:2:60: angular must be a finite decimal number, is 'much'"},
    {"DragOfNoTable", with("shape: {sphere: 1}, drag: 1"),
     "s.yaml:2:50: drag must be a table of keys, is '1'"},
    {"DragMisspelt", with("shape: {sphere: 1}, drag: {lineer: 1}"),
     "s.yaml:2:51: unknown key 'lineer', did you mean 'linear'?"},
    {"DragOutsideItsTable", with("shape: {sphere: 1}, quadratic: 1"),
     "s.yaml:2:44: unknown key 'quadratic' here, it belongs in drag"},
    {"DragOfAStaticBody", "bodies:\n  - {name: a, static: true, drag: {angular: 1}}",
     "s.yaml:2:35: a static body has no drag"},

    // Springs
    {"SpringsNoList", "bodies: []\nsprings: {a: box}",
     "s.yaml:2:10: springs must be a list, is a table"},
    {"SpringIsAWord", kBodies + "springs: [box]",
     "s.yaml:3:11: a spring must be a table of keys, is 'box'"},
    {"SpringWithoutA", spring("stiffness: 1"), "s.yaml:4:5: a spring needs the key 'a'"},
    {"SpringAEmpty", spring("a: '', stiffness: 1"), "s.yaml:4:9: a must not be empty"},
    {"SpringAUnknown", spring("a: bal, stiffness: 1"),
     "s.yaml:4:9: no body 'bal', did you mean 'ball'?"},
    {"SpringBUnknown", spring("a: box, b: bal, stiffness: 1"),
     "s.yaml:4:17: no body 'bal', did you mean 'ball'?"},
    {"SpringWithBothEndsOnOneBody", spring("a: box, b: box, stiffness: 1"),
     "s.yaml:4:17: a spring must have its ends on two bodies, both are on 'box'"},
    {"SpringBetweenStatics", spring("a: wall, stiffness: 1"),
     "s.yaml:4:5: a spring needs an end on a body that moves"},
    {"SpringOfNothing", spring("a: box, rest_length: 1"),
     "s.yaml:4:5: a spring needs a stiffness or a damping > 0"},
    {"SpringStiffness", spring("a: box, stiffness: -1"),
     "s.yaml:4:25: stiffness must be 0 to 1e+12 N/m, is -1"},
    {"SpringDamping", spring("a: box, stiffness: 1, damping: 1e13"),
     "s.yaml:4:37: damping must be 0 to 1e+12 N·s/m, is 1e+13"},
    {"SpringRestLength", spring("a: box, stiffness: 1, rest_length: -0.1"),
     "s.yaml:4:41: rest_length must be 0 to 1e+12 m, is -0.1"},
    {"SpringPoint", spring("a: box, point_a: [1e10, 0, 0], stiffness: 1"),
     "s.yaml:4:23: point_a must be finite and at most 1e+09 m"},
    {"SpringPointOfTwo", spring("a: box, point_b: [1, 2], stiffness: 1"),
     "s.yaml:4:23: point_b must be a list of 3 numbers, is a list of 2"},
    {"SpringMisspelt", spring("a: box, stifness: 1"),
     "s.yaml:4:14: unknown key 'stifness', did you mean 'stiffness'?"},
    {"SpringEndsCoincide", spring("a: box, point_b: [1, 2, 3], stiffness: 1, damping: 1"),
     "s.yaml:4:5: the ends of a spring with a rest_length or a damping must not coincide at time "
     "0: the direction of its force would be undefined"},
    {"SpringEndsCoincideAtRest", spring("a: box, point_b: [1, 2, 3], stiffness: 1, rest_length: 2"),
     "s.yaml:4:5: the ends of a spring with a rest_length or a damping must not coincide at time "
     "0: the direction of its force would be undefined"},
    {"SpringUnreadableIsNotMissing", spring("a: box, stiffness: stiff"),
     "s.yaml:4:25: stiffness must be a finite decimal number, is 'stiff'"},
    {"SpringOfABodyWithoutAName",
     "bodies: [{nmae: box, density: 1, shape: {sphere: 1}}]\nsprings: [{a: box, stiffness: 1}]",
     "s.yaml:1:10: a body needs the key 'name'\n"
     "s.yaml:1:11: unknown key 'nmae', did you mean 'name'?"},

    // Wrenches
    {"WrenchesNoList", "bodies: []\nwrenches: 1", "s.yaml:2:11: wrenches must be a list, is '1'"},
    {"WrenchWithoutBody", wrench("force: [1, 0, 0]"), "s.yaml:4:5: a wrench needs the key 'body'"},
    {"WrenchOfNothing", wrench("body: box"),
     "s.yaml:4:5: a wrench needs the key 'force' or 'torque'"},
    {"WrenchOnNobody", wrench("body: bok, torque: [1, 0, 0]"),
     "s.yaml:4:12: no body 'bok', did you mean 'box'?"},
    {"WrenchOnAStaticBody", wrench("body: wall, force: [1, 0, 0]"),
     "s.yaml:4:12: a wrench acts on a body that forces move, 'wall' is static"},
    {"WrenchForce", wrench("body: box, force: [0, 2e12, 0]"),
     "s.yaml:4:24: force must be finite and at most 1e+12 N"},
    {"WrenchTorque", wrench("body: box, torque: [0, 0, -2e12]"),
     "s.yaml:4:25: torque must be finite and at most 1e+12 N·m"},
    {"WrenchFrame", wrench("body: box, force: [1, 0, 0], frame: bod"),
     "s.yaml:4:42: unknown frame 'bod', did you mean 'body'?"},
    {"WrenchPointFrame", wrench("body: box, force: [1, 0, 0], point: [1, 0, 0], point_frame: com"),
     "s.yaml:4:66: unknown point_frame 'com', known: center_of_mass, world, body"},
    {"WrenchPointAtTheCentre",
     wrench("body: box, force: [1, 0, 0], point: [1, 0, 0], point_frame: center_of_mass"),
     "s.yaml:4:35: a point has the point_frame world or body"},
    {"WrenchPointFrameAlone", wrench("body: box, force: [1, 0, 0], point_frame: world"),
     "s.yaml:4:35: point_frame needs the key 'point'"},
    {"WrenchPoint", wrench("body: box, force: [1, 0, 0], point: [0, 0, 2e9]"),
     "s.yaml:4:42: point must be finite and at most 1e+09 m"},
    {"WrenchWorldPointLater",
     wrench("body: box, force: [1, 0, 0], point: [1, 0, 0], point_frame: world, start: 1"),
     "s.yaml:4:66: a point in the world becomes fixed to the body at time 0: with a start > 0 it "
     "must be given in the body"},
    {"WrenchStart", wrench("body: box, force: [1, 0, 0], start: -1"),
     "s.yaml:4:42: start must be 0 to 1e+09 s, is -1"},
    {"WrenchDuration", wrench("body: box, force: [1, 0, 0], duration: 0"),
     "s.yaml:4:45: duration must be > 0 s and at most 1e+09 s, is 0"},
    {"WrenchDurationAbsurd", wrench("body: box, force: [1, 0, 0], duration: 2e9"),
     "s.yaml:4:45: duration must be > 0 s and at most 1e+09 s, is 2e+09"},
    {"WrenchWithAWordOfThePush", wrench("body: box, force: [1, 0, 0], for: 1"),
     "s.yaml:4:35: unknown key 'for', did you mean 'force'?"},

    // Pairs
    {"PairsNoList", "bodies: []\npairs: 1", "s.yaml:2:8: pairs must be a list, is '1'"},
    {"PairOfOne", pair("a: box, collide: false"), "s.yaml:4:5: a pair needs the key 'b'"},
    {"PairOfNothing", pair("a: box, b: ball"),
     "s.yaml:4:5: a pair needs the key 'friction', 'restitution' or 'collide'"},
    {"PairWithNobody", pair("a: bok, b: ball, friction: 1"),
     "s.yaml:4:9: no body 'bok', did you mean 'box'?"},
    {"PairWithItself", pair("a: box, b: box, friction: 1"),
     "s.yaml:4:17: a pair must name two bodies, both are 'box'"},
    {"PairTwice", pair("a: box, b: ball, friction: 1}\n  - {b: box, a: ball, collide: false"),
     "s.yaml:5:5: duplicate pair of 'ball' and 'box', first at s.yaml:4:5"},
    {"PairFriction", pair("a: box, b: ball, friction: -1"),
     "s.yaml:4:33: friction must be >= 0 and finite, is -1"},
    {"PairRestitution", pair("a: box, b: ball, restitution: 2"),
     "s.yaml:4:36: restitution must be 0 to 1, is 2"},
    {"PairCollideWord", pair("a: box, b: ball, collide: no"),
     "s.yaml:4:32: collide must be true or false, is 'no'"},
    {"PairApartWithFriction", pair("a: box, b: ball, friction: 1, collide: false"),
     "s.yaml:4:45: a pair that does not collide has no friction and no restitution"},
    {"PairMisspelt", pair("a: box, b: ball, colide: false"),
     "s.yaml:4:23: unknown key 'colide', did you mean 'collide'?"},

    // Kinematic bodies
    {"KinematicWord", with("shape: {sphere: 1}, kinematic: 1"),
     "s.yaml:2:55: kinematic must be true or false, is '1'"},
    {"KinematicAndStatic", with("static: true, kinematic: true"),
     "s.yaml:2:49: a body must be either static or kinematic"},
    {"KinematicDrag", with("kinematic: true, drag: {linear: 1}"),
     "s.yaml:2:47: a kinematic body has no drag"},

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
     "ellipsoid, convex, half_space, mesh"},
    {"NoKind", of("position: [0, 0, 0]"),
     "s.yaml:2:22: a shape must have exactly one of sphere, box, capsule, cylinder, cone, "
     "ellipsoid, convex, half_space, mesh"},
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
profile: quick
)"),
            "s.yaml:1:26: unknown integrator 'rk5', did you mean 'rk4'?\n"
            "s.yaml:4:18: box size z must be > 0 m and at most 1e+12 m, is -1\n"
            "s.yaml:6:5: unknown key 'postion', did you mean 'position'?\n"
            "s.yaml:7:11: duplicate body name 'a', first at s.yaml:3:5\n"
            "s.yaml:8:11: mass must be > 0 kg, is -2\n"
            "s.yaml:9:22: capsule needs the key 'length'\n"
            "s.yaml:9:34: unknown key 'lenght', did you mean 'length'?\n"
            "s.yaml:10:18: orientation must not be the zero quaternion\n"
            "s.yaml:11:10: unknown profile 'quick', known: accurate, fast");
}

TEST(SceneFaults, OfAnAliasAreReportedOnce) {
  EXPECT_EQ(refusal("bodies:\n"
                    "  - {name: a, shape: &s {sphere: x}, density: 1}\n"
                    "  - {name: b, shape: *s, density: 1}\n"),
            "s.yaml:2:34: sphere must be a finite decimal number, is 'x'");
}

TEST(SceneFaults, OfSpringsAndWrenchesComeWithTheOthers) {
  EXPECT_EQ(refusal(R"(simulation: {tolerance: 1}
bodies:
  - {name: a, shape: {sphere: 1}, density: 1, drag: {linear: -1}}
springs:
  - {a: a, point_b: [0, 0, 2], stiffness: -1}
  - {a: a, b: c, stiffness: 1, damping: -1}
wrenches:
  - {body: b, force: [0, 0, 1], start: -1}
)"),
            "s.yaml:1:25: tolerance must be 0 (the integrator's own) or 1e-15 to 0.1, is 1\n"
            "s.yaml:3:62: linear drag must be 0 to 1e+12 N·s/m, is -1\n"
            "s.yaml:5:43: stiffness must be 0 to 1e+12 N/m, is -1\n"
            "s.yaml:6:15: no body 'c'\n"
            "s.yaml:6:41: damping must be 0 to 1e+12 N·s/m, is -1\n"
            "s.yaml:8:12: no body 'b'\n"
            "s.yaml:8:40: start must be 0 to 1e+09 s, is -1");
}

// Hostile files -----------------------------------------------------------------------------------

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(SceneFaults, BeyondAThousandAreCounted) {
  std::string text = "bodies: []\n";
  for (int i = 0; i < 1234; ++i) text += "key_" + std::to_string(i) + ": 1\n";
  const auto lines = lines_of(refusal(text));
  ASSERT_EQ(lines.size(), 1001u);
  EXPECT_EQ(lines[0], "s.yaml:2:1: unknown key 'key_0'" + kKnown);
  EXPECT_EQ(lines[1000], "s.yaml: and 234 more faults");
}

// A few kilobytes that stand for millions of faults; reading them all would take minutes.
TEST(SceneFaults, MultipliedByAliasesEndTheReading) {
  std::string text = "bodies:\n  - &a {";
  for (int i = 0; i < 3000; ++i) text += "key_" + std::to_string(i) + ": 1, ";
  text += "}\n";
  for (int i = 0; i < 3000; ++i) text += "  - *a\n";
  const auto start = std::chrono::steady_clock::now();
  const auto lines = lines_of(refusal(text));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  ASSERT_EQ(lines.size(), 1002u);
  EXPECT_EQ(lines[1001], "s.yaml: too many faults, the rest is not looked at");
}

}  // namespace
}  // namespace poinsot
