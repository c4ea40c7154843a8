#include "poinsot/simulation/course.h"

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene one_body() {
  BodyDef def = test::box("a", Vec3(1, 2, 3), Vec3(0.4, 0.3, 0.2));
  def.linear_velocity = {1, -2, 3};
  def.angular_velocity = {3, 1, -2};
  return test::scene({def});
}

// Where a course says a body will be is where the layer takes it, to the bit.
void expect_same(const Scene& scene, const HeldWrench& held) {
  SimulationLayer ahead(scene), layer(scene);
  ahead.world().held[0] = layer.world().held[0] = held;
  SimulationWorker worker(ahead.world());
  ahead.begin(0.1);
  layer.begin(0.1);
  const Course course = ahead.course(0, 0, 0.1, false, worker);
  const double t = 0.037;
  const MovingPose expected = course.moving_at(t);
  const Eigen::Index body = 0;
  Tally tally;
  layer.advance({&body, 1}, 0, t, false, worker, tally);
  EXPECT_EQ(expected.pose.c, Vec3(position(layer.world().y, 0)));
  EXPECT_EQ(angle_between(expected.pose.q, Quat(orientation(layer.world().y, 0))), 0);
  EXPECT_NEAR((expected.velocity.linear - linear_velocity(layer.world(), 0)).norm(), 0, 1e-14);
  EXPECT_NEAR((expected.velocity.angular - angular_velocity(layer.world(), 0)).norm(), 0, 1e-14);
}

TEST(Course, OfAFlightIsWhereTheBodyWillBe) {
  expect_same(one_body(), {});
}

TEST(Course, OfADrivenBodyIsWhereItWillBe) {
  HeldWrench held;
  held.in_W = {{5, 1, 0}, {0.1, 0.2, 0}};
  held.in_B.force = {0, 3, 0};
  expect_same(one_body(), held);
  Scene scene = one_body();
  scene.simulation.integrator = IntegratorKind::rk4;
  expect_same(scene, held);
}

TEST(Course, OfADrivenBodyAcceleratesAsItsBoundsSay) {
  SimulationLayer layer(one_body());
  layer.world().held[0].in_W.force = {5, 1, 0};
  layer.world().held[0].in_B.force = {0, 3, 0};
  SimulationWorker worker(layer.world());
  layer.begin(0.1);
  const Course course = layer.course(0, 0, 0.1, false, worker);
  const Vec3 c = course.at(0).c, v = course.moving_at(0).velocity.linear;
  for (const double x : {0.01, 0.05, 0.1}) {
    const Vec3 rest = course.at(x).c - c - x * v - 0.5 * x * x * course.acceleration();
    EXPECT_LE(rest.norm(), 0.5 * x * x * course.slack() + 1e-14) << x;
    EXPECT_LE(course.moving_at(x).velocity.angular.norm(), course.rotation().omega);
  }
}

TEST(Course, OfAKinematicBodyIsEven) {
  BodyDef def = test::box("belt", Vec3(0, 0, 0));
  def.is_kinematic = true;
  def.mass_properties = {};
  def.linear_velocity = {0.5, 0, 0};
  def.angular_velocity = {0, 0, 2};
  SimulationLayer layer(test::scene({def}));
  SimulationWorker worker(layer.world());
  for (int n = 1; n <= 60; ++n) layer.advance_to(n / 60.0);
  EXPECT_NEAR(layer.world().y(0, 0), 0.5, 1e-15);
  EXPECT_NEAR(angle_between(Quat(orientation(layer.world().y, 0)), Quat::Identity()), 2, 1e-14);
  EXPECT_EQ(linear_velocity(layer.world(), 0), Vec3(0.5, 0, 0));
}

}  // namespace
}  // namespace poinsot
