// Held wrenches: slots, clears, quotas, what a client leaves behind, and what can be known of them.

#include <gtest/gtest.h>

#include "poinsot/presentation/held_wrenches.h"
#include "support/presentation.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene two_boxes() {
  Scene scene = test::empty_scene();
  scene.bodies = {test::box("box", Vec3(0, 0, 0)), test::box("crate", Vec3(5, 0, 0))};
  scene.bodies[0].mass_properties.center_of_mass = Vec3(0.1, 0, 0);
  return scene;
}

class HeldSlots : public testing::Test {
 protected:
  Reply accept(const WrenchCommand& command, std::uint64_t next = 1) {
    std::vector<Reply> replies;
    Suggestions suggestions;
    held_.accept({&command, 1}, layer_.world(), next, 1, suggestions, replies);
    return replies.at(0);
  }
  Reply accept_in_slot(WrenchCommand command, std::uint32_t slot, std::uint64_t next = 1,
                       std::uint64_t start = 0) {
    command.slot = slot;
    command.start_frame = start;
    return accept(command, next);
  }
  Vec3 force_in(std::uint64_t frame, std::size_t body = 0) {
    held_.apply_to(layer_, frame);
    return std::as_const(layer_).world().held[body].in_W.force;
  }
  std::uint64_t hash() const {
    Hash64 hash;
    held_.hash_into(hash);
    return hash.value();
  }
  HeldList list() const {
    HeldList list;
    held_.list(list, std::as_const(layer_).world());
    return list;
  }

  CollisionLayer layer_{two_boxes()};
  HeldWrenches held_{60};
};

WrenchCommand clear(std::uint64_t client, std::uint64_t seq, std::uint32_t slot = 0) {
  WrenchCommand command;
  command.client = client;
  command.seq = seq;
  command.slot = slot;
  command.hold = Hold::clear;
  return command;
}

TEST_F(HeldSlots, ACommandReplacesWhatItsClientHoldsInTheSlot) {
  accept_in_slot(test::held_push(1, 1, "box", {1, 0, 0}), 5);
  accept_in_slot(test::held_push(1, 2, "box", {2, 0, 0}), 5);
  EXPECT_EQ(held_.size(), 1u);
  EXPECT_EQ(force_in(1), Vec3(2, 0, 0));
  accept_in_slot(test::held_push(1, 3, "box", {4, 0, 0}), 5, 2);
  EXPECT_EQ(force_in(2), Vec3(4, 0, 0));
  EXPECT_EQ(held_.size(), 1u);
}

TEST_F(HeldSlots, AReplacementMayActOnAnotherBody) {
  accept_in_slot(test::held_push(1, 1, "box"), 5);
  EXPECT_EQ(force_in(1, 0), Vec3(1, 0, 0));
  accept_in_slot(test::held_push(1, 2, "crate"), 5, 2);
  EXPECT_EQ(force_in(2, 0), Vec3(0, 0, 0));
  EXPECT_EQ(force_in(2, 1), Vec3(1, 0, 0));
}

TEST_F(HeldSlots, SlotZeroReplacesNothingAndIsNotReplaced) {
  accept(test::held_push(1, 1, "box", {1, 0, 0}));
  accept(test::held_push(1, 2, "box", {2, 0, 0}));
  accept_in_slot(test::held_push(1, 3, "box", {4, 0, 0}), 5);
  EXPECT_EQ(force_in(1), Vec3(7, 0, 0));
}

TEST_F(HeldSlots, SlotsOfOtherClientsAreOtherSlots) {
  accept_in_slot(test::held_push(1, 1, "box", {1, 0, 0}), 5);
  accept_in_slot(test::held_push(2, 1, "box", {2, 0, 0}), 5);
  accept_in_slot(test::held_push(1, 2, "box", {4, 0, 0}), 6);
  EXPECT_EQ(force_in(1), Vec3(7, 0, 0));
}

TEST_F(HeldSlots, TheReplacedActsUntilTheReplacementBegins) {
  accept_in_slot(test::held_push(1, 1, "box", {1, 0, 0}), 5);
  accept_in_slot(test::held_push(1, 2, "box", {2, 0, 0}), 5, 1, 4);
  for (std::uint64_t frame = 1; frame < 8; ++frame)
    EXPECT_EQ(force_in(frame), Vec3(frame < 4 ? 1 : 2, 0, 0)) << frame;
}

TEST_F(HeldSlots, APlanInOneSlotIsFollowedAndACommandCutsItFromItsStartOn) {
  for (const std::uint64_t start : {2, 4, 6, 8})
    accept_in_slot(test::held_push(1, start, "box", {static_cast<double>(start), 0, 0}), 5, 1,
                   start);
  EXPECT_EQ(held_.size(), 4u);
  accept_in_slot(test::held_push(1, 9, "box", {-1, 0, 0}), 5, 1, 5);  // 6 and 8 never begin
  EXPECT_EQ(held_.size(), 3u);
  const double expected[] = {0, 2, 2, 4, -1, -1, -1, -1};
  for (std::uint64_t frame = 1; frame <= 8; ++frame)
    EXPECT_EQ(force_in(frame).x(), expected[frame - 1]) << frame;
}

TEST_F(HeldSlots, ARefusedCommandReplacesNothing) {
  accept_in_slot(test::held_push(1, 1), 5);
  WrenchCommand bad = test::held_push(1, 2, "bx");
  EXPECT_EQ(accept_in_slot(bad, 5).code, ResultCode::not_found);
  bad = test::held_push(1, 3);
  bad.force.x() = 1e13;
  EXPECT_EQ(accept_in_slot(bad, 5).code, ResultCode::invalid_value);
  EXPECT_EQ(force_in(1), Vec3(1, 0, 0));
}

TEST_F(HeldSlots, AClearNamesASlotABodyOrBoth) {
  accept_in_slot(test::held_push(1, 1, "box", {1, 0, 0}), 1);
  accept_in_slot(test::held_push(1, 2, "box", {2, 0, 0}), 2);
  accept_in_slot(test::held_push(1, 3, "crate", {4, 0, 0}), 3);
  WrenchCommand of_both = clear(1, 4, 3);
  of_both.body_name = "box";
  accept(of_both);  // nothing of slot 3 is on the box
  EXPECT_EQ(held_.size(), 3u);
  accept(clear(1, 5, 2));
  EXPECT_EQ(held_.size(), 2u);
  EXPECT_EQ(force_in(1, 0), Vec3(1, 0, 0));
  of_both.seq = 6;
  of_both.body_name = "crate";
  accept(of_both, 2);
  EXPECT_EQ(force_in(2, 1), Vec3(0, 0, 0));
  EXPECT_EQ(held_.size(), 1u);
}

TEST_F(HeldSlots, AClearOfAnotherClientsSlotEndsNothing) {
  accept_in_slot(test::held_push(1, 1), 5);
  EXPECT_EQ(accept(clear(2, 1, 5)).code, ResultCode::ok);
  EXPECT_EQ(held_.size(), 1u);
}

TEST_F(HeldSlots, AClientThatLeavesTakesWhatDoesNotOutliveIt) {
  accept(test::held_push(1, 1, "box", {1, 0, 0}));
  WrenchCommand stays = test::held_push(1, 2, "box", {2, 0, 0});
  stays.outlives_client = true;
  accept(stays);
  WrenchCommand later = test::held_push(1, 3, "box", {4, 0, 0});
  later.start_frame = 9;
  accept(later);
  accept(test::held_push(2, 1, "box", {8, 0, 0}));
  EXPECT_EQ(force_in(1), Vec3(11, 0, 0));
  held_.release(1, 2);
  EXPECT_EQ(force_in(2), Vec3(10, 0, 0));
  EXPECT_EQ(force_in(9), Vec3(10, 0, 0));
  EXPECT_EQ(held_.held_by(1), 1u);
  EXPECT_EQ(held_.size(), 2u);
  held_.release(99, 10);  // nobody
  EXPECT_EQ(held_.size(), 2u);
}

TEST_F(HeldSlots, AClientMayHoldSoManyAndNoMore) {
  for (std::uint64_t seq = 1; seq <= kMaxHeldPerClient; ++seq)
    ASSERT_EQ(accept_in_slot(test::held_push(1, seq), static_cast<std::uint32_t>(seq)).code,
              ResultCode::ok);
  const Reply reply = accept(test::held_push(1, 5000));
  EXPECT_EQ(reply.code, ResultCode::quota_exceeded);
  EXPECT_NE(reply.message.find("holds 4096 wrenches"), std::string::npos) << reply.message;
  EXPECT_EQ(held_.held_by(1), kMaxHeldPerClient);

  EXPECT_EQ(accept(test::held_push(2, 1)).code, ResultCode::ok);                // others may
  EXPECT_EQ(accept_in_slot(test::held_push(1, 5001), 7).code, ResultCode::ok);  // a replacement
  EXPECT_EQ(held_.held_by(1), kMaxHeldPerClient);
  // A replacement ahead of its time needs room until then.
  EXPECT_EQ(accept_in_slot(test::held_push(1, 5002), 7, 2, 9).code, ResultCode::quota_exceeded);
  accept(clear(1, 5003, 7), 2);
  EXPECT_EQ(accept(test::held_push(1, 5004), 2).code, ResultCode::ok);
  // What ends by itself makes room as well.
  accept(clear(1, 5005, 8), 2);
  EXPECT_EQ(accept(test::push(1, 5006), 2).code, ResultCode::ok);
  EXPECT_EQ(accept(test::push(1, 5007), 2).code, ResultCode::quota_exceeded);
  EXPECT_EQ(accept(test::push(1, 5008), 3).code, ResultCode::ok);
}

TEST_F(HeldSlots, TheSceneHasNoQuota) {
  for (std::uint64_t seq = 1; seq <= kMaxHeldPerClient + 1; ++seq)
    ASSERT_EQ(accept(test::held_push(0, seq)).code, ResultCode::ok);
}

TEST_F(HeldSlots, TheListTellsAllOfAnItemInTheOrderOfClients) {
  WrenchCommand later = test::tether(2, 1, "crate", {1, 2, 3});
  later.slot = 4;
  later.start_frame = 7;
  later.outlives_client = true;
  later.point = {0.5, 0, 0};
  later.point_frame = PointFrame::body;
  accept(later);
  WrenchCommand first = test::push(1, 9, "box", {1, 2, 3});
  first.torque = {4, 5, 6};
  first.axes = Axes::body;
  accept(first);
  const HeldList told = list();
  ASSERT_EQ(told.items.size(), 2u);
  EXPECT_EQ(told.left_out, 0u);
  EXPECT_EQ(told.items[0].client, 1u);
  EXPECT_EQ(told.items[0].seq, 9u);
  EXPECT_EQ(told.items[0].axes, Axes::body);
  EXPECT_EQ(told.items[0].force, Vec3(1, 2, 3));
  EXPECT_EQ(told.items[0].torque, Vec3(4, 5, 6));
  EXPECT_EQ(told.items[0].point_B, Vec3(0.1, 0, 0));  // the centre of mass
  EXPECT_EQ(told.items[0].last_frame, 1u);
  EXPECT_EQ(told.items[1].slot, 4u);
  EXPECT_EQ(told.items[1].body, layer_.world().ids[1]);
  EXPECT_EQ(told.items[1].kind, WrenchKind::tether);
  EXPECT_EQ(told.items[1].point_B, Vec3(0.5, 0, 0));
  EXPECT_EQ(told.items[1].target, Vec3(1, 2, 3));
  EXPECT_EQ(told.items[1].stiffness, 10);
  EXPECT_EQ(told.items[1].damping, 1);
  EXPECT_EQ(told.items[1].first_frame, 7u);
  EXPECT_EQ(told.items[1].last_frame, kForever);
  EXPECT_TRUE(told.items[1].outlives_client);
}

TEST_F(HeldSlots, TheListLeavesOutWhatIsTooMuchAndSaysHowMuch) {
  for (std::uint64_t client = 1; client <= 2; ++client)
    for (std::uint64_t seq = 1; seq <= 3000; ++seq) accept(test::held_push(client, seq));
  EXPECT_EQ(list().items.size(), kMaxListed);
  EXPECT_EQ(list().left_out, 6000 - kMaxListed);
}

TEST_F(HeldSlots, TheRevisionChangesWithTheListAndOnlyThen) {
  std::uint64_t last = held_.revision();
  const auto changed = [&] { return std::exchange(last, held_.revision()) != last; };
  accept(test::push(1, 1));
  EXPECT_TRUE(changed());
  accept(test::push(1, 2, "nobody"));
  accept(clear(2, 1));
  EXPECT_FALSE(changed());
  held_.apply_to(layer_, 1);
  EXPECT_FALSE(changed());
  held_.end_frame(1);  // the push is over
  EXPECT_TRUE(changed());
  EXPECT_TRUE(list().items.empty());
  held_.apply_to(layer_, 2);
  held_.end_frame(2);
  EXPECT_FALSE(changed());
  accept(test::held_push(1, 3), 3);
  changed();
  held_.release(1, 3);
  EXPECT_TRUE(changed());
}

TEST_F(HeldSlots, TheHashCoversEveryFieldOfWhatIsPending) {
  const std::vector<void (*)(WrenchCommand&)> changes = {
      [](auto& c) { c.client = 2; },
      [](auto& c) { c.seq = 2; },
      [](auto& c) { c.slot = 1; },
      [](auto& c) { c.body_name = "crate"; },
      [](auto& c) { c.kind = WrenchKind::impulse; },
      [](auto& c) { c.axes = Axes::body; },
      [](auto& c) { c.force.x() = 2; },
      [](auto& c) { c.torque.y() = 2; },
      [](auto& c) {
        c.point_frame = PointFrame::body;
        c.point.z() = 2;
      },
      [](auto& c) { c.start_frame = 6; },
      [](auto& c) {
        c.hold = Hold::duration;
        c.duration_ns = 100'000'000;
      },
      [](auto& c) { c.outlives_client = true; },
      [](auto& c) {
        c.kind = WrenchKind::tether;
        c.target.x() = 1;
      },
      [](auto& c) {
        c.kind = WrenchKind::tether;
        c.target.x() = 2;
      },
      [](auto& c) {
        c.kind = WrenchKind::tether;
        c.stiffness = 3;
      },
      [](auto& c) {
        c.kind = WrenchKind::tether;
        c.damping = 3;
      }};
  std::vector<std::uint64_t> seen = {hash()};
  const auto add = [&](const WrenchCommand& command) {
    held_ = HeldWrenches(60);
    accept(command);
    for (const std::uint64_t other : seen) EXPECT_NE(hash(), other) << seen.size();
    seen.push_back(hash());
  };
  WrenchCommand plain = test::push(1, 1);
  plain.start_frame = 5;
  add(plain);
  for (const auto change : changes) {
    WrenchCommand other = plain;
    change(other);
    add(other);
  }
}

TEST_F(HeldSlots, GoThroughBytesAndBack) {
  accept_in_slot(test::held_push(1, 1), 5);
  accept_in_slot(test::tether(2, 1, "crate"), 6, 1, 4);
  accept(test::impulse(0, 1));
  held_.apply_to(layer_, 1);
  held_.end_frame(1);
  ByteWriter out;
  held_.save(out);
  HeldWrenches copy(60);
  ByteReader in(out.bytes());
  copy.restore(in, 2);
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(copy.size(), held_.size());
  Hash64 hash_of_copy;
  copy.hash_into(hash_of_copy);
  EXPECT_EQ(hash_of_copy.value(), hash());

  for (std::size_t size = 0; size < out.bytes().size(); size += 7) {
    ByteReader cut(std::span(out.bytes()).first(size));
    HeldWrenches broken(60);
    EXPECT_THROW(broken.restore(cut, 2), Error) << size;
  }
  ByteReader again(out.bytes());
  HeldWrenches fewer(60);
  EXPECT_THROW(fewer.restore(again, 1), Error);  // the crate is column 1
}

}  // namespace
}  // namespace poinsot
