// Crowds: many bodies stepped by soft_step stand, stop what is thrown at them, give way to what
// pushes them, and change solver without a jump.

#include <gtest/gtest.h>

#include "poinsot/presentation/presentation_layer.h"
#include "support/profiles.h"
#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene stepped_by(ContactSolverKind solver, Scene scene, int threads = 1) {
  scene = test::with_profile(std::move(scene), Profile::fast);
  scene.collision.contact_solver = solver;
  scene.collision.threads = threads;
  scene.collision.sleeping = false;
  return scene;
}

// Unit boxes side by side and on one another, `gap` [m] apart.
std::vector<BodyDef> boxes(int nx, int ny, int nz, double gap) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        bodies.push_back(test::body("box" + std::to_string(bodies.size()), Box{{1, 1, 1}},
                                    {(1 + gap) * x, (1 + gap) * y, 0.5 + gap + (1 + gap) * z}));
  return bodies;
}

// [m] of boxes in the ones below them.
struct Penetration {
  double mean = 0, max = 0;
};
Penetration penetration(const CollisionLayer& layer) {
  // Of unit boxes that have hardly turned and stand in columns: by their heights.
  const World& world = layer.world();
  Penetration result;
  int pairs = 0;
  for (Eigen::Index i = 1; i < world.size(); ++i) {
    double below = -0.5;
    for (Eigen::Index j = 1; j < world.size(); ++j) {
      const Vec3 d = position(world.y, i) - position(world.y, j);
      if (std::abs(d.x()) < 0.5 && std::abs(d.y()) < 0.5 && d.z() > 0.5)
        below = std::max<double>(below, position(world.y, j).z());
    }
    const double depth = std::max(0.0, 1 - (position(world.y, i).z() - below));
    result.mean += depth;
    result.max = std::max(result.max, depth);
    ++pairs;
  }
  result.mean /= pairs;
  return result;
}

TEST(Crowd, APileOfBoxesStandsAndGainsNoEnergy) {
  CollisionLayer layer(stepped_by(ContactSolverKind::soft_step, test::scene(boxes(8, 8, 4, 0.01))));
  const double start = layer.energy();
  double last = start;
  test::run_until(layer, 10, [&](const CollisionLayer& now) {
    // What push-out adds is counted apart.
    EXPECT_LT(now.energy() - now.report().push_out_energy, start * (1 + 1e-12));
    last = now.energy();
  });
  EXPECT_LT(last, start);
  EXPECT_EQ(layer.report().soft_bodies, 256u);
  EXPECT_EQ(layer.report().direct_bodies, 0u);
  const Penetration depth = penetration(layer);
  EXPECT_LT(depth.mean, 1e-3);
  EXPECT_LT(depth.max, 5e-3);
  for (Eigen::Index i = 1; i < layer.world().size(); ++i)
    EXPECT_LT(linear_velocity(layer.world(), i).norm(), 1e-2);
}

TEST(Crowd, OneThreadAndTwoGiveTheSameHashInEveryFrame) {
  for (const ContactSolverKind solver :
       {ContactSolverKind::soft_step, ContactSolverKind::automatic}) {
    PresentationLayer one(stepped_by(solver, test::scene(boxes(6, 6, 4, 0.05)), 1));
    PresentationLayer two(stepped_by(solver, test::scene(boxes(6, 6, 4, 0.05)), 2));
    for (int n = 1; n <= 300; ++n) {
      one.advance_frame();
      two.advance_frame();
      ASSERT_EQ(one.snapshot().state_hash, two.snapshot().state_hash) << "frame " << n;
      ASSERT_LE(one.report().soft_bodies + one.report().direct_bodies, 144u);  // nobody twice
    }
    EXPECT_EQ(one.report().soft_bodies, 144u);
  }
}

// 100 m/s are 1.7 m a frame, 0.4 m a sub-step; the wall is 0.3 m thick.
TEST(Crowd, AFastBallDoesNotPassAWall) {
  for (const ContactSolverKind solver :
       {ContactSolverKind::soft_step, ContactSolverKind::automatic}) {
    std::vector<BodyDef> bodies = {test::ground()};
    for (int z = 0; z < 8; ++z)
      for (int y = -4; y <= 4; ++y)
        bodies.push_back(test::body("brick" + std::to_string(bodies.size()), Box{{0.3, 1, 0.5}},
                                    {0, static_cast<double>(y), 0.25 + 0.5 * z}));
    bodies.push_back(test::body("ball", Sphere{0.1}, {-3.3, 0.2, 1.7}));
    bodies.back().linear_velocity = {100, 0, 0};
    CollisionLayer layer(stepped_by(solver, test::scene(std::move(bodies))));
    const Eigen::Index ball = layer.world().size() - 1;
    const Eigen::Index hit = 1 + 3 * 9 + 4;  // the brick in its way
    double shoved = 0;                       // [m/s]
    test::run_until(layer, 0.5, [&](const CollisionLayer& now) {
      const double ahead = position(now.world().y, hit).x() - position(now.world().y, ball).x();
      ASSERT_GT(ahead, 0) << now.time();
      shoved = std::max(shoved, linear_velocity(now.world(), hit).x());
    });
    EXPECT_GT(shoved, 0.1);
    EXPECT_LT(linear_velocity(layer.world(), ball).x(), 1);
  }
}

TEST(Crowd, AKinematicBodyPushesAllBeforeIt) {
  for (const ContactSolverKind solver :
       {ContactSolverKind::soft_step, ContactSolverKind::automatic}) {
    std::vector<BodyDef> bodies = boxes(4, 4, 2, 0.02);
    BodyDef plough = test::body("plough", Box{{0.5, 8, 3}}, {-1, 1.5, 1.6});
    plough.is_kinematic = true;
    plough.linear_velocity = {0.5, 0, 0};
    bodies.push_back(plough);
    CollisionLayer layer(stepped_by(solver, test::scene(std::move(bodies))));
    test::run_until(layer, 6);
    const World& world = layer.world();
    const double front = position(world.y, world.size() - 1).x() + 0.25;
    EXPECT_NEAR(front, -1 + 0.5 * 6 + 0.25, 1e-9);
    for (Eigen::Index i = 1; i + 1 < world.size(); ++i) {
      if (position(world.y, i).z() > 3.1) continue;
      // Its lowest corner is ahead, at least by half the box.
      EXPECT_GT(position(world.y, i).x(), front + 0.5 - 5e-3) << i;
    }
    EXPECT_GT(layer.report().soft_bodies, 0u);
  }
}

// A push in body axes is not for soft_step: while it lasts the tower is solved directly.
TEST(Crowd, AChangeOfSolverThrowsNobody) {
  const Scene scene = stepped_by(ContactSolverKind::automatic, test::scene(boxes(1, 1, 10, 0)));
  CollisionLayer layer(scene);
  const Eigen::Index top = layer.world().size() - 1;
  constexpr double kSubStep = 9.81 / 240;  // [m/s] what gravity gives in a sub-step
  int changes = 0;
  bool was_soft = false;  // the crowd takes it a frame later
  double before = 0;      // [m/s] the fastest in the frame before
  test::run_until(layer, 10, [&](const CollisionLayer& now) {
    const bool is_soft = now.report().soft_bodies == 10;
    EXPECT_EQ(now.report().soft_bodies + now.report().direct_bodies, 10u);
    double fastest = 0;
    for (Eigen::Index i = 1; i <= top; ++i)
      fastest = std::max(fastest, linear_velocity(now.world(), i).norm());
    if (is_soft != was_soft) {
      ++changes;
      EXPECT_LT(fastest, before + kSubStep) << now.time();
    }
    EXPECT_LT(fastest, scene.collision.push_out_speed);
    was_soft = is_soft;
    before = fastest;
    const bool pushed = now.time() > 2 && now.time() < 4;
    layer.world().held[static_cast<std::size_t>(top)].in_B.force = {0, 0, pushed ? -1.0 : 0.0};
  });
  EXPECT_EQ(changes, 3);
  EXPECT_LT((position(layer.world().y, top) - Vec3(0, 0, 9.5)).norm(), 0.05);  // it stands
}

// Each is ten times as heavy as the one below: what the crowd can bear once it cannot three times.
TEST(Crowd, DoesNotTakeHeavyBodiesOnLightOnes) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int z = 0; z < 4; ++z)
    bodies.push_back(
        test::body("box" + std::to_string(z), Box{{1, 1, 1}}, {0, 0, 0.5 + z}, std::pow(10.0, z)));
  const Scene scene = stepped_by(ContactSolverKind::automatic, test::scene(std::move(bodies)));
  CollisionLayer layer(scene);
  // Bodies leave the crowd a frame late: each box sinks no farther meanwhile than it would fall.
  constexpr double kFall = 0.5 * 9.81 / (test::kFrameRate * test::kFrameRate);  // [m]
  test::run_until(layer, 5, [&](const CollisionLayer& now) {
    if (now.time() > 1.5 / test::kFrameRate) {
      EXPECT_EQ(now.report().soft_bodies, 0u) << now.time();
    }
  });
  for (Eigen::Index i = 1; i < layer.world().size(); ++i) {
    const Vec3 start = scene.bodies[static_cast<std::size_t>(i)].pose.c;
    EXPECT_LT((position(layer.world().y, i) - start).norm(), static_cast<double>(i) * kFall);
  }
}

}  // namespace
}  // namespace poinsot
