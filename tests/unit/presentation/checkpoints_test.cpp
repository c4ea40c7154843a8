// Saving and restoring a run: the ring, the bytes, and that it goes on bit for bit.

#include <gtest/gtest.h>

#include "poinsot/base/error.h"
#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

std::shared_ptr<Checkpoint> named(const std::string& name) {
  auto checkpoint = std::make_shared<Checkpoint>();
  checkpoint->name = name;
  return checkpoint;
}

TEST(CheckpointRing, KeepsTheLastSixteenByName) {
  CheckpointRing ring;
  EXPECT_EQ(ring.newest(), nullptr);
  for (int n = 0; n < 20; ++n) ring.add(named(std::string("c").append(std::to_string(n))));
  EXPECT_EQ(ring.size(), 16u);
  EXPECT_EQ(ring.find("c3"), nullptr);
  EXPECT_EQ(ring.find("c4")->name, "c4");
  EXPECT_EQ(ring.newest()->name, "c19");
  EXPECT_EQ(ring.names().front(), "c4");
}

TEST(CheckpointRing, OneOfTheSameNameReplacesAndIsTheNewest) {
  CheckpointRing ring;
  for (const char* name : {"a", "b", "c"}) ring.add(named(name));
  const auto again = named("a");
  ring.add(again);
  EXPECT_EQ(ring.size(), 3u);
  EXPECT_EQ(ring.find("a"), again);
  EXPECT_EQ(ring.newest(), again);
}

// Boxes that fall, collide, are pushed and pulled; a spring; a wrench of the scene to come.
Scene busy_scene() {
  Scene scene = test::empty_scene();
  scene.simulation.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {test::floor(), test::box("a", Vec3(0, 0, 0.8)), test::box("b", Vec3(0.2, 0, 2)),
                  test::box("c", Vec3(4, 0, 2)), test::box("d", Vec3(6, 0, 2))};
  scene.bodies[3].angular_velocity = Vec3(0.3, 1, 0.2);
  SpringDef spring;
  spring.a = "c";
  spring.b = "d";
  spring.stiffness = 30;
  spring.damping = 1;
  scene.springs = {spring};
  WrenchDef wrench;
  wrench.body = "b";
  wrench.force = Vec3(3, 0, 0);
  wrench.start = 0.9;
  scene.wrenches = {wrench};
  return scene;
}

void disturb(PresentationLayer& layer) {
  test::accept(layer, test::held_push(1, 1, "a", {4, 0, 0}));
  test::accept(layer, test::tether(2, 1, "d", {6, 1, 2}));
  WrenchCommand later = test::impulse(3, 1, "c", {0, 2, 3});
  later.start_frame = 75;
  test::accept(layer, later);
}

TEST(Checkpoints, ContinueBitForBitWithThingsHeldAndPending) {
  PresentationLayer layer(busy_scene());
  disturb(layer);
  test::hashes(layer, 40);
  const Reply saved = layer.obey(test::order(ControlAction::save, "here"));
  ASSERT_EQ(saved.code, ResultCode::ok);
  EXPECT_EQ(saved.message, "here");
  const auto expected = test::hashes(layer, 120);
  const std::uint64_t impacts = layer.report().impacts_so_far;

  test::accept(layer, test::impulse(9, 1, "a", {30, 0, 30}));
  test::hashes(layer, 5);
  const Reply restored = layer.obey(test::order(ControlAction::restore, "here"));
  ASSERT_EQ(restored.code, ResultCode::ok) << restored.message;
  EXPECT_EQ(restored.epoch, 2u);
  EXPECT_EQ(restored.first_frame, 40u);
  EXPECT_EQ(restored.state_hash, saved.state_hash);
  EXPECT_EQ(layer.held_count(), 4u);
  EXPECT_EQ(test::hashes(layer, 120), expected);
  EXPECT_EQ(layer.report().impacts_so_far, impacts);
}

TEST(Checkpoints, ContinueInAnotherProcessOfTheSameScene) {
  PresentationLayer layer(busy_scene()), other(busy_scene());
  disturb(layer);
  test::hashes(layer, 33);
  const auto checkpoint = layer.make_checkpoint("x");
  const auto expected = test::hashes(layer, 100);
  Order order = test::order(ControlAction::restore, "x");
  order.checkpoint = checkpoint;
  ASSERT_EQ(other.obey(order).code, ResultCode::ok);
  EXPECT_EQ(test::hashes(other, 100), expected);
}

TEST(Checkpoints, HoldCommandsThatCameSinceTheLastFrame) {
  PresentationLayer layer(busy_scene());
  test::hashes(layer, 10);
  test::accept(layer, test::held_push(1, 1, "a", {4, 0, 0}));
  layer.obey(test::order(ControlAction::save, "x"));
  const auto expected = test::hashes(layer, 20);
  layer.obey(test::order(ControlAction::restore, "x"));
  const auto again = test::hashes(layer, 20);
  EXPECT_EQ(std::vector(again.begin() + 1, again.end()),
            std::vector(expected.begin() + 1, expected.end()));
}

TEST(Checkpoints, HoldBodiesThatCameAndWent) {
  PresentationLayer layer(busy_scene());
  disturb(layer);
  test::hashes(layer, 20);
  test::remove(layer, "b");
  test::spawn(layer, {test::box("new", Vec3(-4, 0, 3)), test::box("newer", Vec3(-4, 3, 3))});
  test::accept(layer, test::held_push(1, 2, "new", {1, 0, 0}));
  test::hashes(layer, 20);
  layer.obey(test::order(ControlAction::save, "x"));
  const auto expected = test::hashes(layer, 60);
  const std::uint32_t revision = layer.scene_revision();
  test::remove(layer, "newer");
  test::spawn(layer, {test::box("last", Vec3(-9, 0, 3))});
  test::reset(layer, 0);
  EXPECT_EQ(layer.scene_bodies(), 5u);
  EXPECT_EQ(layer.obey(test::order(ControlAction::restore, "x")).code, ResultCode::ok);
  EXPECT_EQ(layer.scene_bodies(), 6u);
  EXPECT_GT(layer.scene_revision(), revision);
  EXPECT_EQ(layer.scene().bodies[2].name, "new");
  EXPECT_EQ(test::hashes(layer, 60), expected);
}

TEST(Checkpoints, KnowWhatTheSceneWasAtTheStart) {
  PresentationLayer layer(busy_scene());
  test::hashes(layer, 5);
  test::spawn(layer, {test::box("new", Vec3(-4, 0, 3))});
  const auto checkpoint = layer.make_checkpoint("x");
  PresentationLayer other(*checkpoint->scene);  // which begins with what was spawned
  other.restore(*checkpoint);
  EXPECT_EQ(test::hashes(other, 20), test::hashes(layer, 20));
  test::reset(other, 0);
  test::reset(layer, 0);
  EXPECT_EQ(other.scene_bodies(), 5u);
  EXPECT_EQ(test::hashes(other, 20), test::hashes(layer, 20));
}

TEST(Checkpoints, AnEmptyNameIsFound) {
  PresentationLayer layer(busy_scene());
  test::hashes(layer, 7);
  EXPECT_EQ(layer.obey(test::order(ControlAction::save)).message, "frame-7");
  EXPECT_EQ(layer.checkpoints(), 1u);
  EXPECT_EQ(layer.last_saved()->name, "frame-7");
  EXPECT_EQ(layer.last_saved()->frame, 7u);
  test::hashes(layer, 7);
  EXPECT_EQ(layer.obey(test::order(ControlAction::restore)).first_frame, 7u);
}

TEST(Checkpoints, UnknownNamesAreAnsweredWithTheKnownOnes) {
  PresentationLayer layer(busy_scene());
  EXPECT_EQ(layer.obey(test::order(ControlAction::restore, "x")).code, ResultCode::not_found);
  for (const char* name : {"one", "two"}) layer.obey(test::order(ControlAction::save, name));
  const Reply reply = layer.obey(test::order(ControlAction::restore, "x"));
  EXPECT_EQ(reply.code, ResultCode::not_found);
  EXPECT_EQ(reply.message, "no checkpoint 'x' is in memory; there are one, two");
  EXPECT_EQ(layer.epoch(), 1u);
}

TEST(Checkpoints, NamesAreWords) {
  PresentationLayer layer(busy_scene());
  for (const std::string& name : {std::string(".x"), std::string("a/b"), std::string("a b"),
                                  std::string(65, 'x'), std::string("ä")})
    EXPECT_EQ(layer.obey(test::order(ControlAction::save, name)).code, ResultCode::invalid_value)
        << name;
  EXPECT_EQ(layer.obey(test::order(ControlAction::save, "A-z_0.9")).code, ResultCode::ok);
  EXPECT_EQ(layer.checkpoints(), 1u);
}

TEST(Checkpoints, SavingChangesNothing) {
  PresentationLayer with(busy_scene()), without(busy_scene());
  disturb(with);
  disturb(without);
  for (int n = 0; n < 30; ++n) {
    with.obey(test::order(ControlAction::save));
    EXPECT_EQ(test::hashes(with, 1), test::hashes(without, 1));
  }
  EXPECT_EQ(with.checkpoints(), 16u);
}

TEST(Checkpoints, DamagedOnesAreRefusedAndLeaveTheRunAsItWas) {
  PresentationLayer layer(busy_scene());
  disturb(layer);
  test::hashes(layer, 30);
  test::spawn(layer, {test::box("new", Vec3(-4, 0, 3))});
  const Checkpoint good = *layer.make_checkpoint("x");
  PresentationLayer control(busy_scene());
  control.restore(good);
  const std::uint64_t hash = layer.snapshot().state_hash;
  const auto refused = [&](const Checkpoint& bad) {
    EXPECT_THROW(layer.restore(bad), Error);
    EXPECT_EQ(layer.epoch(), 1u);
    EXPECT_EQ(layer.snapshot().state_hash, hash);
  };
  for (std::size_t size = 0; size < good.state.size(); size += 1 + good.state.size() / 50) {
    Checkpoint cut = good;
    cut.state.resize(size);
    refused(cut);
  }
  Checkpoint other = good;
  other.state.push_back(std::byte{0});
  refused(other);
  other = good;
  other.scene = nullptr;
  refused(other);
  other = good;
  ++other.state_hash;
  refused(other);
  Order order = test::order(ControlAction::restore);
  order.checkpoint = std::make_shared<const Checkpoint>(other);
  EXPECT_EQ(layer.obey(order).code, ResultCode::operation_failed);
  EXPECT_EQ(test::hashes(layer, 30), test::hashes(control, 30));
}

TEST(Checkpoints, AHashIsOfTheStateAndNotOfTheEpoch) {
  PresentationLayer layer(busy_scene());
  const std::uint64_t fresh = layer.snapshot().state_hash;
  layer.obey(test::order(ControlAction::save, "x"));
  for (int n = 0; n < 3; ++n) {
    layer.obey(test::order(ControlAction::restore, "x"));
    EXPECT_EQ(layer.snapshot().state_hash, fresh);
  }
  EXPECT_EQ(layer.epoch(), 4u);
}

}  // namespace
}  // namespace poinsot
