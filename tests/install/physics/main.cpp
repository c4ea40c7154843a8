// A user of the physics without a bus: a ball falls for a second.

#include <cmath>
#include <cstdio>

#include "poinsot/presentation/presentation_layer.h"
#include "poinsot/scene/mass_properties.h"

int main() {
  poinsot::Scene scene;
  scene.world = "fall";
  poinsot::BodyDef ball;
  ball.name = "ball";
  ball.shapes = {{.shape = poinsot::Sphere{0.1}, .pose = {}}};
  ball.mass_properties.mass = 1;
  ball.mass_properties.J = 0.4 * 0.1 * 0.1 * poinsot::Mat3::Identity();
  ball.pose.c = {0, 0, 10};
  scene.bodies = {ball};

  poinsot::PresentationLayer layer(scene);
  for (int frame = 0; frame < 60; ++frame) layer.advance_frame();

  const double z = layer.snapshot().bodies.front().position.z();
  std::printf("z = %.6f m\n", z);
  // Runge-Kutta 4 integrates a parabola to rounding.
  return std::abs(z - (10 - 0.5 * 9.81)) < 1e-9 ? 0 : 1;
}
