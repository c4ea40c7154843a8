// bench_speed_against_error: the cases in the simulation layer, over all integrators and their
// steps or tolerances. Options and output: measure.h.

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "measure.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/scene_builder.h"

namespace poinsot::bench {
namespace {

Scene scene_of(const Case& c, const SimulationDef& simulation) {
  Scene scene = test::empty_scene(c.name);
  scene.simulation = simulation;
  scene.simulation.gravity = c.gravity;
  scene.presentation.frame_rate = c.frame_rate;
  for (const CaseBody& body : c.bodies) {
    BodyDef def =
        test::free_body("body_" + std::to_string(scene.bodies.size()), body.mass, body.moments);
    def.pose = body.pose;
    def.linear_velocity = body.velocity;
    def.angular_velocity = body.omega;
    def.drag.linear = c.drag;
    if (c.spring) {
      SpringDef spring;
      spring.a = def.name;
      spring.point_b = c.spring->anchor_W;
      spring.stiffness = c.spring->stiffness;
      spring.rest_length = 0;
      scene.springs.push_back(spring);
    }
    scene.bodies.push_back(std::move(def));
  }
  return scene;
}

class Layer final : public Simulation {
 public:
  Layer(const Case& c, const SimulationDef& simulation) : layer_(scene_of(c, simulation)) {
    if (!c.has_wrench()) return;
    for (HeldWrench& held : layer_.world().held) {
      held.in_W.torque = c.torque_W;
      held.in_B.force = c.force_B;
    }
  }

  void advance_to(double t) override { layer_.advance_to(t); }

  void read(std::vector<Pose>& poses) const override {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      poses[i] = {position(layer_.world().y, column), orientation(layer_.world().y, column)};
    }
  }

 private:
  SimulationLayer layer_;
};

std::vector<Setting> settings(const Case& c) {
  std::vector<Setting> result;
  const auto add = [&](std::string name, const SimulationDef& simulation) {
    result.push_back(
        {std::move(name), [&c, simulation] { return std::make_unique<Layer>(c, simulation); }});
  };
  for (const auto& [name, kind] : kIntegratorNames) {
    const std::string method(name);
    SimulationDef simulation{.integrator = kind};
    if (!is_adaptive(kind)) {
      for (const FixedStep& step : fixed_steps(c.bodies.size() == 1)) {
        simulation.step = 1 / (c.frame_rate * step.per_frame);
        add(method + " " + step.name, simulation);
      }
      continue;
    }
    add(method + " default", simulation);
    for (int digits = 4; digits <= 12; digits += 2) {
      simulation.tolerance = std::pow(10, -digits);
      add(method + " 1e-" + std::to_string(digits), simulation);
    }
  }
  return result;
}

}  // namespace
}  // namespace poinsot::bench

int main(int argc, char** argv) {
  return poinsot::bench::measure("poinsot", poinsot::bench::settings, argc, argv);
}
