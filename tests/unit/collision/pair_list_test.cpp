#include "poinsot/collision/pair_list.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "support/geometry.h"

namespace poinsot::test {
namespace {

ColliderPair random_pair(Random& random, int colliders) {
  const int a = random.below(colliders);
  const int b = (a + 1 + random.below(colliders - 1)) % colliders;
  return {std::min(a, b), std::max(a, b)};
}

bool equal(std::span<const ColliderPair> pairs, const std::set<ColliderPair>& expected) {
  return std::equal(pairs.begin(), pairs.end(), expected.begin(), expected.end());
}

// In an order of its own.
void fill(std::vector<ColliderPair>& found, const std::set<ColliderPair>& pairs, Random& random) {
  found.assign(pairs.begin(), pairs.end());
  for (std::size_t k = found.size(); k > 1; --k)
    std::swap(found[k - 1], found[static_cast<std::size_t>(random.below(static_cast<int>(k)))]);
}

TEST(PairList, SortsFewAndManyPairsInWhateverOrderTheyWereFound) {
  Random random(1);
  for (const int count : {0, 1, 2, 5, 100, 3000}) {
    PairList list(200);
    std::set<ColliderPair> pairs;
    for (int k = 0; k < count; ++k) pairs.insert(random_pair(random, 200));
    fill(list.found(), pairs, random);
    list.replace_all();
    EXPECT_TRUE(equal(list.pairs(), pairs)) << count;
    EXPECT_TRUE(list.found().empty());
  }
}

TEST(PairList, ThePairsOfThoseTouchedAreReplacedAndNoOthers) {
  constexpr int kColliders = 60;
  Random random(2);
  PairList list(kColliders);
  std::set<ColliderPair> pairs;
  for (int round = 0; round < 500; ++round) {
    std::vector<unsigned char> touched(kColliders, 0);
    for (int k = random.below(8); k > 0; --k)
      touched[static_cast<std::size_t>(random.below(kColliders))] = 1;
    const auto is_touched = [&](const ColliderPair& pair) {
      return touched[static_cast<std::size_t>(pair.a)] || touched[static_cast<std::size_t>(pair.b)];
    };
    std::erase_if(pairs, is_touched);
    std::set<ColliderPair> found;
    for (int k = 0; k < 200; ++k)
      if (const ColliderPair pair = random_pair(random, kColliders); is_touched(pair))
        found.insert(pair);
    fill(list.found(), found, random);
    list.replace_touched(touched);
    pairs.insert(found.begin(), found.end());
    ASSERT_TRUE(equal(list.pairs(), pairs)) << "round " << round;
  }
}

}  // namespace
}  // namespace poinsot::test
