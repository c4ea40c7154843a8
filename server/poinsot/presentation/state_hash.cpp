#include "poinsot/presentation/state_hash.h"

namespace poinsot {

std::uint64_t state_hash(std::uint64_t frame, const CollisionLayer& collision,
                         const HeldWrenches& held) {
  const World& world = collision.world();
  Hash64 hash;
  hash.add(frame);
  hash.add(std::span(world.y.data(), static_cast<std::size_t>(world.y.size())));
  for (const Motion motion : world.motion) hash.add(static_cast<std::uint64_t>(motion));
  held.hash_into(hash, frame);
  collision.hash_into(hash);
  return hash.value();
}

}  // namespace poinsot
