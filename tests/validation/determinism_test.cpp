// The same scene gives the same bits.

#include <gtest/gtest.h>

#include "support/run.h"
#include "support/scene_builder.h"

namespace poinsot {
namespace {

Scene heap() {
  std::vector<BodyDef> bodies = {test::ground()};
  const std::vector<Shape> shapes = {Box{{0.5, 0.4, 0.3}}, Sphere{0.2},
                                     Cylinder{0.2, 0.4},   Capsule{0.15, 0.3},
                                     Cone{0.2, 0.4},       Ellipsoid{{0.2, 0.25, 0.3}}};
  for (int i = 0; i < 48; ++i) {
    BodyDef def = test::body("body" + std::to_string(i), shapes[static_cast<std::size_t>(i) % 6],
                             {0.55 * (i % 4), 0.55 * (i / 4 % 4), 0.5 + 0.7 * (i / 16)});
    def.pose.q = Quat(1, 0.05 * (i % 3), 0.04 * (i % 5), 0.03 * (i % 7)).normalized();
    bodies.push_back(def);
  }
  return test::scene(std::move(bodies));
}

std::uint64_t fingerprint(const CollisionLayer& layer) {
  Hash64 hash;
  hash.add({layer.world().y.data(), static_cast<std::size_t>(layer.world().y.size())});
  layer.hash_into(hash);
  return hash.value();
}

TEST(Determinism, TwoRunsOfAHeapAgreeInEveryBitOfEveryFrame) {
  CollisionLayer first(heap()), second(heap());
  for (int n = 1; n <= 180; ++n) {
    first.advance_to(n / 60.0);
    second.advance_to(n / 60.0);
    ASSERT_EQ(fingerprint(first), fingerprint(second)) << "frame " << n;
  }
}

// A pile of columns: several islands, impacts, contacts that last, and sleep.
Scene pile(int threads, bool sleeping) {
  std::vector<BodyDef> bodies = {test::ground()};
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      for (int z = 0; z < 4; ++z)
        bodies.push_back(test::body("box" + std::to_string(bodies.size()), Box{{1, 1, 1}},
                                    {1.5 * x + 0.01 * z, 1.5 * y - 0.01 * z, 0.6 + 1.1 * z}));
  Scene scene = test::scene(std::move(bodies));
  scene.collision.threads = threads;
  scene.collision.sleeping = sleeping;
  return scene;
}

TEST(Determinism, OneThreadAndTwoAgreeInEveryBitOfAThousandFrames) {
  for (const bool sleeping : {true, false}) {
    CollisionLayer one(pile(1, sleeping)), two(pile(2, sleeping));
    for (int n = 1; n <= 1000; ++n) {
      one.advance_to(n / 60.0);
      two.advance_to(n / 60.0);
      ASSERT_EQ(fingerprint(one), fingerprint(two)) << "frame " << n << ", sleeping " << sleeping;
    }
    EXPECT_EQ(one.report().asleep, sleeping ? 36u : 0u);
  }
}

TEST(Determinism, ABystanderFarAwayDoesNotChangeTheHeap) {
  Scene with = heap();
  with.bodies.push_back(test::body("bystander", Sphere{1}, {1000, 0, 50}));
  CollisionLayer first(heap()), second(with);
  test::run_until(first, 1);
  test::run_until(second, 1);
  const Eigen::Index n = first.world().size();
  EXPECT_EQ(first.world().y, second.world().y.leftCols(n));
}

}  // namespace
}  // namespace poinsot
