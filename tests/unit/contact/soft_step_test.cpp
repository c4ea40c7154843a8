#include "poinsot/contact/soft_step.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "poinsot/contact/soft_blocks.h"
#include "support/allocation_counter.h"

namespace poinsot {
namespace {

constexpr double kGravity = 9.81;  // [m/s²]
constexpr double kFrame = 1.0 / 60;

SoftBody still_body(const Vec3& c) {
  SoftBody body;
  body.c = c;
  body.q = Quat::Identity();
  body.v = body.L = body.omega = body.acceleration = body.torque = Vec3::Zero();
  return body;
}

SoftBody box(const Vec3& c, const Vec3& size, double mass) {
  SoftBody body = still_body(c);
  body.inv_mass = 1 / mass;
  const Vec3 squares = size.cwiseProduct(size);
  const Vec3 J = mass / 12 * (Vec3::Constant(squares.sum()) - squares);
  body.inv_J_B = J.cwiseInverse().asDiagonal();
  body.turns_evenly = J.x() == J.y() && J.y() == J.z();
  body.acceleration.z() = -kGravity;
  return body;
}

// Boxes on boxes: corners of a's lower face against the plane of b's upper one.
struct Stack {
  struct Face {
    int a, b;
    double x_0, x_1;  // [m] of the corners, in a's frame
    SoftManifold manifold = {};
  };
  std::vector<SoftBody> bodies = {still_body(Vec3(0, 0, -0.5))};  // the ground, 1 m thick
  std::vector<Face> faces;
  std::vector<SoftManifold> manifolds;
  SoftStep solver;
  double friction = 0.6;

  int add(const Vec3& c, double mass) {
    bodies.push_back(box(c, Vec3::Ones(), mass));
    return static_cast<int>(bodies.size()) - 1;
  }
  void rest(int a, int b, double x_0 = -0.5, double x_1 = 0.5) {
    faces.push_back({a, b, x_0, x_1, {}});
    SoftManifold& manifold = faces.back().manifold;
    manifold.a = a;
    manifold.b = b;
    manifold.count = 4;
    manifold.friction = friction;
    manifold.size = 1;
  }
  void find_contacts() {
    manifolds.clear();
    for (Face& face : faces) {
      const SoftBody& a = bodies[static_cast<std::size_t>(face.a)];
      const SoftBody& b = bodies[static_cast<std::size_t>(face.b)];
      SoftManifold& manifold = face.manifold;
      manifold.normal = b.q * Vec3::UnitZ();
      for (int i = 0; i < 4; ++i) {
        SoftManifold::Point& point = manifold.points[i];
        point.arm_a = a.q * Vec3(i == 1 || i == 2 ? face.x_1 : face.x_0, i > 1 ? 0.5 : -0.5, -0.5);
        point.gap = (a.c + point.arm_a - b.c).dot(manifold.normal) - 0.5;
        point.arm_b = a.c + point.arm_a - b.c - point.gap * manifold.normal;
      }
      manifolds.push_back(manifold);
    }
  }
  SoftOutcome step(Team& team, const SoftSettings& settings) {
    find_contacts();
    const SoftOutcome outcome = solver.advance(bodies, manifolds, {}, kFrame, settings, team);
    for (std::size_t k = 0; k < faces.size(); ++k) faces[k].manifold = manifolds[k];
    return outcome;
  }
};

Stack tower(int height) {
  Stack stack;
  for (int k = 0; k < height; ++k) stack.rest(stack.add(Vec3(0, 0, k + 0.5), 1000), k);
  return stack;
}

Stack wall(int rows) {
  Stack stack;
  std::vector<int> below;
  for (int row = 0; row < rows; ++row) {
    std::vector<int> own;
    for (int k = 0; k < rows - row; ++k) {
      own.push_back(stack.add(Vec3(k + 0.5 * row, 0, row + 0.5), 1000));
      if (row == 0) {
        stack.rest(own.back(), 0);
      } else {
        stack.rest(own.back(), below[static_cast<std::size_t>(k)], -0.5, 0);
        stack.rest(own.back(), below[static_cast<std::size_t>(k) + 1], 0, 0.5);
      }
    }
    below = own;
  }
  return stack;
}

double kinetic_energy(const std::vector<SoftBody>& bodies) {
  double energy = 0;
  for (const SoftBody& body : bodies)
    if (body.inv_mass > 0)
      energy += 0.5 * (body.v.squaredNorm() / body.inv_mass + body.omega.dot(body.L));
  return energy;
}

TEST(SoftStep, FollowsTheParabolaWhereNothingTouches) {
  std::vector<SoftBody> bodies = {box(Vec3::Zero(), Vec3::Ones(), 2)};
  bodies[0].v = Vec3(1, 2, 3);
  bodies[0].L = Vec3(0.3, 0.1, -0.2);
  SoftStep solver;
  Team team(1);
  double work = 0;
  for (int frame = 0; frame < 60; ++frame)
    work += solver.advance(bodies, {}, {}, kFrame, {}, team).force_work;
  // Rounding of 240 sub-steps of positions up to 3 m.
  EXPECT_LT((bodies[0].c - Vec3(1, 2, 3 - kGravity / 2)).norm(), 240 * 3 * 1e-15);
  EXPECT_EQ(bodies[0].L, Vec3(0.3, 0.1, -0.2));
  EXPECT_NEAR(work, 2 * kGravity * (kGravity / 2 - 3), 1e-11);
}

TEST(SoftStep, CountsTheWorkOfTorques) {
  for (const Vec3& size : {Vec3(1, 1, 1), Vec3(1, 0.5, 0.2)}) {
    std::vector<SoftBody> bodies = {box(Vec3::Zero(), size, 2)};
    bodies[0].torque = Vec3(0, 0.3, 0);  // about a principal axis
    SoftStep solver;
    Team team(1);
    double work = 0, unaccounted = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const SoftOutcome outcome = solver.advance(bodies, {}, {}, kFrame, {}, team);
      work += outcome.force_work;
      unaccounted += outcome.loss;
    }
    EXPECT_NEAR(unaccounted, 0, 1e-9 * work);
  }
}

TEST(SoftStep, TumblesFreelyWithoutLosingEnergy) {
  std::vector<SoftBody> bodies = {box(Vec3::Zero(), Vec3(1, 0.5, 0.2), 2)};
  SoftBody& body = bodies[0];
  body.acceleration.setZero();
  const Vec3 omega(0.01, 5, 0.02);
  body.L = body.inv_J_B.inverse() * omega;
  const Vec3 L = body.L;
  const double energy = 0.5 * L.dot(omega);
  SoftStep solver;
  Team team(1);
  double worst = 0;
  for (int frame = 0; frame < 600; ++frame) {
    solver.advance(bodies, {}, {}, kFrame, {}, team);
    worst = std::max(worst, std::abs(0.5 * body.L.dot(body.omega) / energy - 1));
    EXPECT_NEAR(body.q.norm(), 1, 1e-15);
  }
  // φ⁴ per radian at the angle φ of an inner step, over 50 rad.
  EXPECT_LT(worst, 50 * std::pow(0.02, 4));
  EXPECT_LT((body.L - L).norm(), 1e-12 * L.norm());
}

TEST(SoftStep, LeavesAFlatImpactAsRestitutionSays) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    Stack stack;
    stack.rest(stack.add(Vec3(0, 0, 0.51), 3), 0);
    stack.faces[0].manifold.restitution = restitution;
    stack.bodies[1].v.z() = -2;
    stack.bodies[1].acceleration.setZero();
    Team team(1);
    const SoftOutcome outcome = stack.step(team, {});
    // Points are solved one after another: a hundredth of the speed is left among them.
    EXPECT_NEAR(stack.bodies[1].v.z(), 2 * restitution, 0.02);
    EXPECT_LT(stack.bodies[1].omega.norm(), 0.04);
    EXPECT_NEAR(outcome.loss, 6 * (1 - restitution * restitution), 0.12);
    EXPECT_GE(stack.bodies[1].c.z(), 0.5 - 1e-4);
    EXPECT_LT(stack.step(team, {}).residual, 0.02);
  }
}

TEST(SoftStep, BouncesABallAsRestitutionSays) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    std::vector<SoftBody> bodies = {still_body(Vec3::Zero()),
                                    box(Vec3(0, 0, 0.51), Vec3::Ones(), 3)};
    bodies[1].v.z() = -2;
    bodies[1].acceleration.setZero();
    SoftManifold manifold;
    manifold.a = 1;
    manifold.b = 0;
    manifold.count = 1;
    manifold.restitution = restitution;
    manifold.size = 1;
    manifold.points[0].arm_a = Vec3(0, 0, -0.5);
    manifold.points[0].gap = 0.01;
    SoftStep solver;
    Team team(1);
    const SoftOutcome outcome =
        solver.advance(bodies, std::span(&manifold, 1), {}, kFrame, {}, team);
    EXPECT_NEAR(bodies[1].v.z(), 2 * restitution, 1e-13);
    EXPECT_NEAR(outcome.loss, 6 * (1 - restitution * restitution), 1e-12);
  }
}

TEST(SoftStep, SlowsASlidingPointAlikeInAllDirections) {
  constexpr double kFriction = 0.3, kSpeed = 3, kMass = 2;
  for (int k = 0; k < 24; ++k) {
    const double angle = 2 * std::numbers::pi * k / 24;
    const Vec3 along(std::cos(angle), std::sin(angle), 0);
    std::vector<SoftBody> bodies = {still_body(Vec3::Zero()),
                                    box(Vec3(0, 0, 0.5), Vec3::Ones(), kMass)};
    bodies[1].inv_J_B.setZero();  // it does not turn
    bodies[1].v = kSpeed * along;
    SoftManifold manifold = {};
    manifold.a = 1;
    manifold.b = 0;
    manifold.count = 1;
    manifold.normal = Vec3::UnitZ();
    manifold.friction = kFriction;
    manifold.size = 1;
    manifold.points[0].normal_impulse = manifold.points[0].usual_impulse =
        kMass * kGravity * kFrame / 4;
    SoftStep solver;
    Team team(1);
    for (int frame = 0; frame < 12; ++frame) {
      manifold.points[0].arm_a = Vec3(0, 0, -0.5);
      manifold.points[0].arm_b = bodies[1].c - Vec3(0, 0, 0.5);
      solver.advance(bodies, std::span(&manifold, 1), {}, kFrame, {}, team);
    }
    const double speed = kSpeed - kFriction * kGravity * 12 * kFrame;
    EXPECT_LT((bodies[1].v - speed * along).norm(), 1e-12) << k;
  }
}

TEST(SoftStep, SlowsARollingBallByItsRollingResistance) {
  // m a = −f, J α = f r − ρ m g, a = α r: a = −ρ g r / (r² + J/m).
  constexpr double kRadius = 0.5, kArm = 0.01, kSpeed = 2;
  std::vector<SoftBody> bodies = {still_body(Vec3::Zero()),
                                  box(Vec3(0, 0, kRadius), Vec3::Ones(), 2)};
  SoftBody& ball = bodies[1];
  ball.v.x() = kSpeed;
  const double J = 1 / ball.inv_J_B(0, 0);
  ball.L.y() = J * kSpeed / kRadius;
  SoftManifold manifold;
  manifold.a = 1;
  manifold.b = 0;
  manifold.count = 1;
  manifold.round_a = true;
  manifold.friction = 0.8;
  manifold.size = 1;
  SoftStep solver;
  SoftSettings settings;
  settings.rolling_resistance = kArm;
  Team team(1);
  for (int frame = 0; frame < 60; ++frame) {
    manifold.points[0].arm_a = Vec3(0, 0, -kRadius);
    manifold.points[0].arm_b = ball.c - Vec3(0, 0, kRadius);
    solver.advance(bodies, std::span(&manifold, 1), {}, kFrame, settings, team);
  }
  const double slowed = kArm * kGravity * kRadius / (kRadius * kRadius + J * ball.inv_mass);
  // The first frame has no load yet.
  EXPECT_NEAR(ball.v.x(), kSpeed - slowed, 2 * kFrame * slowed);
  EXPECT_NEAR(ball.omega.y(), ball.v.x() / kRadius, 1e-6);
}

TEST(SoftStep, CarriesATowerWithItsWeight) {
  Stack stack = tower(10);
  Team team(1);
  SoftSettings settings;
  settings.steps = 8;
  SoftOutcome outcome;
  for (int frame = 0; frame < 1200; ++frame) outcome = stack.step(team, settings);
  for (int k = 0; k < 10; ++k) {
    double load = 0;
    for (const SoftManifold::Point& point : stack.manifolds[static_cast<std::size_t>(k)].points)
      load += point.normal_impulse;
    const double weight = 1000.0 * (10 - k) * kGravity;
    EXPECT_NEAR(load / (kFrame / 8), weight, 1e-2 * weight);
    EXPECT_LT((stack.bodies[static_cast<std::size_t>(k) + 1].c - Vec3(0, 0, k + 0.5)).norm(), 3e-3);
  }
  EXPECT_EQ(outcome.pushing, 40u);
  EXPECT_LT(outcome.max_penetration, 3e-4);  // weight of all on a spring of 0.25/h would be 4e-4 m
}

TEST(SoftStep, BringsABoxToRest) {
  Stack stack;
  stack.rest(stack.add(Vec3(0, 0, 0.6), 5), 0);
  stack.bodies[1].L = Vec3(0.1, 0.2, 0);
  stack.bodies[1].v.x() = 0.3;
  Team team(1);
  // The usual load is learnt with a time constant of 14 s, and all else waits for it.
  for (int frame = 0; frame < 12000; ++frame) stack.step(team, {});
  EXPECT_LT(kinetic_energy(stack.bodies), 1e-20);
  const Vec3 before = stack.bodies[1].c;
  for (int frame = 0; frame < 60; ++frame) stack.step(team, {});
  EXPECT_LT((stack.bodies[1].c - before).norm(), 1e-11);  // [m] a second at that energy
}

TEST(SoftStep, StaysAtRestOnASlopeThatHolds) {
  Stack stack;
  stack.friction = 0.6;
  stack.rest(stack.add(Vec3(0, 0, 0.5), 5), 0);
  stack.bodies[1].acceleration = Vec3(0.5, 0, -1) * kGravity;
  Team team(1);
  for (int frame = 0; frame < 12000; ++frame) stack.step(team, {});
  const Vec3 before = stack.bodies[1].c;
  for (int frame = 0; frame < 600; ++frame) stack.step(team, {});
  EXPECT_LT((stack.bodies[1].c - before).norm(), 1e-9);
}

TEST(SoftStep, ConservesMomentum) {
  // Boxes fly into each other; inertia is not isotropic.
  Stack stack;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 6; ++k) {
    const int own = stack.add(Vec3(0, 0, k + 0.5), 1 + k);
    SoftBody& body = stack.bodies[static_cast<std::size_t>(own)];
    body = box(body.c, Vec3(1, 0.8, 0.5), 1 + k);
    body.acceleration.setZero();
    body.v = Vec3(unit(random), unit(random), -k);
    body.L = 0.1 * Vec3(unit(random), unit(random), unit(random));
    body.omega = body.inv_J_B * body.L;
    if (k > 0) stack.rest(own, own - 1);
  }
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (const SoftBody& body : stack.bodies)
      if (body.inv_mass > 0) sum += body.v / body.inv_mass;
    return sum;
  };
  const Vec3 before = momentum();
  const double energy = kinetic_energy(stack.bodies);
  Team team(1);
  SoftOutcome outcome = stack.step(team, {});
  EXPECT_GT(outcome.loss, 1e-3 * energy);
  EXPECT_LT((momentum() - before).norm(), 1e-13 * 100);
  EXPECT_NEAR(kinetic_energy(stack.bodies) - energy, outcome.push_out_energy - outcome.loss,
              1e-12 * energy);
}

TEST(SoftStep, IsTheSameOnOneThreadAndOnMore) {
  std::vector<std::vector<double>> bits;
  for (const int threads : {1, 2, 3}) {
    Stack stack = wall(40);
    Team team(threads);
    for (int frame = 0; frame < 20; ++frame) stack.step(team, {});
    std::vector<double> state;
    for (const SoftBody& body : stack.bodies) {
      state.insert(state.end(), body.c.data(), body.c.data() + 3);
      state.insert(state.end(), body.q.coeffs().data(), body.q.coeffs().data() + 4);
      state.insert(state.end(), body.v.data(), body.v.data() + 3);
      state.insert(state.end(), body.L.data(), body.L.data() + 3);
    }
    bits.push_back(state);
  }
  EXPECT_EQ(bits[0], bits[1]);
  EXPECT_EQ(bits[0], bits[2]);
}

TEST(SoftKernels, GiveTheSameBitsAtEveryWidth) {
  std::vector<std::vector<double>> bits;
  for (const SoftKernels& kernels : {baseline_soft_kernels(), soft_kernels()}) {
    Stack stack = wall(6);
    stack.bodies[3].v = Vec3(0.1, -0.2, -0.5);
    stack.bodies[5].L = Vec3(1, 2, 3);
    for (Stack::Face& face : stack.faces) face.manifold.restitution = 0.3;
    stack.find_contacts();
    SoftBodies motion;
    SoftBlocks blocks(kernels);
    const SoftSettings settings;
    motion.start(stack.bodies, 1e-3);
    blocks.start(stack.bodies, stack.manifolds, settings, 1e-3);
    motion.set(0, stack.bodies);
    for (std::size_t k = 0; k < blocks.pack_pieces(); ++k)
      blocks.pack(k, stack.bodies, stack.manifolds, motion);
    ASSERT_EQ(blocks.runs(), 1u);
    for (int step = 0; step < 20; ++step) {
      motion.take_forces(0);
      if (step == 0) blocks.warm_start(motion, 0, 0);
      blocks.push(motion, 0, 0);
      motion.move(0);
      blocks.relax(motion, 0, 0);
    }
    blocks.bounce(motion, 0, 0);
    motion.finish(stack.bodies);
    std::vector<double> state;
    for (const SoftBody& body : stack.bodies) {
      state.insert(state.end(), body.v.data(), body.v.data() + 3);
      state.insert(state.end(), body.omega.data(), body.omega.data() + 3);
    }
    bits.push_back(state);
  }
  EXPECT_EQ(bits[0], bits[1]);
}

TEST(SoftStep, AllocatesNothingTheSecondTime) {
  if (!test::can_count_allocations()) GTEST_SKIP();
  Stack stack = wall(12);
  Team team(1);
  stack.step(team, {});
  const std::size_t before = test::allocations();
  stack.find_contacts();
  stack.solver.advance(stack.bodies, stack.manifolds, {}, kFrame, {}, team);
  EXPECT_EQ(test::allocations(), before);
}

TEST(SoftStep, KeepsWhatIsNotFiniteToThoseWhoTouchIt) {
  Stack stack = tower(1), other = tower(1);
  for (Stack* all : {&stack, &other})
    for (int k = 0; k < 8; ++k) all->rest(all->add(Vec3(3.0 * k + 3, 0, 0.5), 10), 0);
  stack.bodies[1].v.x() = std::numeric_limits<double>::quiet_NaN();
  stack.bodies[1].L.y() = std::numeric_limits<double>::infinity();
  Team team(1);
  for (int frame = 0; frame < 10; ++frame) {
    stack.step(team, {});
    other.step(team, {});
  }
  for (std::size_t k = 2; k < stack.bodies.size(); ++k) {
    EXPECT_EQ(stack.bodies[k].c, other.bodies[k].c);
    EXPECT_EQ(stack.bodies[k].v, other.bodies[k].v);
  }
}

TEST(SoftStep, SwingsAPendulumOnAJoint) {
  // A rod of 1 m on a joint at its end: T = 2π √(2 l / 3 g) for small swings.
  constexpr double kAngle = 0.02;
  std::vector<SoftBody> bodies = {still_body(Vec3::Zero()),
                                  box(Vec3::Zero(), Vec3(0.02, 0.02, 1), 1)};
  SoftBody& rod = bodies[1];
  rod.q = Quat(std::cos(kAngle / 2), 0, std::sin(kAngle / 2), 0);
  rod.c = rod.q * Vec3(0, 0, -0.5);
  PointJoint joint = {1, 0, Vec3::Zero()};
  SoftStep solver;
  SoftSettings settings;
  Team team(1);
  const double period = 2 * std::numbers::pi * std::sqrt(2 / (3 * kGravity));
  const int frames = static_cast<int>(std::lround(period / 1e-3));
  for (int frame = 0; frame < frames; ++frame) {
    const Vec3 end = rod.c + rod.q * Vec3(0, 0, 0.5);
    joint.point = 0.5 * end;
    joint.target = -(0.2 / 1e-3) * end;
    solver.advance(bodies, {}, std::span(&joint, 1), period / frames, settings, team);
    EXPECT_LT(end.norm(), 1e-5);
  }
  // First order in the sub-step, a quarter of a millisecond: ω h = 1e-3 of the swing.
  const double angle = 2 * std::atan2(rod.q.y(), rod.q.w());
  EXPECT_NEAR(angle, kAngle, 2e-3 * kAngle);
  EXPECT_NEAR(joint.impulse.z(), kGravity * period / frames / settings.steps, 1e-3);
}

}  // namespace
}  // namespace poinsot
