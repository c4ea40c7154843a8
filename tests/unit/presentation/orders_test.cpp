// Controls that the physics has to know of: bodies are moved, a client is released.

#include <cmath>

#include <gtest/gtest.h>

#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

using test::floor_and_two;
using test::set_state;

TEST(Orders, AnswerWithTheFrameTheHashAndTheEpochReached) {
  PresentationLayer layer(floor_and_two());
  test::hashes(layer, 3);
  Order order = test::order(ControlAction::release);
  order.control.client = 12;
  order.control.seq = 34;
  const Reply reply = layer.obey(order);
  EXPECT_EQ(reply.code, ResultCode::ok);
  EXPECT_EQ(reply.client, 12u);
  EXPECT_EQ(reply.seq, 34u);
  EXPECT_EQ(reply.epoch, 1u);
  EXPECT_EQ(reply.first_frame, 3u);
  EXPECT_EQ(reply.last_frame, 3u);
  EXPECT_EQ(reply.state_hash, layer.snapshot().state_hash);
}

TEST(Orders, OfAnotherEpochOrOfTheLoopAreRefused) {
  PresentationLayer layer(floor_and_two());
  Order order = test::order(ControlAction::reset);
  order.control.epoch = 2;
  EXPECT_EQ(layer.obey(order).code, ResultCode::wrong_epoch);
  EXPECT_EQ(layer.obey(test::order(ControlAction::pause)).code, ResultCode::feature_unsupported);
  EXPECT_EQ(layer.epoch(), 1u);
}

TEST(Orders, AFloodOfMisspeltNamesIsAnsweredWithFewSuggestionsPerTurn) {
  PresentationLayer layer(floor_and_two());
  const auto suggested = [&] {
    int count = 0;
    for (int n = 0; n < 64; ++n) {
      count += test::remove(layer, "flor").message.find("did you mean") != std::string::npos;
      count += test::accept(layer, test::push(1, 1, "flor")).message.find("did you mean") !=
               std::string::npos;
    }
    return count;
  };
  EXPECT_EQ(suggested(), 8);
  EXPECT_EQ(suggested(), 0);
  layer.begin_turn();  // while the run is paused
  EXPECT_EQ(suggested(), 8);
  layer.advance_frame();
  EXPECT_EQ(suggested(), 8);
}

TEST(Orders, AClientMaySaveUnderNoNameOfAnAutosave) {
  PresentationLayer layer(floor_and_two());
  EXPECT_EQ(layer.obey(test::order(ControlAction::save, "auto-7")).code, ResultCode::invalid_value);
  EXPECT_EQ(layer.obey(test::order(ControlAction::save, "auto-x")).code, ResultCode::ok);
  EXPECT_EQ(layer.checkpoints(), 1u);
}

// Set ---------------------------------------------------------------------------------------------

TEST(SetState, MovesABodyAndWhatIsNotSetStays) {
  PresentationLayer layer(floor_and_two());
  test::hashes(layer, 2);
  Order order = set_state("b");
  order.control.sets_position = true;
  order.control.position = Vec3(5, 6, 7);
  EXPECT_EQ(layer.obey(order).body, (BodyId{2, 1}));
  EXPECT_LT((layer.snapshot().bodies[1].position - Vec3(5, 6, 7)).norm(), 1e-15);
  EXPECT_EQ(layer.snapshot().bodies[1].linear_velocity, Vec3(0, 0, 0));

  order = set_state("b");
  order.control.sets_orientation = order.control.sets_angular = true;
  order.control.orientation = Quat(Eigen::AngleAxisd(1, Vec3::UnitZ()));
  order.control.angular_velocity = Vec3(0, 0, 2);
  EXPECT_EQ(layer.obey(order).code, ResultCode::ok);
  const BodyState& b = layer.snapshot().bodies[1];
  EXPECT_LT((b.position - Vec3(5, 6, 7)).norm(), 1e-15);  // of the origin, not of the centre
  EXPECT_LT(b.orientation.angularDistance(order.control.orientation), 1e-15);
  EXPECT_LT((b.angular_velocity - Vec3(0, 0, 2)).norm(), 1e-15);

  order = set_state("b");
  order.control.sets_linear = true;
  order.control.linear_velocity = Vec3(0, 60, 0);
  layer.obey(order);
  EXPECT_LT((layer.snapshot().bodies[1].angular_velocity - Vec3(0, 0, 2)).norm(), 1e-14);
  const Vec3 before = position(layer.world().y, 2);
  layer.advance_frame();
  EXPECT_LT((position(layer.world().y, 2) - before - Vec3(0, 1, 0)).norm(), 1e-14);
}

TEST(SetState, AStaticBodyHasAPoseAndNoVelocity) {
  PresentationLayer layer(floor_and_two());
  Order order = set_state("floor");
  order.control.sets_linear = true;
  EXPECT_EQ(layer.obey(order).code, ResultCode::invalid_value);
  order = set_state("floor");
  order.control.sets_position = true;
  order.control.position = Vec3(0, 0, -1);
  EXPECT_EQ(layer.obey(order).code, ResultCode::ok);
  EXPECT_EQ(layer.scene().bodies[0].pose.c, Vec3(0, 0, -1));
  EXPECT_EQ(layer.scene_revision(), 2u);  // who shows the scene must know
}

TEST(SetState, LeavesTheCoursesOfOthersAlone) {
  PresentationLayer with(floor_and_two()), without(floor_and_two());
  Order order = set_state("a");
  order.control.sets_angular = true;
  order.control.angular_velocity = Vec3(1, 2, 3);
  test::hashes(with, 3);
  test::hashes(without, 3);
  with.obey(order);
  test::hashes(with, 9);
  test::hashes(without, 9);
  EXPECT_EQ(with.world().y.col(2), without.world().y.col(2));
}

TEST(SetState, RefusesWhatIsNoState) {
  PresentationLayer layer(floor_and_two());
  const std::uint64_t hash = layer.snapshot().state_hash;
  const auto refused = [&](auto&& spoil) {
    Order order = set_state("a");
    spoil(order.control);
    const Reply reply = layer.obey(order);
    EXPECT_NE(reply.message, "");
    EXPECT_EQ(layer.snapshot().state_hash, hash);
    return reply.code;
  };
  EXPECT_EQ(refused([](RunControl&) {}), ResultCode::invalid_value);
  EXPECT_EQ(refused([](RunControl& c) {
              c.sets_position = true;
              c.position.x() = NAN;
            }),
            ResultCode::invalid_value);
  EXPECT_EQ(refused([](RunControl& c) {
              c.sets_linear = true;
              c.linear_velocity.x() = 2e9;
            }),
            ResultCode::invalid_value);
  EXPECT_EQ(refused([](RunControl& c) {
              c.sets_angular = true;
              c.angular_velocity.x() = HUGE_VAL;
            }),
            ResultCode::invalid_value);
  EXPECT_EQ(refused([](RunControl& c) {
              c.sets_orientation = true;
              c.orientation.w() = 1.1;
            }),
            ResultCode::invalid_value);
  EXPECT_EQ(refused([](RunControl& c) {
              c.sets_linear = true;
              c.body_name = "aa";
            }),
            ResultCode::not_found);
}

TEST(SetState, WakesWhatSleeps) {
  Scene scene = floor_and_two();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  PresentationLayer layer(scene);
  test::hashes(layer, 300);
  ASSERT_EQ(layer.report().asleep, 2u);
  Order order = set_state("floor");  // from under them
  order.control.sets_position = true;
  order.control.position = Vec3(0, 0, -3);
  layer.obey(order);
  test::hashes(layer, 20);
  EXPECT_LT(layer.snapshot().bodies[0].position.z(), 0.2);
}

TEST(SetState, OfASleepingBodyIsInTheSnapshotAtOnce) {
  Scene scene = floor_and_two();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  PresentationLayer layer(scene);
  test::hashes(layer, 300);
  ASSERT_EQ(layer.report().asleep, 2u);
  const std::uint64_t hash = layer.snapshot().state_hash;
  Order order = set_state("a");
  order.control.sets_position = true;
  order.control.position = Vec3(-2, 1, 5);
  layer.obey(order);
  EXPECT_EQ(layer.snapshot().bodies[0].position, Vec3(-2, 1, 5));
  EXPECT_NE(layer.snapshot().state_hash, hash);
  test::hashes(layer, 10);
  EXPECT_LT(layer.snapshot().bodies[0].position.z(), 5.0);
}

TEST(SetState, FreesAFrozenBody) {
  Scene scene = floor_and_two();
  scene.bodies[1].linear_velocity = Vec3(1e200, 0, -1e200);
  PresentationLayer layer(scene);
  test::hashes(layer, 2);
  ASSERT_EQ(test::accept(layer, test::push(1, 1, "a")).code, ResultCode::incorrect_state);
  Order order = set_state("a");
  order.control.sets_position = true;
  order.control.position = Vec3(-2, 1, 5);
  EXPECT_EQ(layer.obey(order).code, ResultCode::ok);
  EXPECT_EQ(test::accept(layer, test::push(1, 2, "a")).code, ResultCode::ok);
}

TEST(SetState, AThawedBodyHasItsTetherAgain) {
  Scene scene = floor_and_two();
  scene.bodies[1].linear_velocity = Vec3(1e200, 0, -1e200);
  PresentationLayer layer(scene);
  test::accept(layer, test::tether(1, 1, "a", Vec3(0, 0, 3)));
  test::hashes(layer, 2);
  ASSERT_EQ(layer.world().motion[1], Motion::frozen);
  test::accept(layer, test::tether(1, 2, "b", Vec3(3, 0, 3)));  // the layer lays all anew
  test::hashes(layer, 2);
  ASSERT_EQ(layer.world().tethers.size(), 1u);
  Order order = set_state("a");
  order.control.sets_position = order.control.sets_linear = true;
  order.control.position = Vec3(-2, 0, 3);
  ASSERT_EQ(layer.obey(order).code, ResultCode::ok);
  test::hashes(layer, 5);
  EXPECT_EQ(layer.world().tethers.size(), 2u);
  EXPECT_GT(layer.snapshot().bodies[0].linear_velocity.x(), 0.1);
}

// Release -----------------------------------------------------------------------------------------

TEST(Release, EndsWhatTheClientHoldsFromTheNextFrameOn) {
  PresentationLayer layer(floor_and_two());
  test::accept(layer, test::held_push(3, 1, "a", {6, 0, 0}));
  WrenchCommand stays = test::held_push(3, 2, "b", {6, 0, 0});
  stays.outlives_client = true;
  test::accept(layer, stays);
  test::hashes(layer, 5);
  EXPECT_EQ(layer.obey(test::order(ControlAction::release)).code, ResultCode::ok);
  EXPECT_EQ(layer.held_by(3), 1u);
  test::hashes(layer, 5);
  EXPECT_NEAR(layer.snapshot().bodies[0].linear_velocity.x(), 3.0 * 5 / 60, 1e-15);
  EXPECT_NEAR(layer.snapshot().bodies[1].linear_velocity.x(), 3.0 * 10 / 60, 1e-15);
}

// Contacts and what is held -----------------------------------------------------------------------

TEST(PresentationLayer, ContactsCarryTheWeightOfWhatRests) {
  Scene scene = floor_and_two();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  PresentationLayer layer(scene);
  test::hashes(layer, 200);
  ContactSnapshot contacts;
  layer.contacts(contacts);
  EXPECT_EQ(contacts.epoch, 1u);
  EXPECT_EQ(contacts.frame, 200u);
  EXPECT_EQ(contacts.sim_time_ns, layer.snapshot().sim_time_ns);
  EXPECT_EQ(contacts.left_out, 0u);
  ASSERT_GT(contacts.contacts.size(), 0u);
  Vec3 on_a = Vec3::Zero();
  for (const ContactState& contact : contacts.contacts) {
    EXPECT_EQ(contact.point.z() < 1e-3 && contact.point.z() > -1e-3, true);
    if (contact.a == BodyId{1, 1}) on_a += contact.force;
    if (contact.b == BodyId{1, 1}) on_a -= contact.force;
  }
  EXPECT_LT((on_a - Vec3(0, 0, 2 * 9.81)).norm(), 1e-4);
}

TEST(PresentationLayer, TellsWhatIsHeldByWhom) {
  PresentationLayer layer(floor_and_two());
  const std::uint64_t before = layer.held_revision();
  test::accept(layer, test::held_push(5, 1, "a"));
  EXPECT_NE(layer.held_revision(), before);
  HeldList list;
  layer.held(list);
  EXPECT_EQ(list.epoch, 1u);
  ASSERT_EQ(list.items.size(), 1u);
  EXPECT_EQ(list.items[0].client, 5u);
  EXPECT_EQ(layer.held_by(5), 1u);
  EXPECT_EQ(layer.held_by(6), 0u);
}

}  // namespace
}  // namespace poinsot
