#include "poinsot/collision/contact_step.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/profiles.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

constexpr double kG = 9.81;
constexpr double kUsual = 1.0 / 240, kFrame = 4 * kUsual;  // [s]

// Bodies of which each touches the one before; the first is the ground.
struct Stack {
  explicit Stack(const Scene& scene)
      : state(test::with_profile(scene, Profile::accurate)), step(state.def) {
    std::vector<ColliderPair> pairs;
    for (int k = 1; k < static_cast<int>(state.colliders.size()); ++k) pairs.push_back({k - 1, k});
    state.pairs.update(pairs, [&](PairRecord& record) {
      record.a = record.pair.a;
      record.b = record.pair.b;
      record.size = std::min(state.colliders[static_cast<std::size_t>(record.a)].size,
                             state.colliders[static_cast<std::size_t>(record.b)].size);
      record.friction = scene.bodies[static_cast<std::size_t>(record.b)].material.friction;
      record.standing = true;
      return true;
    });
    for (PairRecord& record : state.pairs.records()) state.pairs.make_contact(record);
  }

  // [s] that was solved of h.
  double solve(double h, bool stops = true) {
    step.begin(state, h, kUsual, false, stops);
    for (int r = 0; r < static_cast<int>(state.pairs.records().size()); ++r) step.add(state, r);
    outcome = step.solve(state, books);
    return step.duration();
  }

  CollisionState state;
  ContactStep step;
  ContactStep::Books books;
  ContactStep::Outcome outcome;
};

Scene boxes(int count, double friction = 0.5) {
  std::vector<BodyDef> bodies = {test::ground(friction)};
  for (int k = 0; k < count; ++k) {
    bodies.push_back(test::body("box", Box{{1, 1, 1}}, {0, 0, 0.5 + k}));
    bodies.back().name += std::to_string(k);
    bodies.back().material.friction = friction;
  }
  return test::scene(std::move(bodies));
}

TEST(ContactStep, WhatRestsIsSteppedOverTheWholeFrame) {
  Stack stack(boxes(5));
  EXPECT_EQ(stack.solve(kFrame), kFrame);
  EXPECT_FALSE(stack.step.stopped());
  EXPECT_EQ(stack.outcome.pushing, 20u);
}

TEST(ContactStep, TheForcesOfRestCarryTheWeight) {
  Stack stack(boxes(5));
  stack.solve(kFrame);
  const World& world = stack.state.world();
  for (Eigen::Index k = 1; k <= 5; ++k) {
    const Wrench w = stack.state.simulation.contact_wrenches()[static_cast<std::size_t>(k)];
    EXPECT_NEAR(w.force.z() * world.inv_mass[static_cast<std::size_t>(k)], kG, 1e-9 * kG);
  }
}

TEST(ContactStep, WhatSlidesIsSteppedAsUsual) {
  Scene scene = boxes(1);
  scene.bodies[1].linear_velocity = {1, 0, 0};
  Stack stack(scene);
  EXPECT_EQ(stack.solve(kFrame), kUsual);
  EXPECT_FALSE(stack.step.stopped());
}

TEST(ContactStep, ASubStepEndsWhereTheSlipDoes) {
  for (const double part : {0.01, 0.3, 0.9}) {  // of the usual sub-step, until v = 0
    Scene scene = boxes(1);
    scene.bodies[1].linear_velocity = {0.5 * kG * part * kUsual, 0, 0};
    Stack stack(scene);
    // Full friction to 1e-7 of itself.
    EXPECT_NEAR(stack.solve(kUsual), part * kUsual, 2e-7 * part * kUsual);
    EXPECT_TRUE(stack.step.stopped());
    Stack as_told(scene);
    EXPECT_EQ(as_told.solve(kUsual, false), kUsual);
  }
}

// What a slip goes in a sub-step of the error allowed is no slip.
TEST(ContactStep, NothingIsStoppedForASlipThatDoesNotMatter) {
  Scene scene = boxes(1);
  scene.bodies[1].linear_velocity = {1e-2 * 1e-7 / kUsual, 0, 0};
  Stack stack(scene);
  EXPECT_EQ(stack.solve(kUsual), kUsual);
  EXPECT_FALSE(stack.step.stopped());
}

// The error of a turn is of third order: a sub-step is cut to no less than a quarter.
TEST(ContactStep, ABlockThatTurnsAboutItsEdgeIsSteppedMoreFinely) {
  const auto duration = [](double omega) {
    Scene scene = boxes(1, 2);
    BodyDef& block = scene.bodies[1];
    block.pose.q = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
    const Vec3 arm = block.pose.q * Vec3(0.5, 0, -0.5);
    block.pose.c = -arm;
    block.angular_velocity = {0, omega, 0};
    block.linear_velocity = block.angular_velocity.cross(-arm);
    return Stack(scene).solve(kUsual);
  };
  EXPECT_EQ(duration(0), kUsual);
  EXPECT_EQ(duration(0.1), kUsual);
  EXPECT_LT(duration(3), 0.5 * kUsual);  // faster, and it would lift off
  EXPECT_GE(duration(3), 0.25 * kUsual);
}

// At the pivot of a turning block the velocity that is kept is that at the end of the sub-step: the
// gap there is of third order in the step.
TEST(ContactStep, APivotStaysInPlaceToThirdOrder) {
  const auto drift = [](double h) {
    Scene scene = boxes(1, 2);
    BodyDef& block = scene.bodies[1];
    block.pose.q = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
    const Vec3 arm = block.pose.q * Vec3(0.5, 0, -0.5);
    block.pose.c = -arm;
    block.angular_velocity = {0, 1, 0};
    block.linear_velocity = block.angular_velocity.cross(-arm);
    Stack stack(scene);
    stack.step.begin(stack.state, h, h, false, false);
    stack.step.add(stack.state, 0);
    stack.step.solve(stack.state, stack.books);
    SimulationWorker worker(stack.state.world());
    Tally tally;
    stack.state.simulation.advance(stack.step.movers(), 0, h, true, worker, tally);
    const World& world = stack.state.world();
    return (Vec3(position(world.y, 1)) + orientation(world.y, 1) * Vec3(0.5, 0, -0.5)).norm();
  };
  EXPECT_NEAR(drift(1.0 / 120) / drift(1.0 / 240), 8, 1);
  EXPECT_LT(drift(1.0 / 240), 1e-6);
}

TEST(ContactStep, PushOutIsCountedAndBoundedByTheWeightTimesTheDepth) {
  Scene scene = boxes(1);
  const double depth = 1e-3;
  scene.bodies[1].pose.c.z() -= depth;
  scene.allow_overlap = true;
  Stack stack(scene);
  stack.solve(kUsual);
  const double lifted = position(stack.state.world().y, 1).z() - (0.5 - depth);
  const double weight = kG * stack.state.world().mass[1];
  EXPECT_GT(lifted, 0);
  EXPECT_NEAR(stack.books.push_out_energy, weight * lifted, 1e-9 * weight * depth);
  EXPECT_LE(stack.books.push_out_energy, weight * depth);
}

TEST(ContactStep, RestIsProvenWhereItIsAndNowhereElse) {
  Stack still(boxes(3));
  still.step.begin(still.state, kUsual, kUsual, true, false);
  for (int r = 0; r < 3; ++r) still.step.add(still.state, r);
  EXPECT_TRUE(still.step.proves_rest(still.state));

  Scene scene = boxes(3);
  for (BodyDef& body : scene.bodies) body.pose.c.x() += 0.3 * (body.pose.c.z() - 0.5);
  Stack leans(scene);  // the upper two together have their centre 0.45 beyond the lowest one's
  leans.step.begin(leans.state, kUsual, kUsual, true, false);
  for (int r = 0; r < 3; ++r) leans.step.add(leans.state, r);
  EXPECT_TRUE(leans.step.proves_rest(leans.state));
  scene.bodies[3].pose.c.x() += 0.2;  // 0.55
  Stack falls(scene);
  falls.step.begin(falls.state, kUsual, kUsual, true, false);
  for (int r = 0; r < 3; ++r) falls.step.add(falls.state, r);
  EXPECT_FALSE(falls.step.proves_rest(falls.state));
}

}  // namespace
}  // namespace poinsot
