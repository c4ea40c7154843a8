#include "poinsot/presentation/state_hash.h"

namespace poinsot {
namespace {

std::uint64_t digest_of(const World& world, Eigen::Index i) {
  Hash64 hash;
  hash.add(std::span(world.y.col(i).data(), 13));
  hash.add(static_cast<std::uint64_t>(world.motion[static_cast<std::size_t>(i)]));
  return hash.value() | 1;
}

}  // namespace

std::uint64_t state_hash(std::uint64_t frame, const CollisionLayer& collision,
                         const HeldWrenches& held, std::uint64_t scene_digest,
                         BodyDigests& digests) {
  const World& world = collision.world();
  digests.value.resize(static_cast<std::size_t>(world.size()), 0);
  digests.stamp.resize(digests.value.size(), 0);
  Hash64 hash;
  hash.add(frame);
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    std::uint64_t& digest = digests.value[static_cast<std::size_t>(i)];
    std::uint32_t& stamp = digests.stamp[static_cast<std::size_t>(i)];
    const std::uint32_t now = collision.course_stamp(i);
    if (digest == 0 || !collision.is_asleep(i) || stamp != now) digest = digest_of(world, i);
    stamp = now;
    hash.add(digest);
    if (!collision.is_asleep(i)) digest = 0;
  }
  if (scene_digest != 0) hash.add(scene_digest);
  held.hash_into(hash);
  collision.hash_into(hash);
  return hash.value();
}

}  // namespace poinsot
