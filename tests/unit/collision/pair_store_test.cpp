#include "poinsot/collision/pair_store.h"

#include <gtest/gtest.h>

namespace poinsot {
namespace {

// Collider k belongs to body k / 2.
bool make(PairRecord& record) {
  record.a = record.pair.a / 2;
  record.b = record.pair.b / 2;
  return record.pair.b != 7;  // a pair with this collider does not collide
}

TEST(PairStore, KeepsWhatItKnowsOfPairsThatGoOn) {
  PairStore store(4);
  const std::vector<ColliderPair> first{{0, 2}, {0, 4}, {1, 6}, {1, 7}};
  store.update(first, make);
  ASSERT_EQ(store.records().size(), 3u);
  store[1].safe_until = 5;
  store.make_contact(store[1]);
  store.contact(store[1]).last_h = 0.1;
  const std::vector<ColliderPair> second{{0, 3}, {0, 4}, {2, 5}};
  store.update(second, make);
  ASSERT_EQ(store.records().size(), 3u);
  EXPECT_EQ(store[1].pair, (ColliderPair{0, 4}));
  EXPECT_EQ(store[1].safe_until, 5);
  EXPECT_EQ(store.contact(store[1]).last_h, 0.1);
  EXPECT_EQ(store.find({1, 6}), nullptr);
  EXPECT_EQ(store.find({0, 3}), &store[0]);
}

TEST(PairStore, ListsThePairsOfEachBody) {
  PairStore store(4);
  const std::vector<ColliderPair> pairs{{0, 2}, {0, 4}, {2, 4}, {3, 6}};
  store.update(pairs, make);
  const auto of = [&](Eigen::Index body) {
    return std::vector<int>(store.of(body).begin(), store.of(body).end());
  };
  EXPECT_EQ(of(0), (std::vector<int>{0, 1}));
  EXPECT_EQ(of(1), (std::vector<int>{0, 2, 3}));
  EXPECT_EQ(of(2), (std::vector<int>{1, 2}));
  EXPECT_EQ(of(3), (std::vector<int>{3}));
}

TEST(PairStore, GivesTheContactOfAPairThatEndedToAnotherWithoutItsPast) {
  PairStore store(4);
  const std::vector<ColliderPair> first{{0, 2}}, second{{0, 4}};
  store.update(first, make);
  store.make_contact(store[0]);
  store.contact(store[0]).points.resize(2);
  store.contact(store[0]).last_h = 0.1;
  store.update(second, make);
  store.make_contact(store[0]);
  EXPECT_TRUE(store.contact(store[0]).points.empty());
  EXPECT_EQ(store.contact(store[0]).last_h, 0);
}

TEST(PairStore, RenumbersCollidersAndKeepsWhatItKnows) {
  PairStore store(4);
  const std::vector<ColliderPair> pairs{{0, 2}, {0, 4}, {1, 6}, {4, 6}};
  store.update(pairs, make);
  store[1].safe_until = 5;
  store.insert_colliders(3, 2);
  EXPECT_EQ(store[0].pair, (ColliderPair{0, 2}));
  EXPECT_EQ(store[1].pair, (ColliderPair{0, 6}));
  EXPECT_EQ(store[1].safe_until, 5);
  EXPECT_EQ(store[3].pair, (ColliderPair{6, 8}));
  store.make_contact(store[2]);
  store.contact(store[2]).last_h = 0.1;
  store.erase_colliders(1, 2);  // with 0, 2 and 1, 8
  ASSERT_EQ(store.records().size(), 2u);
  EXPECT_EQ(store[0].pair, (ColliderPair{0, 4}));
  EXPECT_EQ(store[0].safe_until, 5);
  EXPECT_EQ(store[1].pair, (ColliderPair{4, 6}));
  EXPECT_EQ(store.of(0).size(), 1u);
  EXPECT_EQ(store.of(3).size(), 1u);
  store.make_contact(store[1]);
  EXPECT_EQ(store.contact(store[1]).last_h, 0);
}

TEST(PairStore, ForgetsAllOfAPairButWhoseItIs) {
  PairStore store(4);
  const std::vector<ColliderPair> pairs{{0, 2}};
  store.update(pairs, make);
  store[0].friction = 0.3;
  store[0].standing = true;
  store[0].safe_until = 5;
  store.make_contact(store[0]);
  store.forget(store[0]);
  EXPECT_EQ(store[0].pair, (ColliderPair{0, 2}));
  EXPECT_EQ(store[0].b, 1);
  EXPECT_EQ(store[0].friction, 0.3);
  EXPECT_FALSE(store[0].standing);
  EXPECT_LT(store[0].safe_until, 0);
  EXPECT_EQ(store.find_contact(store[0]), nullptr);
}

}  // namespace
}  // namespace poinsot
