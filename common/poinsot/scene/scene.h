// A scene: everything a run needs, as plain data. Read from YAML by scene_file.h or built in code;
// validate() holds for both. SI units; W is the inertial frame, B a body's own.

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "poinsot/math/pose.h"
#include "poinsot/scene/mass_properties.h"
#include "poinsot/scene/shape.h"
#include "poinsot/scene/strategies.h"

namespace poinsot {

struct Material {
  double friction = 0.5;     // [-] Coulomb coefficient
  double restitution = 0.0;  // [-] Newton coefficient, 0 … 1
};

// Resistance of a medium at rest in W: F = −(linear + quadratic |v|) v at the centre of mass,
// τ = −angular ω.
struct DragDef {
  double linear = 0;     // [N·s/m]
  double quadratic = 0;  // [N·s²/m²]
  double angular = 0;    // [N·m·s/rad]
};

struct ShapeDef {
  Shape shape;
  Pose pose;  // of the shape's frame in B
};

struct BodyDef {
  std::string name;                      // unique in the scene
  bool is_static = false;                // never moves; needs no mass
  bool is_kinematic = false;             // moves with its velocities for ever; needs no mass
  std::vector<ShapeDef> shapes;          // may be empty: a body that touches nothing
  MassProperties mass_properties;        // in B; all zero for a static body
  Pose pose;                             // of B in W at time 0
  Vec3 linear_velocity = Vec3::Zero();   // [m/s] of the centre of mass, in W
  Vec3 angular_velocity = Vec3::Zero();  // [rad/s] in W
  Material material;
  DragDef drag;
  std::string where;  // "file:line:col" of its definition, for messages; empty if built in code

  // Bodies come and go in a run. A place that nobody has is absent: no name, no shape, static; its
  // slot is taken again with the next generation.
  bool absent = false;
  std::uint32_t generation = 1;  // of its BodyId; the slot is its place in the scene
};

// A spring and damper in parallel between a point of body `a` and a point of body `b`, or of W:
//   F = (stiffness (d − rest_length) + damping d′) along the line from one point to the other.
struct SpringDef {
  std::string a;                      // body
  std::string b;                      // body; empty: the world
  Vec3 point_a = Vec3::Zero();        // [m] in B of a, from its origin
  Vec3 point_b = Vec3::Zero();        // [m] in B of b, from its origin; in W if b is empty
  double stiffness = 0;               // [N/m]
  double damping = 0;                 // [N·s/m]
  std::optional<double> rest_length;  // [m]; without it the distance at time 0
  std::string where;                  // as BodyDef::where
};

enum class Axes : std::uint8_t { world = 0, body = 1 };
inline constexpr std::array<Named<Axes>, 2> kAxesNames = {{
    {"world", Axes::world},
    {"body", Axes::body},
}};

// Where a force acts: at the centre of mass, or at a point given in W or in B (from B's origin).
enum class PointFrame : std::uint8_t { center_of_mass = 0, world = 1, body = 2 };
inline constexpr std::array<Named<PointFrame>, 3> kPointFrameNames = {{
    {"center_of_mass", PointFrame::center_of_mass},
    {"world", PointFrame::world},
    {"body", PointFrame::body},
}};

// A force and a torque on one body from `start` on, for `duration`: what a client could also send.
// Times are rounded up to frames. No client can clear it.
struct WrenchDef {
  std::string body;
  Vec3 force = Vec3::Zero();   // [N]
  Vec3 torque = Vec3::Zero();  // [N·m] a free couple
  Axes axes = Axes::world;     // of force and torque
  Vec3 point = Vec3::Zero();   // [m] in the frame of point_frame; fixed to the body at time 0
  PointFrame point_frame = PointFrame::center_of_mass;
  double start = 0;                // [s]; 0 if the point is given in W
  std::optional<double> duration;  // [s]; without it for ever
  std::string where;               // as BodyDef::where
};

// What a pair of bodies does that its materials do not say.
struct PairDef {
  std::string a, b;                   // bodies
  std::optional<double> friction;     // [-]
  std::optional<double> restitution;  // [-]
  bool collide = true;                // false: they pass through each other
  std::string where;                  // as BodyDef::where
};

struct SimulationDef {
  IntegratorKind integrator = IntegratorKind::exact;
  double step = 0;                   // [s] of the fixed methods; 0: one step per contact step
  double tolerance = 0;              // [-] local error of the adaptive ones, relative to each
                                     // quantity's scale; 0: 1e-8, and rounding for taylor
  Vec3 gravity = Vec3(0, 0, -9.81);  // [m/s²] in W
};

struct CollisionDef {
  ImpactSearchKind impact_search = ImpactSearchKind::conservative;
  ContactSolverKind contact_solver = ContactSolverKind::automatic;
  double contact_step = 1.0 / 240;  // [s] longest sub-step of a frame
  double contact_tolerance = 1e-7;  // [-] error of positions at contacts that `auto` allows,
                                    // relative to the smaller body's size
  double contact_margin = 0.02;     // [-] gap below which a point is kept in the manifold, relative
                                    // to the smaller body's size
  double push_out_speed = 1.0;      // [m/s] upper bound of the removal of penetration
  double contact_band = 1e-10;      // [-] gap below which a pair touches, relative likewise
  int max_impacts = 32;             // located per frame and island; more are left to the sub-steps.
                                    // A bouncing ball comes to rest in one frame with 24.
  bool sleeping = true;             // islands in proven equilibrium cost nothing
  double sleep_acceleration = 1e-6;  // [m/s²] residual below which an equilibrium is one
  int threads = 1;                   // that islands are spread over; the bits do not depend on it

  // Not keys of the scene file: nothing in a scene needs them otherwise.
  double allowed_penetration = 1e-9;  // [-] that is left alone, relative to the smaller body's size
  double push_out_rate = 2;           // [1/s] at which a penetration decays; much faster would lift
                                      // one side of a stack before the solver has the other
  double touch_gap = 1e-3;            // [-] below it an arriving pair bounces, relative likewise
  double overlap = 1e-6;              // [-] more is refused at load, relative likewise
};

// The defaults of a profile: `accurate` are those above; `fast` allows contacts errors of a
// thousandth of a body's size, so that most islands are stepped by soft_step.
CollisionDef collision_defaults(Profile profile);

struct PresentationDef {
  double frame_rate = 60;  // [Hz]
};

struct Scene {
  std::string world;  // name on the bus: letters, digits, '_', '-'
  PresentationDef presentation;
  CollisionDef collision;
  SimulationDef simulation;
  bool allow_overlap = false;  // bodies may overlap at time 0; they are pushed out at bounded speed
  std::vector<BodyDef> bodies;
  std::vector<SpringDef> springs;
  std::vector<WrenchDef> wrenches;
  std::vector<PairDef> pairs;
};

// One fault of a scene. `where` may be empty when the scene was built in code.
struct SceneFault {
  std::string where;  // "file:line:col"
  std::string what;   // complete sentence fragment, with the offending value and its unit
  std::string path;   // of the value in the scene, "bodies[2].material.friction"
};

// All faults that need no geometry query: sizes, masses, inertias, quaternions, names, ranges,
// strategies. Empty means valid.
std::vector<SceneFault> validate(const Scene& scene);

// What is wrong with one shape, or nothing: "box: size y must be > 0 m, is -1".
std::string shape_fault(const Shape& shape);

// Joins faults into one Error, a line each: "where: what", or "path: what" without a where.
[[noreturn]] void throw_faults(const std::vector<SceneFault>& faults);

}  // namespace poinsot
