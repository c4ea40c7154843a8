// The tethers of a world: which of them act, and the systems that they make. A tether is a spring
// of a system as the scene's are; a body that is in none becomes a system of its own.

#pragma once

#include <span>
#include <vector>

#include "poinsot/base/hash.h"
#include "poinsot/simulation/world.h"

namespace poinsot {

enum class TetherChange {
  none,    // they are what they were, to the bit
  moved,   // the same bodies are held: numbers changed; this does not allocate
  joined,  // bodies came, went or changed places
};

// All tethers from now on; those of columns that do not move are left out. `relaid`: columns whose
// tethers changed in number, point, stiffness or damping are added, once or several times. Throws
// Error if a number is not finite, or stiffness or damping is negative, before anything changed.
TetherChange set_tethers(World& world, std::span<const Tether> tethers,
                         std::vector<Eigen::Index>& relaid);

// Makes the springs and systems of world.tethers anew: they were read from a checkpoint.
void link_tethers(World& world);

// Elastic energy of the tethers [J], a part of spring_energy().
double tether_energy(const World& world);

void hash_into(Hash64& hash, std::span<const Tether> tethers);

}  // namespace poinsot
