// What readers ask for by the name of their topic, and what is made only while somebody reads it.

#include <gtest/gtest.h>

#include "poinsot/client/client.h"
#include "poinsot/service/daemon.h"
#include "poinsot/wire/stream_name.h"
#include "poinsot/wire/subscriber.h"
#include "support/scene_builder.h"
#include "support/test_domain.h"

namespace poinsot {
namespace {

using namespace std::chrono_literals;

// Ten boxes that fly apart, one that stands on the floor.
Scene eleven_boxes(const std::string& world) {
  Scene scene = test::empty_scene(world);
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {test::floor(), test::box("crate", Vec3(0, 0, 0.5))};
  for (int i = 0; i < 10; ++i) {
    scene.bodies.push_back(test::box("box" + std::to_string(i), Vec3(3.0 * i, 5, 100)));
    scene.bodies.back().linear_velocity = Vec3(0, 0, 1.0 + i);
  }
  return scene;
}

class Streams : public testing::Test {
 protected:
  void start(const Scene& scene, DaemonOptions options = {}) {
    options.domain = test_domain();
    world_ = scene.world;
    logger_->set_level(spdlog::level::off);
    daemon_.emplace(scene, options, logger_, [] {});
    client_.emplace(ClientOptions{.world = world_, .domain = test_domain()});
    client_->wait_for_server(kPatience);
  }

  Reply control(RunControl control) {
    const Reply reply = client_->control(std::move(control), kPatience);
    EXPECT_EQ(reply.code, ResultCode::ok) << reply.message;
    return reply;
  }
  void step(std::uint64_t frames) { control({.action = ControlAction::step, .frames = frames}); }

  // The next sample of a topic.
  template <class Message>
  testing::AssertionResult next(Subscriber<Message>& topic, Message& message) {
    return eventually([&] { return topic.take(message); })
               ? testing::AssertionSuccess()
               : testing::AssertionFailure() << "nothing came";
  }

  const Logger logger_ = make_logger("test", spdlog::level::off, 0);
  std::string world_;
  std::optional<Daemon> daemon_;
  std::optional<Client> client_;
  Participant reader_{{.domain = test_domain()}};
};

TEST_F(Streams, APatternSelectsBodies) {
  start(eleven_boxes("pattern"));
  Subscriber<PoseSnapshot> some(reader_, world_, stream_suffix({.match = "box?"}));
  PoseSnapshot sample;
  ASSERT_TRUE(next(some, sample));
  EXPECT_EQ(sample.total, 10u);
  EXPECT_EQ(sample.bodies.size(), 10u);
  EXPECT_TRUE(sample.complete);
  for (std::uint64_t k = 1; k < 10; ++k) {
    const std::uint64_t before = sample.sequence;
    ASSERT_TRUE(next(some, sample));
    EXPECT_EQ(sample.sequence, before + 1);
  }
  EXPECT_EQ(client_->report(kPatience).streams, 1u);
}

TEST_F(Streams, OfAPausedRunAReaderGetsTheNewestFrameAtOnce) {
  start(eleven_boxes("still"), {.paused = true});
  step(7);
  Subscriber<PoseSnapshot> some(reader_, world_, stream_suffix({.match = "crate", .rate = 1}));
  PoseSnapshot sample;
  ASSERT_TRUE(next(some, sample));
  EXPECT_EQ(sample.frame, 7u);
  EXPECT_EQ(sample.bodies.size(), 1u);
  Subscriber<PoseSnapshot> later(reader_, world_, stream_suffix({.match = "crate", .rate = 1}));
  ASSERT_TRUE(next(later, sample));
  EXPECT_EQ(sample.frame, 7u);
}

TEST_F(Streams, WhatDoesNotMoveIsNotSentAgain) {
  start(eleven_boxes("change"), {.paused = true});
  Subscriber<PoseSnapshot> moved(reader_, world_, stream_suffix({.change = 1e-3}));
  PoseSnapshot sample;
  ASSERT_TRUE(next(moved, sample));
  EXPECT_EQ(sample.bodies.size(), 11u);
  step(1);
  ASSERT_TRUE(next(moved, sample));
  EXPECT_EQ(sample.frame, 1u);
  EXPECT_FALSE(sample.complete);
  EXPECT_EQ(sample.total, 11u);
  EXPECT_EQ(sample.bodies.size(), 10u);
}

TEST_F(Streams, ARateIsKept) {
  start(eleven_boxes("rate"));
  Subscriber<PoseSnapshot> slow(reader_, world_, stream_suffix({.rate = 10}));
  PoseSnapshot first, sample;
  ASSERT_TRUE(next(slow, first));
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(next(slow, sample));
  // 60 frames a second, every sixth: a frame early or late each time, later on a busy machine.
  EXPECT_GE(sample.frame - first.frame, 24u);
}

TEST_F(Streams, NonsenseIsNotWritten) {
  start(eleven_boxes("nonsense"));
  Subscriber<PoseSnapshot> nonsense(reader_, world_, "rate/0");
  Subscriber<PoseSnapshot> good(reader_, world_, stream_suffix({.match = "crate"}));
  PoseSnapshot sample;
  ASSERT_TRUE(next(good, sample));
  EXPECT_EQ(nonsense.writers(), 0);
}

TEST_F(Streams, EndWithTheirReaders) {
  start(eleven_boxes("leaving"));
  for (int k = 0; k < 20; ++k) {
    Subscriber<PoseSnapshot> some(reader_, world_, stream_suffix({.rate = 1.0 + k}));
    PoseSnapshot sample;
    ASSERT_TRUE(next(some, sample)) << k;
  }
  EXPECT_TRUE(eventually([&] { return client_->report(kPatience).streams == 0; }));
}

TEST_F(Streams, ContactsHoldABodyUp) {
  start(eleven_boxes("contacts"), {.paused = true});
  step(60);
  Subscriber<ContactSnapshot> contacts(reader_, world_);
  ContactSnapshot sample;
  ASSERT_TRUE(next(contacts, sample));  // although nothing moves
  EXPECT_EQ(sample.frame, 60u);
  Vec3 force = Vec3::Zero();
  for (const ContactState& contact : sample.contacts) force += contact.force;
  EXPECT_NEAR(force.z(), 2 * 9.81, 1e-6);
  step(1);
  ASSERT_TRUE(next(contacts, sample));
  EXPECT_EQ(sample.frame, 61u);
  EXPECT_EQ(sample.sequence, 2u);
}

TEST_F(Streams, WhatIsHeldIsTold) {
  start(eleven_boxes("held"), {.paused = true});
  Subscriber<HeldList> held(reader_, world_);
  HeldList list;
  ASSERT_TRUE(next(held, list));
  EXPECT_TRUE(list.items.empty());
  const Reply reply = client_->apply(
      {.slot = 3, .body_name = "box4", .force = Vec3(1, 2, 3), .hold = Hold::until_cleared},
      kPatience);
  ASSERT_EQ(reply.code, ResultCode::ok) << reply.message;
  ASSERT_TRUE(next(held, list));
  ASSERT_EQ(list.items.size(), 1u);
  EXPECT_EQ(list.items[0].slot, 3u);
  EXPECT_EQ(list.items[0].force, Vec3(1, 2, 3));
  EXPECT_EQ(list.items[0].client, reply.client);
  Participant other({.domain = test_domain()});
  Subscriber<HeldList> later(other, world_);
  ASSERT_TRUE(next(later, list));
  EXPECT_EQ(list.items.size(), 1u);
}

TEST_F(Streams, SpawnedAndRemovedBodiesReachTheScene) {
  start(eleven_boxes("scene"), {.paused = true});
  EXPECT_EQ(client_->scene(kPatience).size(), 12u);
  const Reply came = control(
      {.action = ControlAction::spawn,
       .text =
           "bodies:\n  - {name: late, shape: {sphere: 1}, density: 1, position: [0, 0, 50]}\n"});
  std::vector<BodyInfo> scene = client_->scene(kPatience);
  ASSERT_EQ(scene.size(), 13u);
  EXPECT_EQ(scene.back().name, "late");
  EXPECT_EQ(scene.back().id, came.body);
  control({.action = ControlAction::remove, .body_name = "box3"});
  scene = client_->scene(kPatience);
  EXPECT_EQ(scene.size(), 12u);
  for (const BodyInfo& body : scene) EXPECT_NE(body.name, "box3");
  Client late({.world = world_, .domain = test_domain()});
  late.wait_for_server(kPatience);
  EXPECT_EQ(late.scene(kPatience).size(), 12u);
}

}  // namespace
}  // namespace poinsot
