#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "poinsot/simulation/diagnostics.h"
#include "poinsot/simulation/simulation_layer.h"
#include "support/allocation_counter.h"
#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

Tether tether(Eigen::Index column, const Vec3& p_B, const Vec3& target, double stiffness,
              double damping) {
  return {column, p_B, target, stiffness, damping};
}

Scene weightless(std::vector<BodyDef> bodies) {
  Scene scene = test::scene(std::move(bodies));
  scene.simulation.gravity.setZero();
  return scene;
}

BodyDef at(const std::string& name, const Vec3& c) {
  BodyDef def = test::free_body(name, 2, {1, 2, 3});
  def.pose.c = c;
  return def;
}

// Two bodies joined by a spring, one that hangs from one, and two that fly.
Scene mixed() {
  Scene scene = test::scene({at("a", {0, 0, 0}), at("b", {1, 0, 0}), at("hangs", {2, 0, 0}),
                             test::tumbler(), at("flies", {4, 0, 0})});
  scene.springs = {test::spring("a", Vec3(0.1, 0, 0), "b", Vec3(0, 0.2, 0), 30, 1, 0.5),
                   test::spring("hangs", Vec3::Zero(), "", Vec3(2, 0, 1), 40, 0, 0.2)};
  return scene;
}

void run(SimulationLayer& layer, int first, int frames) {
  for (int n = first + 1; n <= first + frames; ++n) layer.advance_to(n / 60.0);
}

std::uint64_t hash_of(const SimulationLayer& layer) {
  Hash64 hash;
  hash.add(std::span(layer.world().y.data(), static_cast<std::size_t>(layer.world().y.size())));
  layer.hash_into(hash);
  return hash.value();
}

double energy(const World& world) {
  return kinetic_energy(world) + potential_energy(world);
}

TEST(Tether, MakesASystemOfALoneBodyAndJoinsTheSystemOfASprungOne) {
  World world(mixed());
  std::vector<Eigen::Index> relaid;
  const std::vector<Tether> tethers{tether(3, {0.1, 0, 0}, {1, 2, 3}, 10, 1),
                                    tether(1, {0, 0, 0.3}, {0, 0, 1}, 20, 0),
                                    tether(3, {0, 0, 0}, {0, 0, 0}, 5, 0)};
  EXPECT_EQ(set_tethers(world, tethers, relaid), TetherChange::joined);
  EXPECT_EQ(relaid, (std::vector<Eigen::Index>{1, 3}));
  ASSERT_EQ(world.systems.size(), 3u);
  EXPECT_EQ(world.system_of, (std::vector<int>{0, 0, 1, 2, World::kLone}));
  EXPECT_EQ(world.systems[2].columns, (std::vector<Eigen::Index>{3}));
  EXPECT_EQ(world.systems[2].springs.size(), 2u);
  using Held = std::vector<std::vector<int>>;
  EXPECT_EQ(world.systems[2].springs_of, (Held{{0, 1}}));
  EXPECT_EQ(world.systems[0].springs_of, (Held{{0}, {0, 1}}));
  EXPECT_EQ(set_tethers(world, {}, relaid), TetherChange::joined);
  const World untouched(mixed());
  EXPECT_EQ(world.systems.size(), 2u);
  EXPECT_EQ(world.system_of, untouched.system_of);
  EXPECT_EQ(world.systems[0].springs_of, untouched.systems[0].springs_of);
  EXPECT_EQ(world.systems[0].springs.size(), 1u);
}

TEST(Tether, LeavesNoTraceInASceneWithoutSprings) {
  World world(test::scene({at("a", {0, 0, 0})}));
  std::vector<Eigen::Index> relaid;
  const Tether one = tether(0, {0, 0, 0}, {1, 0, 0}, 10, 1);
  set_tethers(world, {&one, 1}, relaid);
  EXPECT_EQ(world.systems.size(), 1u);
  set_tethers(world, {}, relaid);
  EXPECT_TRUE(world.systems.empty());
  EXPECT_TRUE(world.system_of.empty());
  EXPECT_TRUE(world.place_of.empty());
}

TEST(Tether, ToWhatDoesNotMoveIsIgnored) {
  BodyDef wall = at("wall", {0, 0, 0}), belt = at("belt", {0, 0, 0});
  wall.is_static = true;
  wall.mass_properties = {};
  belt.is_kinematic = true;
  World world(test::scene({wall, belt, at("frozen", {0, 0, 0}), at("a", {0, 0, 0})}));
  world.freeze(2);
  std::vector<Eigen::Index> relaid;
  std::vector<Tether> tethers;
  for (const Eigen::Index column : {-1, 0, 1, 2, 3, 4, 1000})
    tethers.push_back(tether(column, {0, 0, 0}, {1, 0, 0}, 10, 1));
  set_tethers(world, tethers, relaid);
  ASSERT_EQ(world.tethers.size(), 1u);
  EXPECT_EQ(world.tethers[0].column, 3);
  // One that does not move any more is dropped, the world's own list given again.
  world.freeze(3);
  EXPECT_EQ(set_tethers(world, world.tethers, relaid), TetherChange::joined);
  EXPECT_TRUE(world.systems.empty());
}

TEST(Tether, ThatIsNoNumberOrPushesIsRefusedBeforeAnythingChanges) {
  SimulationLayer layer(mixed());
  const std::vector<Tether> good{tether(3, {0, 0, 0}, {1, 0, 0}, 10, 1)};
  layer.set_tethers(good);
  const std::uint64_t before = hash_of(layer);
  const double nan = std::nan("");
  for (const Tether& bad :
       {tether(4, {nan, 0, 0}, {0, 0, 0}, 1, 1), tether(4, {0, 0, 0}, {0, nan, 0}, 1, 1),
        tether(4, {0, 0, 0}, {0, 0, 0}, nan, 1), tether(4, {0, 0, 0}, {0, 0, 0}, -1, 1),
        tether(4, {0, 0, 0}, {0, 0, 0}, 1, -1)}) {
    const std::vector<Tether> both{tether(3, {0, 0, 0}, {2, 0, 0}, 10, 1), bad};
    EXPECT_THROW(layer.set_tethers(both), Error);
    EXPECT_EQ(hash_of(layer), before);
  }
}

TEST(Tether, DampsAllOfTheVelocityOfItsPoint) {
  SimulationLayer layer(weightless({test::tumbler()}));
  const Vec3 p_B(0.1, -0.2, 0.3), target(1, 1, 1);
  const std::vector<Tether> tethers{tether(0, p_B, target, 7, 3)};
  layer.set_tethers(tethers);
  const World& world = layer.world();
  const Vec3 arm = orientation(world.y, 0) * p_B;
  const Vec3 x = position(world.y, 0) + arm;
  const Vec3 v = linear_velocity(world, 0) + angular_velocity(world, 0).cross(arm);
  const Vec3 force = 7 * (target - x) - 3 * v;
  const Wrench w = acting_wrench(world, 0);
  EXPECT_TRUE(w.force.isApprox(force, 1e-14));
  EXPECT_TRUE(w.torque.isApprox(arm.cross(force), 1e-14));
}

// The motion of one tumbling body on two tethers by each method that follows it.
TEST(Tether, IsFollowedAlikeByTheSeriesAndByThePair) {
  const std::vector<Tether> tethers{tether(0, {0.1, -0.2, 0.3}, {1, 1, 1}, 70, 3),
                                    tether(0, {0, 0.2, 0}, {0, -1, 1}, 20, 0)};
  const auto moved_by = [&](IntegratorKind kind) {
    Scene scene = test::scene({test::tumbler()});
    scene.simulation.integrator = kind;
    scene.simulation.tolerance = 1e-13;
    SimulationLayer layer(scene);
    layer.set_tethers(tethers);
    run(layer, 0, 120);
    return layer;
  };
  const SimulationLayer series = moved_by(IntegratorKind::taylor);
  const SimulationLayer pair = moved_by(IntegratorKind::dop853);
  EXPECT_EQ(series.methods()[0], Method::taylor);
  EXPECT_EQ(pair.methods()[0], Method::dop853);
  // 120 frames of at most some steps at 1e-13 of quantities of the order of 10.
  EXPECT_LT((series.world().y - pair.world().y).norm(), 1e-9);
  EXPECT_NEAR(series.work(), pair.work(), 1e-9);
  EXPECT_LT(series.momentum_error(), 1e-11);
}

TEST(Tether, BoundsHowFarItsBodyGoes) {
  BodyDef body = test::tumbler();
  for (const double stiffness : {50.0, 1e5}) {
    SimulationLayer layer(test::scene({body}));
    const std::vector<Tether> tethers{tether(0, {0.1, -0.2, 0.3}, {1, 1, 1}, stiffness, 3)};
    layer.set_tethers(tethers);
    const DrivenBound bound = driven_bound(layer.world(), 0, {}, 1);
    const double speed_alone = bound.speed.v;
    double farthest = 0;
    for (int n = 1; n <= 60; ++n) {
      layer.advance_to(n / 60.0);
      farthest = std::max(farthest, (position(layer.world().y, 0) - body.pose.c).norm());
    }
    EXPECT_LE(farthest, bound.path);
    if (stiffness > 1e4) {
      EXPECT_LT(bound.path, 0.1 * speed_alone);
    }
  }
}

TEST(Tether, SetAgainChangesNoBits) {
  const std::vector<Tether> tethers{tether(3, {0.1, 0, 0}, {1, 2, 3}, 10, 1),
                                    tether(0, {0, 0, 0.3}, {0, 0, 1}, 20, 0)};
  SimulationLayer once(mixed()), again(mixed());
  once.set_tethers(tethers);
  for (int n = 0; n < 60; ++n) {
    EXPECT_EQ(again.set_tethers(tethers), n == 0 ? TetherChange::joined : TetherChange::none);
    run(once, n, 1);
    run(again, n, 1);
  }
  EXPECT_EQ(hash_of(once), hash_of(again));
  EXPECT_EQ(once.work(), again.work());
}

TEST(Tether, ElsewhereLeavesTheOthersAloneToTheBit) {
  SimulationLayer alone(mixed()), beside(mixed());
  run(alone, 0, 90);
  run(beside, 0, 20);
  const std::vector<Tether> tethers{tether(3, {0.1, 0, 0}, {1, 2, 3}, 1e5, 10)};
  beside.set_tethers(tethers);
  run(beside, 20, 30);
  beside.set_tethers({});
  run(beside, 50, 40);
  for (const Eigen::Index i : {0, 1, 2, 4})
    EXPECT_EQ(Course::Column(alone.world().y.col(i)), Course::Column(beside.world().y.col(i))) << i;
}

TEST(Tether, ThatEndsLeavesAFreeFlight) {
  SimulationLayer layer(weightless({test::tumbler()}));
  const std::vector<Tether> tethers{tether(0, {0.1, 0, 0}, {1, 2, 3}, 50, 1)};
  layer.set_tethers(tethers);
  run(layer, 0, 30);
  EXPECT_EQ(layer.methods()[0], Method::taylor);
  layer.set_tethers({});
  const Flight flight(layer.world(), 0);
  StateArray expected = layer.world().y;
  run(layer, 30, 30);
  EXPECT_EQ(layer.methods()[0], Method::flight);
  flight.evaluate(layer.world(), 0, 1, expected);
  EXPECT_EQ(layer.world().y, expected);
}

TEST(Tether, IsTriedExplicitlyAgainWhenItIsNoLongerStiff) {
  SimulationLayer layer(weightless({at("a", {0, 0, 0})}));
  std::vector<Tether> tethers{tether(0, {0, 0, 0}, {1, 0, 0}, 1e6, 2e6)};
  layer.set_tethers(tethers);
  run(layer, 0, 20);
  EXPECT_EQ(layer.methods()[0], Method::rosenbrock);
  tethers[0].target = {2, 0, 0};
  layer.set_tethers(tethers);
  run(layer, 20, 1);
  EXPECT_EQ(layer.methods()[0], Method::rosenbrock);
  tethers[0].stiffness = tethers[0].damping = 10;
  layer.set_tethers(tethers);
  run(layer, 21, 1);
  EXPECT_EQ(layer.methods()[0], Method::taylor);
}

TEST(Tether, MovedKeepsTheBalanceOfEnergyAndWork) {
  SimulationLayer layer(mixed());
  const double start = energy(layer.world());
  std::vector<Tether> tethers{tether(3, {0.1, 0.2, 0}, {0, 0, 0}, 100, 5),
                              tether(0, {0, 0, 0.3}, {0, 0, 1}, 20, 0)};
  double largest = 0;
  for (int n = 0; n < 120; ++n) {
    const double angle = n / 20.0;
    tethers[0].target = {std::cos(angle), std::sin(angle), 0.1 * n};
    if (n == 60) tethers.pop_back();
    layer.set_tethers(tethers);
    run(layer, n, 1);
    largest = std::max(largest, std::abs(energy(layer.world())));
  }
  layer.set_tethers({});
  // Rounding and series cut at 1e-14 in each of 120 frames, of all that flows.
  EXPECT_NEAR(energy(layer.world()) - start, layer.work(), 120 * 1e-14 * 10 * largest);
}

TEST(Tether, MovedDoesNotAllocate) {
  if (!test::can_count_allocations()) GTEST_SKIP() << "a sanitizer brings its own malloc";
  SimulationLayer layer(mixed());
  std::vector<Tether> tethers{tether(3, {0.1, 0.2, 0}, {0, 0, 0}, 100, 5),
                              tether(0, {0, 0, 0.3}, {0, 0, 1}, 20, 0),
                              tether(3, {0, 0, 0}, {0, 0, 1}, 20, 0)};
  layer.set_tethers(tethers);
  run(layer, 0, 10);
  const std::size_t before = test::allocations();
  for (int n = 10; n < 60; ++n) {
    for (Tether& t : tethers) t.target.x() += 0.01;
    layer.set_tethers(tethers);
    run(layer, n, 1);
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace poinsot
