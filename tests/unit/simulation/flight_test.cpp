#include "poinsot/simulation/flight.h"

#include <cstring>

#include <gtest/gtest.h>

#include "poinsot/math/rotation.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/closed_forms.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

bool same_bits(const StateArray& a, const StateArray& b, Eigen::Index first, Eigen::Index rows) {
  return std::memcmp(a.col(0).data() + first, b.col(0).data() + first,
                     static_cast<std::size_t>(rows) * sizeof(double)) == 0;
}

// Bit for bit, but for the sign of the quaternion, which depends on the frame before.
void expect_same(const StateArray& a, const StateArray& b) {
  EXPECT_TRUE(same_bits(a, b, 0, 3));
  EXPECT_TRUE(same_bits(a, b, 7, 6));
  StateArray turned = b;
  orientation(turned, 0).coeffs() *= -1;
  EXPECT_TRUE(same_bits(a, b, 3, 4) || same_bits(a, turned, 3, 4));
}

Scene tumbling_scene() {
  return test::scene({test::tumbler()});
}

TEST(Flight, FollowsTheParabolaAndTheRotationWithinItsBound) {
  const World world(tumbling_scene());
  test::ExtendedReference reference = test::reference_of(world);
  const Flight flight(world, 0);
  StateArray y = world.y;
  for (const double t : {0.1, 1.0, 7.0, 20.0}) {
    flight.evaluate(world, 0, t, y);
    reference.advance_to(t);
    const LocalError bound = flight.error(world, t);
    EXPECT_LE(reference.position_error(position(y, 0)), bound.position);
    EXPECT_LE(reference.orientation_error(Quat(orientation(y, 0))), bound.orientation);
    EXPECT_LE((momentum(y, 0) - reference.momentum()).norm(), 4e-16 * reference.momentum().norm());
    EXPECT_EQ(angular_momentum(y, 0), angular_momentum(world.y, 0));
  }
  EXPECT_LE(flight.error(world, 20).position, 4e-15 * 2000);  // ½ g t² is 1962 m
  EXPECT_LE(flight.error(world, 20).orientation, 1e-14);
}

// Binary fractions: nothing to round.
TEST(Flight, IsExactWhereTheParabolaIsRepresentable) {
  Scene scene = tumbling_scene();
  scene.simulation.gravity = {0.5, 0, -8};
  scene.bodies[0].pose.c = {1, 2, 3};
  scene.bodies[0].linear_velocity = {4, -2, 0.25};
  const World world(scene);
  StateArray y = world.y;
  Flight(world, 0).evaluate(world, 0, 3.5, y);
  EXPECT_EQ(position(y, 0), test::ballistic({1, 2, 3}, {4, -2, 0.25}, {0.5, 0, -8}, 3.5));
  EXPECT_EQ(momentum(y, 0), 2 * Vec3(4 + 1.75, -2, 0.25 - 28));
}

TEST(Flight, KeepsTheSignOfTheQuaternion) {
  const World world(tumbling_scene());
  const Flight flight(world, 0);
  StateArray y = world.y;
  for (int n = 1; n <= 3000; ++n) {
    const Quat before = orientation(y, 0);
    flight.evaluate(world, 0, n / 60.0, y);
    ASSERT_GT(before.dot(Quat(orientation(y, 0))), 0.99) << n;  // 4 rad/s: half an angle of 0.03
  }
}

TEST(Flight, IsNotRenewedByFrames) {
  SimulationLayer often(tumbling_scene()), once(tumbling_scene());
  for (int n = 1; n <= 1000; ++n) often.advance_to(n / 60.0);
  once.advance_to(1000 / 60.0);
  expect_same(often.world().y, once.world().y);
  EXPECT_EQ(often.local_error().orientation, once.local_error().orientation);
}

// From where the last push ended, and not from earlier.
void expect_new_flight(SimulationLayer& layer) {
  World here = layer.world();
  const Flight flight(here, 0);
  layer.advance_to(layer.world().time + 1);
  layer.advance_to(layer.world().time + 1);
  StateArray y = here.y;
  flight.evaluate(here, 0, layer.world().time, y);
  expect_same(layer.world().y, y);
  EXPECT_EQ(layer.methods()[0], Method::flight);
}

TEST(Flight, BeginsAnewAfterAnImpulse) {
  SimulationLayer layer(tumbling_scene());
  layer.advance_to(0.7);
  momentum(layer.world().y, 0) += Vec3(1, 2, 3);
  angular_momentum(layer.world().y, 0) += Vec3(-1, 0.5, 3);
  expect_new_flight(layer);
}

TEST(Flight, BeginsAnewAfterAHeldWrench) {
  SimulationLayer layer(tumbling_scene());
  layer.advance_to(0.7);
  layer.world().held[0].in_W.torque = {0.1, 0.2, 0.3};
  layer.advance_to(1.1);
  EXPECT_EQ(layer.methods()[0], Method::taylor);
  layer.world().held[0] = {};
  expect_new_flight(layer);
}

TEST(Flight, BeginsAnewAfterAContact) {
  SimulationLayer layer(tumbling_scene());
  layer.advance_to(0.7);
  layer.contact_wrenches()[0] = {{0, 0, 30}, {0.1, 0, 0}};
  layer.advance_to(0.8);
  EXPECT_EQ(layer.methods()[0], Method::taylor);
  expect_new_flight(layer);
}

// The least change of any row is a cause.
TEST(Flight, BeginsAnewAfterTheLeastTouch) {
  for (const Eigen::Index row : {0, 3, 7, 10}) {
    SimulationLayer layer(tumbling_scene());
    layer.advance_to(0.7);
    double& value = layer.world().y(row, 0);
    value = std::nextafter(value, 10.0);
    expect_new_flight(layer);
  }
}

TEST(Flight, HashesWhereAndWhenItBegan) {
  const auto hash_of = [](double speed, double start) {
    Scene scene = tumbling_scene();
    scene.bodies[0].linear_velocity.x() = speed;
    World world(scene);
    world.time = start;
    Hash64 hash;
    Flight(world, 0).hash_into(hash);
    return hash.value();
  };
  EXPECT_EQ(hash_of(1, 0), hash_of(1, 0));
  EXPECT_NE(hash_of(1, 0), hash_of(2, 0));
  EXPECT_NE(hash_of(1, 0), hash_of(1, 1));
}

}  // namespace
}  // namespace poinsot
