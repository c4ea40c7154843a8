#include "poinsot/runner/checkpoint_file.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "poinsot/base/archive.h"
#include "poinsot/base/error.h"
#include "poinsot/runner/build_identity.h"
#include "poinsot/runner/whole_file.h"
#include "poinsot/scene/scene_archive.h"
#include "support/scene_builder.h"
#include "support/temp_path.h"

namespace poinsot {
namespace {

Checkpoint sample() {
  Scene scene = test::scene({test::ground(), test::box("box", Vec3(0, 0, 1))});
  Checkpoint checkpoint{.name = "before-lunch",
                        .epoch = 3,
                        .frame = 1200,
                        .state_hash = 0x0123456789abcdef,
                        .scene = std::make_shared<const Scene>(std::move(scene)),
                        .state = {}};
  for (int k = 0; k < 77; ++k) checkpoint.state.push_back(static_cast<std::byte>(k * 7));
  return checkpoint;
}

std::vector<std::byte> scene_bytes(const Scene& scene) {
  ByteWriter out;
  out(scene);
  return out.take();
}

std::string fault_of(std::span<const std::byte> bytes) {
  try {
    checkpoint_from(bytes, "x.checkpoint");
  } catch (const Error& error) {
    return error.what();
  }
  return "no fault";
}

TEST(CheckpointFile, ComesBackAsItWas) {
  const Checkpoint before = sample();
  const auto file = test::temp_path("deep/er/lunch.checkpoint");
  write_checkpoint(file, before);
  const auto after = read_checkpoint(file);
  EXPECT_EQ(after->name, before.name);
  EXPECT_EQ(after->epoch, before.epoch);
  EXPECT_EQ(after->frame, before.frame);
  EXPECT_EQ(after->state_hash, before.state_hash);
  EXPECT_EQ(after->state, before.state);
  EXPECT_EQ(scene_bytes(*after->scene), scene_bytes(*before.scene));
}

TEST(CheckpointFile, IsReplacedAsAWholeAndLeavesNothingBeside) {
  const auto directory = test::temp_path("replaced");
  Checkpoint checkpoint = sample();
  write_checkpoint(directory / "a.checkpoint", checkpoint);
  checkpoint.frame = 1201;
  write_checkpoint(directory / "a.checkpoint", checkpoint);
  EXPECT_EQ(read_checkpoint(directory / "a.checkpoint")->frame, 1201u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory), {}), 1);
}

TEST(CheckpointFile, EveryCutIsRefused) {
  const std::vector<std::byte> bytes = checkpoint_bytes(sample());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_NE(fault_of(std::span(bytes).first(size)), "no fault") << size;
  EXPECT_EQ(fault_of({}), "x.checkpoint: is no checkpoint");
  EXPECT_EQ(fault_of(std::span(bytes).first(100)),
            "x.checkpoint: the checkpoint is damaged: it has 100 of " +
                std::to_string(bytes.size()) + " bytes");
}

TEST(CheckpointFile, EveryFlippedBitIsRefused) {
  std::vector<std::byte> bytes = checkpoint_bytes(sample());
  ASSERT_EQ(fault_of(bytes), "no fault");
  for (std::size_t k = 0; k < bytes.size(); ++k)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[k] ^= static_cast<std::byte>(1 << bit);
      ASSERT_NE(fault_of(bytes), "no fault") << "byte " << k << ", bit " << bit;
      bytes[k] ^= static_cast<std::byte>(1 << bit);
    }
  bytes.back() ^= std::byte{1};
  EXPECT_EQ(fault_of(bytes), "x.checkpoint: the checkpoint is damaged: its checksum is wrong");
}

TEST(CheckpointFile, BytesBehindItAreRefused) {
  std::vector<std::byte> bytes = checkpoint_bytes(sample());
  bytes.push_back(std::byte{0});
  EXPECT_NE(fault_of(bytes).find("is damaged"), std::string::npos);
}

TEST(CheckpointFile, WhatCannotBeReadIsNamed) {
  const auto no_file = test::temp_path("none.checkpoint");
  const auto link = test::temp_path("link.checkpoint");
  std::filesystem::create_symlink("/etc/passwd", link);
  for (const auto& file : {no_file, link, test::temp_path("")}) {
    try {
      read_checkpoint(file);
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": cannot be read: ", 0), 0u)
          << error.what();
    }
  }
}

TEST(CheckpointFile, WhatCannotBeWrittenIsNamed) {
  EXPECT_THROW(write_checkpoint("/proc/none/a.checkpoint", sample()), std::runtime_error);
}

TEST(BuildIdentity, NamesVersionCompilerAndTheLinkersHash) {
  EXPECT_EQ(build_identity(), build_identity());
  const std::string hash = build_identity().substr(build_identity().rfind(' ') + 1);
  EXPECT_EQ(hash.size(), 40u) << build_identity();
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace
}  // namespace poinsot
