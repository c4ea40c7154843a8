#include "support/checkpoint_scenes.h"

#include <limits>
#include <random>
#include <utility>

#include "poinsot/scene/scene_file.h"
#include "support/meshes.h"
#include "support/random_bodies.h"
#include "support/scene_builder.h"

namespace poinsot::test {
namespace {

using Act = std::function<void(CollisionLayer&, int)>;

Scene shipped(const std::string& name) {
  return read_scene_file(std::filesystem::path(POINSOT_SCENE_DIR) / (name + ".yaml"));
}

Scene tumbling() {
  std::mt19937_64 random(5);
  std::vector<BodyDef> bodies;
  for (int n = 0; n < 24; ++n) {
    const RandomFreeBody sample = random_free_body(random, n);
    BodyDef def;
    def.name = "body" + std::to_string(n);
    def.mass_properties = {1.0 + n, Vec3(0.1, 0, 0), sample.J};
    def.shapes = {{Sphere{0.1}, {}}};
    def.pose = {Vec3(3.0 * n, 0, 0), sample.q};
    def.angular_velocity = sample.omega;
    def.linear_velocity = Vec3(0, 0.1 * n, 1);
    bodies.push_back(def);
  }
  return scene(std::move(bodies));
}

// Two chains, a lone body on a spring to the world, and one with drag alone.
Scene springs(double stiffness, double damping, IntegratorKind integrator) {
  std::vector<BodyDef> bodies;
  Scene result;
  for (int n = 0; n < 8; ++n) {
    BodyDef def = box("box" + std::to_string(n), Vec3(1.2 * n, 0, 3), Vec3(0.5, 0.3, 0.4));
    def.angular_velocity = Vec3(1, 0.2 * n, -1);
    if (n % 2 == 1) def.drag = {0.1, 0.2, 0.05};
    bodies.push_back(def);
  }
  result = scene(std::move(bodies));
  result.simulation.integrator = integrator;
  const auto join = [&](const std::string& a, const std::string& b) {
    SpringDef spring;
    spring.a = a;
    spring.b = b;
    spring.point_a = Vec3(0.25, 0.1, 0);
    spring.point_b = b.empty() ? Vec3(7, 0, 5) : Vec3(-0.25, 0.1, 0);
    spring.stiffness = stiffness;
    spring.damping = damping;
    result.springs.push_back(spring);
  };
  join("box0", "box1");
  join("box1", "box2");
  join("box3", "box4");
  join("box5", "");
  return result;
}

Scene heap(ContactSolverKind solver, ImpactSearchKind search) {
  std::vector<BodyDef> bodies = {ground()};
  const std::vector<Shape> shapes = {Box{{0.5, 0.4, 0.3}}, Sphere{0.2},
                                     Cylinder{0.2, 0.4},   Capsule{0.15, 0.3},
                                     Cone{0.2, 0.4},       Ellipsoid{{0.2, 0.25, 0.3}}};
  for (int i = 0; i < 12; ++i) {
    BodyDef def = body("body" + std::to_string(i), shapes[static_cast<std::size_t>(i) % 6],
                       {0.55 * (i % 3), 0.55 * (i / 3 % 2), 0.4 + 0.7 * (i / 6)});
    def.pose.q = Quat(1, 0.05 * (i % 3), 0.04 * (i % 5), 0.03 * (i % 7)).normalized();
    if (i % 5 == 0) def.material.restitution = 0.5;
    bodies.push_back(def);
  }
  Scene result = scene(std::move(bodies));
  result.collision.contact_solver = solver;
  result.collision.impact_search = search;
  return result;
}

Scene columns(Profile profile) {
  std::vector<BodyDef> bodies = {ground()};
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 4; ++z)
        bodies.push_back(body("box" + std::to_string(bodies.size()), Box{{1, 1, 1}},
                              {1.5 * x + 0.01 * z, 1.5 * y - 0.01 * z, 0.6 + 1.1 * z}));
  Scene result = scene(std::move(bodies));
  result.collision = collision_defaults(profile);
  return result;
}

Scene on_mesh() {
  BodyDef land;
  land.name = "land";
  land.is_static = true;
  land.shapes = {
      {terrain(3, 6, [](double x, double y) { return 0.1 * std::sin(3 * x + y) * y; }), {}}};
  std::vector<BodyDef> bodies = {land};
  for (int n = 0; n < 8; ++n) {
    const Shape shape = n % 2 == 0 ? Shape(Box{{0.4, 0.3, 0.3}}) : Shape(Sphere{0.2});
    bodies.push_back(body("body" + std::to_string(n), shape, {-1.5 + 0.5 * n, 0.2 * n, 0.7}));
  }
  return scene(std::move(bodies));
}

// A paddle that turns and a plate that moves, both carrying and hitting boxes.
Scene kinematic(Profile profile) {
  BodyDef plate = body("plate", Box{{4, 4, 0.2}}, {0, 0, -0.1});
  plate.is_kinematic = true;
  plate.mass_properties = {};
  plate.linear_velocity = Vec3(0.3, 0, 0.1);
  BodyDef paddle = body("paddle", Box{{3, 0.2, 0.4}}, {0, 0, 0.5});
  paddle.is_kinematic = true;
  paddle.mass_properties = {};
  paddle.linear_velocity = Vec3(0.3, 0, 0.1);
  paddle.angular_velocity = Vec3(0, 0, 1.5);
  std::vector<BodyDef> bodies = {plate, paddle};
  for (int n = 0; n < 8; ++n)
    bodies.push_back(body("box" + std::to_string(n), Box{{0.3, 0.3, 0.3}},
                          {-1.4 + 0.4 * n, n % 2 == 0 ? 0.8 : -0.8, 0.2 + 0.05 * n}));
  Scene result = scene(std::move(bodies));
  result.collision = collision_defaults(profile);
  return result;
}

// Pushes that come and go, in all the parts that a held wrench has.
void push(CollisionLayer& layer, int n) {
  if (n % 20 != 0 && n % 20 != 7) return;
  HeldWrench held;
  if (n % 20 == 0) {
    held.add_force_at(Vec3(0.1, 0, 0.1), Vec3(400, 30, 50));
    held.in_B.torque = Vec3(0, 3, 0);
  }
  layer.world().held[static_cast<std::size_t>(1 + n / 20 % 4)] = held;
}

// A client drags two boxes about, one of a chain and one alone, lets go, and takes them again.
void drag(CollisionLayer& layer, int n) {
  if (n % 5 != 0) return;
  const Vec3 target(0.05 * n, 0.5, 2 + 0.02 * n);
  std::vector<Tether> tethers;
  if (n % 40 < 20) tethers.push_back({2, Vec3(0.1, 0, 0), target, 200, 20});
  if (n % 30 < 20) tethers.push_back({7, Vec3(0, 0.1, 0), target, 500, 5});
  layer.set_tethers(tethers);
}

// Bodies are thrown, and put elsewhere.
void throw_about(CollisionLayer& layer, int n) {
  if (n % 15 == 0) layer.kick(3 + n / 15 % 8, {Vec3(20, -10, 60), Vec3(1, 0, 2)});
  if (n % 40 == 10)
    layer.set_state(4, {Vec3(0, 0.5, 3), Quat::Identity()}, {Vec3(0, 0, -2), Vec3::Zero()});
}

// One body's state becomes nothing: it is frozen.
void break_one(CollisionLayer& layer, int n) {
  if (n != 30) return;
  momentum(layer.world().y, 5).setConstant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<CheckpointScene> checkpoint_scenes() {
  using Solver = ContactSolverKind;
  using Search = ImpactSearchKind;
  using Kind = IntegratorKind;
  const Scene accurate_pile = shipped("pile");
  Scene fast_pile = accurate_pile;
  fast_pile.collision = collision_defaults(Profile::fast);
  fast_pile.bodies.resize(90);
  const auto heap_by = [](Solver solver) { return heap(solver, Search::conservative); };
  const auto heap_with = [](Search search) { return heap(Solver::automatic, search); };
  return {
      {"Tumbling", tumbling(), 120, 100, {}},
      {"Racket", shipped("tennis_racket"), 100, 100, {}},
      {"Springs", springs(50, 0.5, Kind::exact), 100, 100, {}},
      {"StiffSprings", springs(1e6, 1e3, Kind::exact), 40, 40, {}},
      {"Dop853", springs(50, 0.5, Kind::dop853), 60, 100, {}},
      {"Dopri5", springs(50, 0.5, Kind::dopri5), 60, 100, {}},
      {"Rk4", springs(50, 0.5, Kind::rk4), 60, 100, {}},
      {"Balls", shipped("bouncing_balls"), 200, 100, {}},
      {"Tower", shipped("tower"), 150, 100, {}},
      {"Pile", accurate_pile, 50, 20, {}},
      {"FastPile", fast_pile, 100, 50, {}},
      {"Crowd", shipped("crowd"), 40, 20, {}},
      {"Incline", shipped("incline"), 200, 100, {}},
      {"Mesh", on_mesh(), 80, 60, {}},
      {"Kinematic", kinematic(Profile::accurate), 120, 100, {}},
      {"FastKinematic", kinematic(Profile::fast), 120, 100, {}},
      {"SoftHeap", heap_by(Solver::soft_step), 120, 100, {}},
      {"NewtonHeap", heap_by(Solver::convex_newton), 60, 30, {}},
      {"BacktrackingHeap", heap_with(Search::backtracking), 40, 20, {}},
      {"ContinuousHeap", heap_with(Search::continuous), 30, 20, {}},
      {"UnsearchedHeap", heap_with(Search::none), 80, 50, {}},
      {"PushedHeap", heap_by(Solver::automatic), 90, 50, push},
      {"DraggedSprings", springs(50, 0.5, Kind::exact), 80, 60, drag},
      {"DraggedColumns", columns(Profile::accurate), 100, 50, drag},
      {"DraggedFastColumns", columns(Profile::fast), 100, 50, drag},
      {"ThrownColumns", columns(Profile::accurate), 120, 60, throw_about},
      {"ThrownFastColumns", columns(Profile::fast), 120, 60, throw_about},
      {"BrokenHeap", heap_by(Solver::automatic), 60, 40, break_one},
      {"Columns", columns(Profile::accurate), 150, 60, push},
      {"FastColumns", columns(Profile::fast), 200, 100, push},
  };
}

}  // namespace poinsot::test
