// A run that goes on from a checkpoint is the run that was saved, in every bit.

#include <random>

#include <gtest/gtest.h>

#include "poinsot/base/archive.h"
#include "support/checkpoint_scenes.h"
#include "support/run.h"

namespace poinsot {
namespace {

using test::CheckpointScene;
using Bytes = std::vector<std::byte>;

std::uint64_t fingerprint(const CollisionLayer& layer) {
  Hash64 hash;
  const StateArray& y = layer.world().y;
  hash.add({y.data(), static_cast<std::size_t>(y.size())});
  layer.hash_into(hash);
  return hash.value();
}

Bytes saved(const CollisionLayer& layer) {
  ByteWriter out;
  layer.save(out);
  return out.take();
}

void restore(CollisionLayer& layer, const Bytes& bytes) {
  ByteReader in(bytes);
  layer.restore(in);
  EXPECT_EQ(in.left(), 0u);
}

void frame(const CheckpointScene& of, CollisionLayer& layer, int n) {
  if (of.act) of.act(layer, n);
  layer.advance_to(n / test::kFrameRate);
}

CollisionLayer layer_of(const CheckpointScene& of, int threads) {
  Scene scene = of.scene;
  scene.collision.threads = threads;
  return CollisionLayer(scene);
}

// Frames at which states are saved, and with how many threads they go on.
struct SavedFrame {
  int n, threads;
};
std::vector<SavedFrame> saved_frames(const CheckpointScene& of) {
  return {{0, 1}, {1, 2}, {of.last / 3, 1}, {of.last / 2, 2}, {of.last - 3, 2}, {of.last, 1}};
}

class Checkpoint : public testing::TestWithParam<CheckpointScene> {};

TEST_P(Checkpoint, ARunGoesOnFromItInEveryBit) {
  const CheckpointScene& of = GetParam();
  CollisionLayer whole = layer_of(of, 1);
  std::vector<std::uint64_t> hashes;
  std::vector<Bytes> states;
  for (int n = 0; n <= of.last + of.on; ++n) {
    if (n > 0) frame(of, whole, n);
    hashes.push_back(fingerprint(whole));
    states.push_back(saved(whole));
  }
  for (const auto& [from, threads] : saved_frames(of)) {
    SCOPED_TRACE("from frame " + std::to_string(from) + ", threads " + std::to_string(threads));
    CollisionLayer layer = layer_of(of, threads);
    restore(layer, states[static_cast<std::size_t>(from)]);
    for (int n = from; n <= from + of.on; ++n) {
      if (n > from) frame(of, layer, n);
      ASSERT_EQ(fingerprint(layer), hashes[static_cast<std::size_t>(n)]) << "frame " << n;
      ASSERT_TRUE(saved(layer) == states[static_cast<std::size_t>(n)]) << "frame " << n;
    }
  }
}

// Back to where it was before, in the layer that went on.
TEST_P(Checkpoint, ALayerThatWentOnGoesBack) {
  const CheckpointScene& of = GetParam();
  CollisionLayer layer = layer_of(of, 1);
  const int from = of.last / 2;
  for (int n = 1; n <= from; ++n) frame(of, layer, n);
  const Bytes before = saved(layer);
  for (int n = from + 1; n <= from + of.on / 2; ++n) frame(of, layer, n);
  const Bytes after = saved(layer);
  restore(layer, before);
  EXPECT_TRUE(saved(layer) == before);
  for (int n = from + 1; n <= from + of.on / 2; ++n) frame(of, layer, n);
  EXPECT_TRUE(saved(layer) == after);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Checkpoint, testing::ValuesIn(test::checkpoint_scenes()),
                         [](const auto& tested) { return tested.param.name; });

CheckpointScene scene_of(const std::string& name) {
  for (CheckpointScene& scene : test::checkpoint_scenes())
    if (scene.name == name) return scene;
  throw Error("no scene " + name);
}

TEST(CheckpointBytes, OfAnotherSceneAreAnError) {
  const CollisionLayer heap(scene_of("SoftHeap").scene);
  CollisionLayer balls(scene_of("Balls").scene);
  EXPECT_THROW(restore(balls, saved(heap)), Error);
}

TEST(CheckpointBytes, ThatEndTooEarlyAreAnError) {
  const CheckpointScene of = scene_of("Incline");
  CollisionLayer layer = layer_of(of, 1);
  for (int n = 1; n <= 60; ++n) frame(of, layer, n);
  const Bytes bytes = saved(layer);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    CollisionLayer fresh = layer_of(of, 1);
    ByteReader in(std::span<const std::byte>(bytes).first(size));
    EXPECT_THROW(fresh.restore(in), Error) << size;
  }
}

// Damaged bytes are an error, or another state: never the end of the process.
TEST(CheckpointBytes, ThatAreDamagedAreAnErrorOrAnotherState) {
  std::mt19937_64 random(3);
  for (const char* name : {"Incline", "FastColumns", "PushedHeap", "Tumbling", "StiffSprings"}) {
    const CheckpointScene of = scene_of(name);
    CollisionLayer layer = layer_of(of, 1);
    for (int n = 1; n <= 50; ++n) frame(of, layer, n);
    const Bytes bytes = saved(layer);
    int refused = 0;
    constexpr int kTimes = 200;
    for (int time = 0; time < kTimes; ++time) {
      Bytes damaged = bytes;
      for (int k = 0; k < 1 + time % 4; ++k)
        damaged[random() % damaged.size()] ^= std::byte(1u << random() % 8);
      CollisionLayer fresh = layer_of(of, 1);
      ByteReader in(damaged);
      try {
        fresh.restore(in);
        static_cast<void>(saved(fresh));
      } catch (const Error&) {
        ++refused;
      }
    }
    EXPECT_LT(refused, kTimes) << name;
  }
}

}  // namespace
}  // namespace poinsot
