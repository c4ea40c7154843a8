#include "poinsot/simulation/springs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "unit/simulation/sample_system.h"

namespace poinsot {
namespace {

using Columns = std::vector<Eigen::Index>;

BodyDef at(const std::string& name, const Vec3& c, bool is_static = false) {
  BodyDef def = test::free_body(name, 2, {1, 2, 3});
  def.pose.c = c;
  if (is_static) {
    def.is_static = true;
    def.mass_properties = {};
  }
  return def;
}

SpringDef between(const std::string& a, const std::string& b) {
  return test::spring(a, Vec3::Zero(), b, Vec3::Zero(), 10, 0, std::nullopt);
}

TEST(MakeSystems, FindsNoneWithoutSprings) {
  EXPECT_TRUE(World(test::scene({at("a", {1, 0, 0})})).systems.empty());
  EXPECT_TRUE(World(test::scene({at("a", {1, 0, 0})})).system_of.empty());
}

TEST(MakeSystems, JoinsChainsAndLeavesTheOthersAlone) {
  Scene scene = test::scene({at("a", {0, 0, 0}), at("lone", {1, 0, 0}), at("b", {2, 0, 0}),
                             at("x", {3, 0, 0}), at("c", {4, 0, 0}), at("y", {5, 0, 0})});
  scene.springs = {between("c", "b"), between("y", "x"), between("a", "b")};
  const World world(scene);
  ASSERT_EQ(world.systems.size(), 2u);
  EXPECT_EQ(world.systems[0].columns, (Columns{0, 2, 4}));
  EXPECT_EQ(world.systems[0].springs.size(), 2u);
  EXPECT_EQ(world.systems[1].columns, (Columns{3, 5}));
  EXPECT_EQ(world.system_of, (std::vector<int>{0, World::kLone, 0, 1, 0, 1}));
  const SpringLink& first = world.systems[0].springs[0];  // c is the third column, b the second
  EXPECT_EQ(first.a, 2);
  EXPECT_EQ(first.b, 1);
  EXPECT_EQ(first.rest, 2);  // the distance at time 0
  using Held = std::vector<std::vector<int>>;
  EXPECT_EQ(world.systems[0].springs_of, (Held{{1}, {0, 1}, {0}}));
  EXPECT_EQ(world.place_of[4], 2);
}

TEST(MakeSystems, MakesPointsOfTheWorldOfBodiesThatDoNotMove) {
  Scene scene = test::scene({at("wall", {0, 0, 5}, true), at("floor", {0, 0, -5}, true),
                             at("a", {1, 0, 0}), at("b", {2, 0, 0}), at("c", {3, 0, 0})});
  scene.bodies[0].pose.q = Quat(0.5, 0.5, 0.5, 0.5);  // x → y → z → x
  scene.springs = {test::spring("wall", Vec3(1, 0, 0), "a", Vec3(0, 0, 1), 10, 2, 0.5),
                   between("b", "floor"), between("wall", "floor"),
                   test::spring("c", Vec3::Zero(), "", Vec3(7, 8, 9), 10, 0, 0)};
  const World world(scene);
  ASSERT_EQ(world.systems.size(), 3u);  // static bodies join nothing; wall to floor is left out
  const SpringLink& wall = world.systems[0].springs[0];
  EXPECT_EQ(world.systems[0].columns, (Columns{2}));
  EXPECT_EQ(wall.a, 0);  // the end that moves comes first
  EXPECT_EQ(wall.b, SpringLink::kWorld);
  EXPECT_TRUE(wall.p_a.isApprox(Vec3(0, 0, 1)));
  EXPECT_TRUE(wall.p_b.isApprox(Vec3(0, 1, 5), 1e-15));
  EXPECT_FALSE(wall.is_linear());
  EXPECT_TRUE(world.systems[1].springs[0].p_b.isApprox(Vec3(0, 0, -5)));
  EXPECT_TRUE(world.systems[2].springs[0].p_b.isApprox(Vec3(7, 8, 9)));
  EXPECT_TRUE(world.systems[2].springs[0].is_linear());
}

TEST(MakeSystems, MeasuresPointsFromTheCentreOfMass) {
  Scene scene = test::scene({at("a", {1, 0, 0})});
  scene.bodies[0].mass_properties.center_of_mass = {0.1, 0.2, 0.3};
  scene.springs = {test::spring("a", Vec3(1, 1, 1), "", Vec3(5, 1, 1), 10, 0, std::nullopt)};
  const World world(scene);
  EXPECT_TRUE(world.systems[0].springs[0].p_a.isApprox(Vec3(0.9, 0.8, 0.7), 1e-15));
  EXPECT_NEAR(world.systems[0].springs[0].rest, 3, 1e-15);
}

SpringLink link(double stiffness, double damping, double rest) {
  return {0, 1, Vec3::Zero(), Vec3::Zero(), stiffness, damping, rest};
}

TEST(SpringForce, PullsWhereItIsLongAndPushesWhereItIsShort) {
  const Vec3 a(3, 4, 0), b(0, 0, 0), still = Vec3::Zero();
  const Vec3 along = a / 5;
  EXPECT_TRUE(
      spring_force(link(10, 0, 2), a, b, still, still).elastic.isApprox(-30 * along, 1e-15));
  EXPECT_TRUE(spring_force(link(10, 0, 6), a, b, still, still).elastic.isApprox(10 * along, 1e-14));
  EXPECT_TRUE(
      spring_force(link(10, 0, 0), a, b, still, still).elastic.isApprox(-50 * along, 1e-15));
  EXPECT_EQ(spring_force(link(10, 0, 0), a, a, still, still).elastic, Vec3::Zero());
}

// Only the rate of the distance is damped, and the force is along it.
TEST(SpringForce, DampsTheRateOfItsLength) {
  const Vec3 a(3, 4, 0), b(0, 0, 0), along = a / 5, across(-0.8, 0.6, 0);
  const auto damping = [&](const Vec3& v) {
    return spring_force(link(10, 3, 5), a, b, v, Vec3(1, 1, 1)).damping;
  };
  EXPECT_TRUE(damping(Vec3(1, 1, 1) + 2 * along).isApprox(-6 * along, 1e-14));
  EXPECT_NEAR(damping(Vec3(1, 1, 1) + 2 * across).norm(), 0, 1e-14);
}

TEST(SpringForce, IsOppositeForTheOtherEnd) {
  const Vec3 a(3, 4, 0), b(0.1, -1, 2), v(1, 2, 3), w(0.3, -1, 0);
  const SpringForce one = spring_force(link(10, 3, 2), a, b, v, w);
  const SpringForce other = spring_force(link(10, 3, 2), b, a, w, v);
  EXPECT_EQ(one.elastic, -other.elastic);
  EXPECT_EQ(one.damping, -other.damping);
}

TEST(SpringEnergy, IsWhatItsForceTakes) {
  EXPECT_NEAR(spring_energy(link(10, 1, 2), {3, 4, 0}, {0, 0, 0}), 45, 1e-13);
  // −dU/da is the force: by a central difference of error h².
  const SpringLink spring = link(10, 0, 2);
  const Vec3 a(3, 4, 1), b(0.5, 0, 0);
  const double h = 1e-5;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = h * Vec3::Unit(i);
    const double slope =
        (spring_energy(spring, a + d, b) - spring_energy(spring, a - d, b)) / (2 * h);
    EXPECT_NEAR(spring_force(spring, a, b, Vec3::Zero(), Vec3::Zero()).elastic[i], -slope, 1e-8);
  }
}

TEST(DragForce, IsAgainstTheVelocity) {
  const Vec3 v(3, 0, 4);
  EXPECT_TRUE(drag_force({0.5, 0, 0}, v).isApprox(-0.5 * v, 1e-15));
  EXPECT_TRUE(drag_force({0.5, 0.2, 0}, v).isApprox(-(0.5 + 0.2 * 5) * v, 1e-15));
  EXPECT_EQ(drag_force({0.5, 0.2, 0}, Vec3::Zero()), Vec3::Zero());
}

}  // namespace
}  // namespace poinsot
