#include "poinsot/simulation/springs.h"

#include <algorithm>
#include <numeric>

#include "poinsot/base/check.h"
#include "poinsot/simulation/tethers.h"
#include "poinsot/simulation/world.h"

namespace poinsot {
namespace {

// Groups of columns joined by springs, by union and find.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  // The smaller column becomes the root, so that systems are in column order.
  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

struct WorldSpring {
  Eigen::Index a;
  Eigen::Index b;   // -1: the world
  SpringLink link;  // indices still to be set
};

Eigen::Index column(const World& world, const std::string& name) {
  const auto found = world.find(name);
  POINSOT_CHECK(found.has_value());  // validate() has looked
  return *found;
}

// Ends at bodies that do not move become points of W; the first end always moves.
std::vector<WorldSpring> resolve(const Scene& scene, const World& world) {
  std::vector<WorldSpring> springs;
  for (const SpringDef& def : scene.springs) {
    const Eigen::Index a = column(world, def.a);
    const Eigen::Index b = def.b.empty() ? -1 : column(world, def.b);
    const auto from_center = [&](Eigen::Index i, const Vec3& p) {
      return Vec3(p - world.center_of_mass[static_cast<std::size_t>(i)]);
    };
    const auto in_W = [&](Eigen::Index i, const Vec3& p) { return Vec3(body_pose(world, i) * p); };
    const Vec3 at_a = in_W(a, def.point_a);
    const Vec3 at_b = b >= 0 ? in_W(b, def.point_b) : def.point_b;
    SpringLink link{0,
                    SpringLink::kWorld,
                    from_center(a, def.point_a),
                    at_b,
                    def.stiffness,
                    def.damping,
                    def.rest_length.value_or((at_a - at_b).norm())};
    const bool b_moves = b >= 0 && world.moves(b);
    if (world.moves(a)) {
      if (b_moves) {
        link.p_b = from_center(b, def.point_b);
      } else if (b >= 0) {
        link.anchor = b;
        link.p_anchor = def.point_b;
      }
      springs.push_back({a, b_moves ? b : -1, link});
    } else if (b_moves) {
      link.p_a = from_center(b, def.point_b);
      link.p_b = at_a;
      link.anchor = a;
      link.p_anchor = def.point_a;
      springs.push_back({b, -1, link});
    }
  }
  return springs;
}

std::vector<BodySystem> join(std::size_t n, const std::vector<WorldSpring>& springs) {
  std::vector<BodySystem> systems;
  Joined joined(n);
  std::vector<bool> sprung(n, false);
  for (const WorldSpring& spring : springs) {
    sprung[static_cast<std::size_t>(spring.a)] = true;
    if (spring.b < 0) continue;
    sprung[static_cast<std::size_t>(spring.b)] = true;
    joined.join(static_cast<std::size_t>(spring.a), static_cast<std::size_t>(spring.b));
  }
  std::vector<std::size_t> system_of(n, 0);
  std::vector<int> place(n, SpringLink::kWorld);
  for (std::size_t i = 0; i < n; ++i) {
    if (!sprung[i]) continue;
    const std::size_t root = joined.root(i);
    if (root == i) {
      system_of[i] = systems.size();
      systems.emplace_back();
    }
    BodySystem& system = systems[system_of[root]];
    place[i] = static_cast<int>(system.columns.size());
    system.columns.push_back(static_cast<Eigen::Index>(i));
  }
  for (const WorldSpring& spring : springs) {
    SpringLink link = spring.link;
    link.a = place[static_cast<std::size_t>(spring.a)];
    if (spring.b >= 0) link.b = place[static_cast<std::size_t>(spring.b)];
    BodySystem& system = systems[system_of[joined.root(static_cast<std::size_t>(spring.a))]];
    system.springs_of.resize(system.columns.size());
    const int index = static_cast<int>(system.springs.size());
    system.springs_of[static_cast<std::size_t>(link.a)].push_back(index);
    if (link.b >= 0) system.springs_of[static_cast<std::size_t>(link.b)].push_back(index);
    system.springs.push_back(link);
    ++system.scene_springs;
  }
  return systems;
}

}  // namespace

std::vector<BodySystem> make_systems(const Scene& scene, const World& world) {
  if (scene.springs.empty()) return {};
  return join(static_cast<std::size_t>(world.size()), resolve(scene, world));
}

namespace {

bool holds(const BodySystem& system, const SpringLink& spring, Eigen::Index i) {
  return system.columns[static_cast<std::size_t>(spring.a)] == i || spring.anchor == i ||
         (spring.b >= 0 && system.columns[static_cast<std::size_t>(spring.b)] == i);
}

// What is left of a system without the springs of body i.
std::vector<BodySystem> without(const BodySystem& system, std::size_t n, Eigen::Index i) {
  std::vector<WorldSpring> left;
  for (const SpringLink& spring : system.springs) {
    if (holds(system, spring, i)) continue;
    const auto column_of = [&](int place) {
      return place < 0 ? Eigen::Index{-1} : system.columns[static_cast<std::size_t>(place)];
    };
    left.push_back({column_of(spring.a), column_of(spring.b), spring});
  }
  return join(n, left);
}

}  // namespace

std::vector<int> drop_springs(World& world, Eigen::Index i) {
  std::vector<Tether> tethers = world.tethers;
  std::erase_if(tethers, [i](const Tether& tether) { return tether.column == i; });
  std::vector<Eigen::Index> relaid;
  set_tethers(world, {}, relaid);

  struct Part {
    BodySystem system;
    int came_from;
  };
  std::vector<Part> parts;
  for (std::size_t s = 0; s < world.systems.size(); ++s) {
    BodySystem& system = world.systems[s];
    const bool stays = std::ranges::none_of(
        system.springs, [&](const SpringLink& spring) { return holds(system, spring, i); });
    if (stays) {
      parts.push_back({std::move(system), static_cast<int>(s)});
    } else {
      for (BodySystem& part : without(system, world.ids.size(), i))
        parts.push_back({std::move(part), kAnother});
    }
  }
  std::ranges::sort(parts, {}, [](const Part& part) { return part.system.columns[0]; });
  world.systems.clear();
  std::vector<int> came_from;
  for (Part& part : parts) {
    world.systems.push_back(std::move(part.system));
    came_from.push_back(part.came_from);
  }
  world.number_systems();
  set_tethers(world, tethers, relaid);
  return came_from;
}

void move_anchors(World& world, Eigen::Index i) {
  for (BodySystem& system : world.systems)
    for (SpringLink& spring : system.springs)
      if (spring.anchor == i) spring.p_b = body_pose(world, i) * spring.p_anchor;
}

SpringForce spring_force(const SpringLink& spring, const Vec3& x_a, const Vec3& x_b,
                         const Vec3& v_a, const Vec3& v_b) {
  const Vec3 d = x_a - x_b;
  if (spring.is_linear())
    return {-spring.stiffness * d,
            spring.damping > 0 ? Vec3(-spring.damping * (v_a - v_b)) : Vec3(Vec3::Zero())};
  const double r = d.norm();
  const Vec3 along = d / r;
  return {-spring.stiffness * (r - spring.rest) * along,
          -spring.damping * (v_a - v_b).dot(along) * along};
}

double spring_energy(const SpringLink& spring, const Vec3& x_a, const Vec3& x_b) {
  const double stretch = (x_a - x_b).norm() - spring.rest;
  return 0.5 * spring.stiffness * stretch * stretch;
}

}  // namespace poinsot
