#include "poinsot/collision/box_tree.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "support/geometry.h"

namespace poinsot::test {
namespace {

using Pairs = std::vector<ColliderPair>;

std::vector<int> each_its_own(std::size_t n) {
  std::vector<int> group(n);
  std::iota(group.begin(), group.end(), 0);
  return group;
}

BoxTree tree_of(const std::vector<Aabb>& boxes) {
  BoxTree tree(each_its_own(boxes.size()));
  for (std::size_t i = 0; i < boxes.size(); ++i) tree.set(static_cast<int>(i), boxes[i]);
  return tree;
}

Pairs changed(BoxTree& tree) {
  Pairs pairs;
  tree.find_changed(pairs);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs brute_force(const std::vector<Aabb>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (boxes[i].overlaps(boxes[j])) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
  return pairs;
}

Aabb cube(const Vec3& centre, double size) {
  return {centre.array() - 0.5 * size, centre.array() + 0.5 * size};
}

std::vector<Aabb> random_boxes(Random& random, int n, double smallest, double largest,
                               double room) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3 half(random.log_uniform(smallest, largest), random.log_uniform(smallest, largest),
                    random.log_uniform(smallest, largest));
    const Vec3 centre = random.in_box(room);
    boxes.push_back({centre - half, centre + half});
  }
  return boxes;
}

TEST(BoxTree, FindsAllOverlapsOfRandomBoxesOfAllSizes) {
  Random random(1);
  for (const int n : {0, 1, 2, 3, 4, 5, 6, 9, 17, 64, 65, 700}) {
    const std::vector<Aabb> alike = random_boxes(random, n, 0.4, 0.6, 0.6 * std::cbrt(n));
    const std::vector<Aabb> mixed = random_boxes(random, n, 1e-3, 1e3, 500);
    for (const std::vector<Aabb>& boxes : {alike, mixed}) {
      BoxTree tree = tree_of(boxes);
      EXPECT_EQ(changed(tree), brute_force(boxes)) << n << " boxes";
      EXPECT_TRUE(changed(tree).empty()) << "nothing has changed since";
    }
  }
}

TEST(BoxTree, OfAFewChangedBoxesItFindsEachPairOnce) {
  Random random(2);
  std::vector<Aabb> boxes = random_boxes(random, 500, 0.2, 1, 5);
  BoxTree tree = tree_of(boxes);
  changed(tree);
  for (int round = 0; round < 200; ++round) {
    std::set<int> moved;
    for (int k = 0; k < 20; ++k) {
      const int i = random.below(500);
      boxes[static_cast<std::size_t>(i)] = cube(random.in_box(5), random.uniform(0.1, 2));
      tree.set(i, boxes[static_cast<std::size_t>(i)]);
      moved.insert(i);
    }
    Pairs expected;
    for (const ColliderPair& pair : brute_force(boxes))
      if (moved.count(pair.a) + moved.count(pair.b) > 0) expected.push_back(pair);
    ASSERT_EQ(changed(tree), expected) << "round " << round;
  }
}

TEST(BoxTree, BoxesOfOneGroupAndIdleOnesDoNotPair) {
  BoxTree tree(std::vector<int>{0, 0, 1, 2});
  for (int i = 0; i < 4; ++i) tree.set(i, cube(Vec3::Zero(), 1));
  EXPECT_EQ(changed(tree), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}));
  tree.set_idle(2, true);
  tree.set_idle(3, true);
  EXPECT_EQ(changed(tree), (Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}}));
}

// Single precision cannot tell these apart; the answer is that of the exact boxes.
TEST(BoxTree, TouchingBoxesOverlapAndBoxesANanometreApartDoNot) {
  for (const double far : {0.0, 1e5}) {
    std::vector<Aabb> boxes;
    double x = far;
    for (int k = 0; k < 40; ++k) {
      boxes.push_back({{x, far, far}, {x + 0.125, far + 1, far + 1}});
      x += 0.125 + (k % 2 ? 1e-9 : 0);
    }
    BoxTree tree = tree_of(boxes);
    EXPECT_EQ(changed(tree).size(), 20u);
  }
}

TEST(BoxTree, BoxesAllInOnePlaceArePairedEachWithEach) {
  for (const double size : {0.0, 1.0, 1e300}) {
    const std::vector<Aabb> boxes(100, cube(Vec3(1, 2, 3), size));
    BoxTree tree = tree_of(boxes);
    EXPECT_EQ(changed(tree).size(), 100u * 99 / 2) << size;
  }
}

// Each division parts off few: the deepest tree there can be.
TEST(BoxTree, PlacesAndSizesFromTheLeastToTheLargestNumberDoNoHarm) {
  std::vector<Aabb> boxes;
  for (int k = -1000; k < 1000; ++k) {
    const double x = std::ldexp(1.0, k);
    boxes.push_back({Vec3(x, 0, 0), Vec3(1.5 * x, 1, 1)});
    if (k % 10 == 0) boxes.push_back(cube(Vec3(0, 0, -x), x));
  }
  boxes.push_back(cube(Vec3::Zero(), std::numeric_limits<double>::max()));
  BoxTree tree = tree_of(boxes);
  EXPECT_EQ(changed(tree), brute_force(boxes));
  for (int i = 0; i < 300; ++i) tree.set(7 * i, boxes[static_cast<std::size_t>(7 * i)]);
  Pairs expected;
  for (const ColliderPair& pair : brute_force(boxes))
    if ((pair.a % 7 == 0 && pair.a < 2100) || (pair.b % 7 == 0 && pair.b < 2100))
      expected.push_back(pair);
  EXPECT_EQ(changed(tree), expected);
}

TEST(BoxTree, AnEmptyBoxMeetsNothingUntilItIsSetAgain) {
  std::vector<Aabb> boxes(10, cube(Vec3::Zero(), 1));
  boxes.push_back(cube(Vec3::Zero(), 1e300));
  BoxTree tree = tree_of(boxes);
  changed(tree);
  tree.set(3, Aabb{});
  EXPECT_TRUE(changed(tree).empty());
  tree.set(3, boxes[3]);
  EXPECT_EQ(changed(tree).size(), 10u);
}

TEST(BoxTree, ItIsBuiltAnewWhenBoxesWanderAndNotWhileTheyTremble) {
  Random random(4);
  std::vector<Aabb> boxes = random_boxes(random, 300, 0.4, 0.6, 4);
  BoxTree tree = tree_of(boxes);
  changed(tree);
  const std::size_t placed = tree.builds();
  const auto shift_all = [&](double by) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Vec3 way = by * random.direction();
      tree.set(static_cast<int>(i), {boxes[i].low + way, boxes[i].high + way});
    }
    return changed(tree);
  };
  for (int frame = 0; frame < 100; ++frame) shift_all(1e-6);
  EXPECT_EQ(tree.builds(), placed);
  for (int frame = 0; frame < 100; ++frame) shift_all(5);
  EXPECT_GT(tree.builds(), placed + 10);
}

}  // namespace
}  // namespace poinsot::test
