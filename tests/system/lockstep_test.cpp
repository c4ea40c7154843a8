// A controller in lock step with a daemon in another process: every frame has its input, and the
// tool can still ask for other things meanwhile.

#include <chrono>

#include <gtest/gtest.h>

#include "poinsot/client/client.h"
#include "support/test_domain.h"
#include "system/free_world.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

class LockStepped : public testing::Test {
 protected:
  LockStepped() {
    world_.start({});
    client_.wait_for_server(kPatience);
  }

  FreeWorld world_;
  Client client_{{.world = "free", .domain = test_domain()}};
};

TEST_F(LockStepped, EveryFrameHasItsOwnInput) {
  constexpr double kFrameRate = 60;  // [Hz]
  constexpr double kMass = 2;        // [kg]
  const Reply joined = client_.lock_step(kPatience, kPatience);
  ASSERT_EQ(joined.code, ResultCode::ok) << joined.message;
  std::uint64_t frame = joined.last_frame;
  double speed = 0;
  PoseSnapshot poses;
  while (client_.latest_poses(poses)) continue;
  for (int i = 1; i <= 30; ++i) {
    WrenchCommand command{.body_name = "probe", .force = Vec3(i, 0, 0)};
    const Reply pushed = client_.apply(command, kPatience);
    EXPECT_EQ(pushed.first_frame, frame + 1);
    const Reply advanced = client_.advance(kPatience);
    ASSERT_EQ(advanced.code, ResultCode::ok) << advanced.message;
    ASSERT_EQ(advanced.last_frame, ++frame);
    speed += i / kMass / kFrameRate;
    do ASSERT_TRUE(client_.next_poses(poses, kPatience));
    while (poses.frame < frame);
    EXPECT_NEAR(poses.bodies[0].linear_velocity.x(), speed, 1e-12 * speed);
  }
  // A report is a little behind; nothing goes on without an input.
  Json status;
  EXPECT_TRUE(eventually([&] {
    status = FreeWorld::json({"status"});
    return status["frame"] == frame;
  })) << status;
  EXPECT_EQ(status["late_inputs"], 0);
  // Without its input nothing goes on; without the member it does.
  client_.lock_step(0ns, kPatience);
  do ASSERT_TRUE(client_.next_poses(poses, kPatience));
  while (poses.frame < frame + 10);
}

TEST_F(LockStepped, AnInputThatDoesNotComeIsCountedAndTheRunGoesOn) {
  ASSERT_EQ(client_.lock_step(50ms, kPatience).code, ResultCode::ok);
  Json status;
  EXPECT_TRUE(eventually([&] {
    status = FreeWorld::json({"status"});
    return status["late_inputs"] > 2;
  }));
  bool is_member = false;
  for (const Json& client : status["clients"]) is_member |= client["lock_step"].get<bool>();
  EXPECT_TRUE(is_member) << status;
}

TEST_F(LockStepped, ATetherWhoseTargetMovesIsFollowed) {
  // A target that moves on by the same step every frame is followed at its speed, behind it by
  // what a critically damped spring lags: 2/ω times the speed.
  constexpr double kOmega = 20, kMass = 2, kSpeed = 0.3;  // [rad/s], [kg], [m/s]
  ASSERT_EQ(client_.lock_step(kPatience, kPatience).code, ResultCode::ok);
  WrenchCommand tether{.slot = 1, .body_name = "probe"};
  tether.kind = WrenchKind::tether;
  tether.hold = Hold::until_cleared;
  tether.stiffness = kMass * kOmega * kOmega;
  tether.damping = 2 * kMass * kOmega;
  PoseSnapshot poses;
  while (client_.latest_poses(poses)) continue;
  for (int i = 1; i <= 90; ++i) {
    tether.target = Vec3(kSpeed * i / 60, 0, 0);
    ASSERT_EQ(client_.apply(tether, kPatience).code, ResultCode::ok);
    const Reply advanced = client_.advance(kPatience);
    do ASSERT_TRUE(client_.next_poses(poses, kPatience));
    while (poses.frame < advanced.last_frame);
  }
  EXPECT_NEAR(poses.bodies[0].linear_velocity.x(), kSpeed, 0.05 * kSpeed);
  const double lag = tether.target.x() - poses.bodies[0].position.x();
  // The target stands still within a frame: half a frame's way to and fro.
  EXPECT_NEAR(lag, 2 / kOmega * kSpeed, kSpeed / 60);
  const Json pushes = FreeWorld::json({"pushes"});
  ASSERT_EQ(pushes["held"].size(), 1u) << "the same slot: one tether, moved";
  EXPECT_EQ(pushes["held"][0]["kind"], "tether");
}

}  // namespace
}  // namespace poinsot
