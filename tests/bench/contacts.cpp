// bench_contacts: the contact scenes in the collision layer, without sleeping.
//
// Options beside those of contact_measure.h, all of the scene: --profile NAME, --solver NAME,
// --step S [s] of contact, --threads N, --sleeping. What is not given is the
// scene's default; with none of them the defaults come first, then every solver at several steps.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact_measure.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/scene/scene_file.h"
#include "support/scene_builder.h"

namespace poinsot::bench {
namespace {

struct Choice {
  std::string profile, solver, name;
  std::optional<double> step;  // [s]
  int threads = 1;
  bool sleeping = false;
};

ContactSolverKind solver_of(const std::string& name) {
  const auto kind = find_named<ContactSolverKind>(kContactSolverNames, name);
  if (!kind) throw std::runtime_error("no such solver: " + name);
  return *kind;
}

// A profile is what a scene file makes of it.
Scene base_scene(const Choice& choice) {
  Scene scene = test::empty_scene("contacts");
  if (!choice.profile.empty())
    scene = read_scene_text("profile: " + choice.profile + "\nbodies: []\n", "contacts");
  if (!choice.solver.empty()) scene.collision.contact_solver = solver_of(choice.solver);
  if (choice.step) scene.collision.contact_step = *choice.step;
  scene.collision.threads = choice.threads;
  scene.collision.sleeping = choice.sleeping;
  scene.simulation.gravity = {0, 0, -kGravity};
  scene.presentation.frame_rate = kFrameRate;
  return scene;
}

BodyDef body_of(const ContactBody& def, const ContactScene& scene, std::size_t number) {
  BodyDef body;
  body.name = "body_" + std::to_string(number);
  body.shapes = {{def.shape, {}}};
  body.is_static = def.mass == 0;
  body.mass_properties.mass = def.mass;
  body.mass_properties.J = def.moments.asDiagonal();
  body.pose = def.pose;
  body.linear_velocity = def.velocity;
  body.material = {scene.friction, 0};
  return body;
}

Scene scene_of(const ContactScene& c, const Choice& choice) {
  Scene scene = base_scene(choice);
  for (const ContactBody& body : c.bodies)
    scene.bodies.push_back(body_of(body, c, scene.bodies.size()));
  for (const ContactBody& wall : c.walls)
    scene.bodies.push_back(body_of(wall, c, scene.bodies.size()));
  BodyDef ground = test::ground(c.friction, 0);
  ground.pose.q = c.ground;
  scene.bodies.push_back(ground);
  return scene;
}

class Layer final : public ContactWorld {
 public:
  Layer(const ContactScene& c, const Choice& choice) : layer_(scene_of(c, choice)) {}

  void advance_to(double t) override { layer_.advance_to(t); }

  void read(std::vector<ContactState>& states) const override {
    const World& world = layer_.world();
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      states[i] = {{position(world.y, column), orientation(world.y, column)},
                   linear_velocity(world, column),
                   angular_velocity(world, column)};
    }
  }

 private:
  CollisionLayer layer_;
};

// Takes our own options out of the arguments; nothing if there is none.
std::optional<Choice> take_choice(int& argc, char** argv) {
  Choice choice;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--sleeping") {
      choice.sleeping = true;
    } else if (i + 1 < argc && name == "--profile") {
      choice.profile = argv[++i];
    } else if (i + 1 < argc && name == "--solver") {
      choice.solver = argv[++i];
    } else if (i + 1 < argc && name == "--step") {
      choice.step = std::atof(argv[++i]);
    } else if (i + 1 < argc && name == "--threads") {
      choice.threads = std::atoi(argv[++i]);
    } else {
      argv[kept++] = argv[i];
      continue;
    }
    if (!choice.name.empty()) choice.name += ' ';
    choice.name += name.substr(2);
    if (name == "--sleeping") continue;
    choice.name += ' ';
    choice.name += argv[i];
  }
  argc = kept;
  return choice.name.empty() ? std::nullopt : std::optional(choice);
}

std::vector<Choice> all_choices(const ContactCase& c) {
  std::vector<Choice> choices(1);
  choices[0].name = "default";
  for (const auto& [name, kind] : kContactSolverNames)
    for (const int per_s : {60, 240, 1020}) {
      if (c.question == Question::piles && per_s > 240) continue;
      Choice choice;
      choice.solver = name;
      choice.step = 1.0 / per_s;
      choice.name = choice.solver + " 1/" + std::to_string(per_s);
      choices.push_back(std::move(choice));
    }
  return choices;
}

int run(int argc, char** argv) {
  const std::optional<Choice> only = take_choice(argc, argv);
  const auto settings = [&only](const ContactCase& c) {
    std::vector<ContactSetting> result;
    for (const Choice& choice : only ? std::vector<Choice>{*only} : all_choices(c))
      result.push_back({choice.name, [choice](const ContactScene& scene) {
                          return std::make_unique<Layer>(scene, choice);
                        }});
    return result;
  };
  return measure_contacts("poinsot", settings, argc, argv);
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::run(argc, argv);
}
