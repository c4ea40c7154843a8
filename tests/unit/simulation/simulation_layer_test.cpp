#include "poinsot/simulation/simulation_layer.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/simulation/diagnostics.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(SimulationLayer, EndsExactlyAtTheGivenTime) {
  SimulationLayer layer(test::scene({test::body("ball", Sphere{1}, {0, 0, 9})}));
  for (int n = 1; n <= 100; ++n) {
    layer.advance_to(n / 60.0);
    ASSERT_EQ(layer.world().time, n / 60.0);
  }
}

TEST(SimulationLayer, ContactWrenchesActForOneAdvanceOnly) {
  Scene scene = test::scene({test::free_body("body", 2, {1, 1, 1})});
  scene.simulation.gravity.setZero();
  SimulationLayer layer(scene);
  layer.contact_wrenches()[0] = {{4, 0, 0}, {0, 3, 0}};
  layer.advance_to(0.5);
  EXPECT_NEAR(momentum(layer.world().y, 0).x(), 2, 1e-15);
  EXPECT_NEAR(angular_momentum(layer.world().y, 0).y(), 1.5, 1e-15);
  layer.advance_to(1.0);
  EXPECT_NEAR(momentum(layer.world().y, 0).x(), 2, 1e-15);
}

TEST(SimulationLayer, FreezesABodyWhoseStateBecomesNonFiniteAndNoOther) {
  SimulationLayer layer(test::scene(
      {test::body("bad", Sphere{1}, {0, 0, 9}), test::body("good", Sphere{1}, {5, 0, 9})}));
  layer.advance_to(0.1);
  const Eigen::Matrix<double, 13, 1> last_good = layer.world().y.col(0);
  momentum(layer.world().y, 0).x() = kNaN;
  layer.advance_to(0.2);
  EXPECT_TRUE(layer.world().y.allFinite());
  EXPECT_EQ(layer.quarantined(), 1u);
  EXPECT_EQ(layer.world().motion[0], Motion::frozen);
  EXPECT_EQ(layer.world().y.col(0).head<7>(), last_good.head<7>());
  EXPECT_TRUE(layer.world().moves(1));
  EXPECT_NEAR(momentum(layer.world().y, 1).z(), -9.81 * 0.2 * layer.world().mass[1], 1e-9);
}

TEST(SimulationLayer, FreezesABodyOfAbsurdMagnitudeBeforeItOverflows) {
  SimulationLayer layer(test::scene({test::body("bad", Sphere{1}, {0, 0, 9})}));
  momentum(layer.world().y, 0).x() = 1e200;
  layer.advance_to(0.1);
  EXPECT_EQ(layer.quarantined(), 1u);
  EXPECT_TRUE(std::isfinite(kinetic_energy(layer.world())));
}

TEST(SimulationLayer, ItsWorkIsTheChangeOfEnergy) {
  // Everything at once on a tumbling body: force in B, couples in W and B, force at a point,
  // contact. The series integrate the work as they do the motion: rounding is left.
  BodyDef body = test::free_body("body", 2, {1, 2, 2.5});
  body.linear_velocity = {1, -2, 0.5};
  body.angular_velocity = {2, 1, -1};
  SimulationLayer layer(test::scene({body}));
  HeldWrench& held = layer.world().held[0];
  held.in_B = {{1, 2, 3}, {0.3, -0.2, 0.5}};
  held.in_W.torque = {0.1, 0.4, -0.3};
  held.add_force_at({0.2, 0.1, -0.3}, {2, 0, 1});
  const double before = kinetic_energy(layer.world()) + potential_energy(layer.world());
  for (int n = 1; n <= 32; ++n) {
    layer.contact_wrenches()[0] = {{0, 1, 2}, {0.2, 0, 0.1}};
    layer.advance_to(n / 32.0);
  }
  const double after = kinetic_energy(layer.world()) + potential_energy(layer.world());
  EXPECT_NEAR(after - before, layer.work(), 1e-13 * std::abs(before + after));
}

// Nothing has moved, and nothing has begun to.
void expect_refused(SimulationLayer& layer, double t) {
  const StateArray y = layer.world().y;
  const double time = layer.world().time, work = layer.work();
  Hash64 before, after;
  layer.hash_into(before);
  EXPECT_THROW(layer.advance_to(t), Error);
  layer.hash_into(after);
  EXPECT_EQ(std::memcmp(layer.world().y.data(), y.data(),
                        static_cast<std::size_t>(y.size()) * sizeof(double)),
            0);
  EXPECT_EQ(layer.world().time, time);
  EXPECT_EQ(layer.work(), work);
  EXPECT_EQ(after.value(), before.value());
}

TEST(SimulationLayer, RefusesMoreFixedStepsThanCanBeTaken) {
  Scene scene = test::scene({test::body("ball", Sphere{1}, {0, 0, 9})});
  scene.simulation.integrator = IntegratorKind::rk4;
  SimulationLayer layer(scene);
  expect_refused(layer, 1e9);
  expect_refused(layer, 1e300);
  layer.advance_to(1);
}

TEST(SimulationLayer, RefusesTimesThatAreNone) {
  SimulationLayer layer(test::scene({test::body("ball", Sphere{1}, {0, 0, 9})}));
  layer.advance_to(1);
  for (const double t :
       {0.5, -1.0, std::nextafter(1.0, 0.0), kNaN, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()})
    expect_refused(layer, t);
  layer.advance_to(1);  // the present is no past
  EXPECT_EQ(layer.world().time, 1);
}

TEST(SimulationLayer, RefusesAHeldWrenchThatIsNoNumberBeforeAnythingMoves) {
  SimulationLayer layer(test::scene(
      {test::body("first", Sphere{1}, {0, 0, 9}), test::body("second", Sphere{1}, {5, 0, 9})}));
  layer.advance_to(1);
  HeldWrench& held = layer.world().held[1];
  for (double* value : {&held.in_W.force.x(), &held.in_W.torque.y(), &held.in_B.force.z(),
                        &held.in_B.torque.x(), &held.moment(1, 2)})
    for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
      *value = bad;
      expect_refused(layer, 2);
      *value = 0;
    }
  layer.advance_to(2);
  EXPECT_EQ(layer.quarantined(), 0u);
}

TEST(SimulationLayer, RefusalsSayWhatIsWrong) {
  SimulationLayer layer(test::scene({test::body("ball", Sphere{1}, {0, 0, 9})}));
  layer.advance_to(1);
  const auto text_of = [&](double t) {
    try {
      layer.advance_to(t);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(text_of(0.5).find("backwards"), std::string::npos);
  layer.world().held[0].in_W.force.x() = kNaN;
  EXPECT_NE(text_of(2).find("'ball'"), std::string::npos);
}

TEST(Energy, IsThatOfTheTextbook) {
  BodyDef body = test::free_body("body", 2, {1, 2, 2.5});
  body.pose.c = {0, 0, 3};
  body.linear_velocity = {1, 2, 2};
  body.angular_velocity = {1, 1, 2};
  const World world(test::scene({body}));
  EXPECT_NEAR(kinetic_energy(world), 0.5 * 2 * 9 + 0.5 * (1 + 2 + 10), 1e-14);
  EXPECT_NEAR(potential_energy(world), 2 * 9.81 * 3, 1e-13);
}

}  // namespace
}  // namespace poinsot
