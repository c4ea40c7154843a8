#include "poinsot/runner/checkpoint_file.h"

#include <array>
#include <cstdint>
#include <cstring>

#include "poinsot/base/archive.h"
#include "poinsot/base/error.h"
#include "poinsot/base/hash.h"
#include "poinsot/runner/build_identity.h"
#include "poinsot/runner/whole_file.h"
#include "poinsot/scene/scene_archive.h"

namespace poinsot {
namespace {

// Before what the archive writes: what it is, and how long. Behind it: the checksum.
struct Head {
  std::array<char, 12> magic = {'p', 'o', 'i', 'n', 's', 'o', 't', ' ', 'c', 'h', 'k', '\n'};
  std::uint32_t format = 1;
  std::uint64_t size = 0;  // [bytes] of all
};
static_assert(sizeof(Head) == 24);
using Checksum = std::uint64_t;

constexpr std::size_t kMostBytes = std::size_t{4} << 30;

Checksum checksum(std::span<const std::byte> bytes) {
  Hash64 hash;
  hash.add(static_cast<std::uint64_t>(bytes.size()));
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t count = bytes.size() < sizeof word ? bytes.size() : sizeof word;
    std::memcpy(&word, bytes.data(), count);
    hash.add(word);
    bytes = bytes.subspan(count);
  }
  return hash.value();
}

}  // namespace

std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint) {
  ByteWriter out;
  Head head;
  out.raw(&head, sizeof head);
  out(build_identity(), checkpoint.name, checkpoint.epoch, checkpoint.frame, checkpoint.state_hash);
  out(*checkpoint.scene);
  out(static_cast<std::uint64_t>(checkpoint.state.size()));
  out.raw(checkpoint.state.data(), checkpoint.state.size());
  std::vector<std::byte> bytes = out.take();

  head.size = bytes.size() + sizeof(Checksum);
  std::memcpy(bytes.data(), &head, sizeof head);
  const Checksum sum = checksum(bytes);
  const auto* const first = reinterpret_cast<const std::byte*>(&sum);
  bytes.insert(bytes.end(), first, first + sizeof sum);
  return bytes;
}

std::shared_ptr<const Checkpoint> checkpoint_from(std::span<const std::byte> bytes,
                                                  const std::string& source) {
  const auto refuse = [&](const std::string& what) -> void { throw Error(source + ": " + what); };
  Head head;
  const Head ours;
  if (bytes.size() >= sizeof head) std::memcpy(&head, bytes.data(), sizeof head);
  if (bytes.size() < sizeof head || head.magic != ours.magic) refuse("is no checkpoint");
  if (head.format != ours.format)
    refuse("is a checkpoint of format " + std::to_string(head.format) + ", known is " +
           std::to_string(ours.format));
  if (head.size != bytes.size() || bytes.size() < sizeof head + sizeof(Checksum))
    refuse("the checkpoint is damaged: it has " + std::to_string(bytes.size()) + " of " +
           std::to_string(head.size) + " bytes");
  Checksum sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
  bytes = bytes.first(bytes.size() - sizeof sum);
  if (sum != checksum(bytes)) refuse("the checkpoint is damaged: its checksum is wrong");

  ByteReader in(bytes.subspan(sizeof head));
  std::string build;
  in(build);
  if (build != build_identity())
    refuse("the checkpoint is of another build of Poinsot (" + build + "); this one is " +
           build_identity());
  auto checkpoint = std::make_shared<Checkpoint>();
  auto scene = std::make_shared<Scene>();
  try {
    in(checkpoint->name, checkpoint->epoch, checkpoint->frame, checkpoint->state_hash);
    in(*scene);
    std::size_t size = 0;
    in.count(size, 1);
    checkpoint->state.resize(size);
    in.raw(checkpoint->state.data(), size);
  } catch (const Error& error) {
    refuse(error.what());
  }
  if (in.left() != 0) refuse("the checkpoint is damaged: bytes are left over");
  checkpoint->scene = std::move(scene);
  return checkpoint;
}

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  write_whole_file(file, checkpoint_bytes(checkpoint));
}

std::shared_ptr<const Checkpoint> read_checkpoint(const std::filesystem::path& file) {
  return checkpoint_from(read_whole_file(file, kMostBytes), file.string());
}

}  // namespace poinsot
