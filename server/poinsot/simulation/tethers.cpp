#include "poinsot/simulation/tethers.h"

#include <algorithm>
#include <cmath>

#include "poinsot/base/error.h"

namespace poinsot {
namespace {

void check(const World& world, const Tether& tether) {
  const bool finite = tether.p_B.allFinite() && tether.target.allFinite() &&
                      std::isfinite(tether.stiffness) && std::isfinite(tether.damping);
  if (finite && tether.stiffness >= 0 && tether.damping >= 0) return;
  throw Error("body '" + world.names[static_cast<std::size_t>(tether.column)] +
              "': a tether's numbers must be finite, its stiffness and damping not negative");
}

bool acts(const World& world, const Tether& tether) {
  return tether.column >= 0 && tether.column < world.size() && world.moves(tether.column);
}

bool same_law(const Tether& a, const Tether& b) {
  return a.p_B == b.p_B && a.stiffness == b.stiffness && a.damping == b.damping;
}

SpringLink link_of(const Tether& tether, int place) {
  return {place, SpringLink::kWorld, tether.p_B, tether.target, tether.stiffness, tether.damping, 0,
          true};
}

SpringLink& link_at(World& world, std::size_t k) {
  const World::TetherPlace place = world.tether_places[k];
  return world.systems[static_cast<std::size_t>(place.system)]
      .springs[static_cast<std::size_t>(place.spring)];
}

// The tethers hold the same bodies in the same order as those the world has.
bool same_columns(const World& world, std::span<const Tether> tethers) {
  std::size_t k = 0;
  for (const Tether& tether : tethers) {
    if (!acts(world, tether)) continue;
    if (k == world.tethers.size() || world.tethers[k].column != tether.column) return false;
    ++k;
  }
  return k == world.tethers.size();
}

TetherChange move(World& world, std::span<const Tether> tethers,
                  std::vector<Eigen::Index>& relaid) {
  TetherChange change = TetherChange::none;
  std::size_t k = 0;
  for (const Tether& tether : tethers) {
    if (!acts(world, tether)) continue;
    Tether& mine = world.tethers[k];
    const bool same = same_law(mine, tether);
    if (!same) relaid.push_back(tether.column);
    if (!same || mine.target != tether.target) {
      change = TetherChange::moved;
      mine = tether;
      SpringLink& link = link_at(world, k);
      link = link_of(mine, link.a);
    }
    ++k;
  }
  return change;
}

std::vector<Tether> by_column(std::span<const Tether> tethers) {
  std::vector<Tether> sorted(tethers.begin(), tethers.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Tether& a, const Tether& b) { return a.column < b.column; });
  return sorted;
}

// Columns whose tethers differ in more than their targets.
void find_relaid(std::span<const Tether> before, std::span<const Tether> now,
                 std::vector<Eigen::Index>& relaid) {
  const std::vector<Tether> old = by_column(before), next = by_column(now);
  const auto end_of = [](auto from, auto end, Eigen::Index column) {
    return std::find_if(from, end, [&](const Tether& t) { return t.column != column; });
  };
  for (auto a = old.begin(), b = next.begin(); a != old.end() || b != next.end();) {
    const Eigen::Index column = a == old.end()    ? b->column
                                : b == next.end() ? a->column
                                                  : std::min(a->column, b->column);
    const auto end_a = end_of(a, old.end(), column), end_b = end_of(b, next.end(), column);
    if (!std::equal(a, end_a, b, end_b, same_law)) relaid.push_back(column);
    a = end_a;
    b = end_b;
  }
}

// Only the scene's systems and springs are left.
void clear_links(World& world) {
  for (std::size_t s = world.scene_systems; s < world.systems.size(); ++s)
    world.system_of[static_cast<std::size_t>(world.systems[s].columns[0])] = World::kLone;
  world.systems.resize(world.scene_systems);
  for (BodySystem& system : world.systems) {
    system.springs.resize(system.scene_springs);
    const auto is_tether = [&](int spring) {
      return static_cast<std::size_t>(spring) >= system.scene_springs;
    };
    for (std::vector<int>& springs : system.springs_of) std::erase_if(springs, is_tether);
  }
  world.tether_places.clear();
}

void link_all(World& world) {
  const auto n = static_cast<std::size_t>(world.size());
  if (world.system_of.empty()) {
    world.system_of.assign(n, World::kLone);
    world.place_of.assign(n, 0);
  }
  for (const Tether& tether : world.tethers) {
    const auto k = static_cast<std::size_t>(tether.column);
    int& s = world.system_of[k];
    if (s == World::kLone) {
      s = static_cast<int>(world.systems.size());
      world.place_of[k] = 0;
      world.systems.push_back({{tether.column}, {}, {{}}, 0});
    }
    BodySystem& system = world.systems[static_cast<std::size_t>(s)];
    const int place = world.place_of[k], index = static_cast<int>(system.springs.size());
    system.springs.push_back(link_of(tether, place));
    system.springs_of[static_cast<std::size_t>(place)].push_back(index);
    world.tether_places.push_back({s, index});
  }
  if (!world.systems.empty()) return;
  world.system_of.clear();
  world.place_of.clear();
}

}  // namespace

TetherChange set_tethers(World& world, std::span<const Tether> tethers,
                         std::vector<Eigen::Index>& relaid) {
  for (const Tether& tether : tethers)
    if (acts(world, tether)) check(world, tether);
  if (same_columns(world, tethers)) return move(world, tethers, relaid);
  std::vector<Tether> acting;
  std::copy_if(tethers.begin(), tethers.end(), std::back_inserter(acting),
               [&](const Tether& tether) { return acts(world, tether); });
  find_relaid(world.tethers, acting, relaid);
  world.tethers = std::move(acting);
  link_tethers(world);
  return TetherChange::joined;
}

void link_tethers(World& world) {
  clear_links(world);
  link_all(world);
}

double tether_energy(const World& world) {
  double sum = 0;
  for (const Tether& tether : world.tethers) {
    const Vec3 x =
        position(world.y, tether.column) + orientation(world.y, tether.column) * tether.p_B;
    sum += 0.5 * tether.stiffness * (x - tether.target).squaredNorm();
  }
  return sum;
}

void hash_into(Hash64& hash, std::span<const Tether> tethers) {
  for (const Tether& tether : tethers) {
    hash.add(static_cast<std::uint64_t>(tether.column));
    hash.add(std::span(tether.p_B.data(), 3));
    hash.add(std::span(tether.target.data(), 3));
    hash.add(tether.stiffness);
    hash.add(tether.damping);
  }
}

}  // namespace poinsot
