#include "poinsot/simulation/world.h"

#include <algorithm>

namespace poinsot {

World::World(const Scene& scene) : gravity(scene.simulation.gravity) {
  const std::size_t n = scene.bodies.size();
  y = StateArray::Zero(13, static_cast<Eigen::Index>(n));
  held.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const BodyDef& body = scene.bodies[k];
    const MassProperties& m = body.mass_properties;
    const auto i = static_cast<Eigen::Index>(k);

    ids.push_back({static_cast<std::uint32_t>(k), 1});
    names.push_back(body.name);
    center_of_mass.push_back(m.center_of_mass);
    const bool heavy = body.is_static || body.is_kinematic;  // nothing moves it
    motion.push_back(body.is_static      ? Motion::fixed
                     : body.is_kinematic ? Motion::kinematic
                                         : Motion::dynamic);
    mass.push_back(heavy ? 0.0 : m.mass);
    inv_mass.push_back(heavy ? 0.0 : 1.0 / m.mass);
    J_B.push_back(heavy ? Mat3(Mat3::Zero()) : m.J);
    principal_axes.push_back(heavy ? PrincipalAxes{} : poinsot::principal_axes(m.J));
    inv_J_B.push_back(heavy ? Mat3(Mat3::Zero()) : inverse_inertia(principal_axes[k]));

    position(y, i) = body.pose * m.center_of_mass;
    orientation(y, i) = body.pose.q;
    momentum(y, i) = mass[k] * body.linear_velocity;
    const Mat3 R = body.pose.q.toRotationMatrix();
    angular_momentum(y, i) = R * (J_B[k] * (R.transpose() * body.angular_velocity));
  }
  const auto is_kinematic = [](const BodyDef& body) { return body.is_kinematic; };
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), is_kinematic))
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const BodyDef& body = scene.bodies[k];
      kinematic.push_back(
          {{body.linear_velocity, body.angular_velocity}, {position(y, i), orientation(y, i)}});
    }
  const auto dragged = [](const BodyDef& body) {
    return body.drag.linear > 0 || body.drag.quadratic > 0 || body.drag.angular > 0;
  };
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), dragged))
    for (const BodyDef& body : scene.bodies) drag.push_back(body.drag);
  systems = make_systems(scene, *this);
  scene_systems = systems.size();
  if (systems.empty()) return;
  system_of.assign(n, kLone);
  place_of.assign(n, 0);
  for (std::size_t s = 0; s < systems.size(); ++s)
    for (std::size_t j = 0; j < systems[s].columns.size(); ++j) {
      const auto k = static_cast<std::size_t>(systems[s].columns[j]);
      system_of[k] = static_cast<int>(s);
      place_of[k] = static_cast<int>(j);
    }
}

std::optional<Eigen::Index> World::find(BodyId id) const {
  const auto i = static_cast<std::size_t>(id.slot);
  if (i >= ids.size() || ids[i] != id) return std::nullopt;
  return static_cast<Eigen::Index>(i);
}

std::optional<Eigen::Index> World::find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Eigen::Index>(found - names.begin());
}

void World::freeze(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  motion[k] = Motion::frozen;
  inv_mass[k] = 0;
  inv_J_B[k].setZero();
  momentum(y, i).setZero();
  angular_momentum(y, i).setZero();
}

void World::thaw(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  motion[k] = Motion::dynamic;
  inv_mass[k] = 1.0 / mass[k];
  inv_J_B[k] = inverse_inertia(principal_axes[k]);
}

Mat3 rotation(const World& world, Eigen::Index i) {
  return orientation(world.y, i).toRotationMatrix();
}

Mat3 inv_J_W(const World& world, Eigen::Index i) {
  const Mat3 R = rotation(world, i);
  return R * world.inv_J_B[static_cast<std::size_t>(i)] * R.transpose();
}

Vec3 linear_velocity(const World& world, Eigen::Index i) {
  if (world.is_kinematic(i)) return world.kinematic[static_cast<std::size_t>(i)].velocity.linear;
  return world.inv_mass[static_cast<std::size_t>(i)] * momentum(world.y, i);
}

Vec3 angular_velocity(const World& world, Eigen::Index i) {
  if (world.is_kinematic(i)) return world.kinematic[static_cast<std::size_t>(i)].velocity.angular;
  const Mat3 R = rotation(world, i);
  return R * (world.inv_J_B[static_cast<std::size_t>(i)] *
              (R.transpose() * angular_momentum(world.y, i)));
}

Pose body_pose(const World& world, Eigen::Index i) {
  const Quat q = orientation(world.y, i);
  return {position(world.y, i) - q * world.center_of_mass[static_cast<std::size_t>(i)], q};
}

namespace {

// A point of a body, or of W, and its velocity.
struct SpringEnd {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero(), arm = Vec3::Zero();
};

SpringEnd spring_end(const World& world, const BodySystem& system, int index, const Vec3& p) {
  if (index == SpringLink::kWorld) return {p, Vec3::Zero(), Vec3::Zero()};
  const Eigen::Index i = system.columns[static_cast<std::size_t>(index)];
  const Vec3 arm = orientation(world.y, i) * p;
  return {position(world.y, i) + arm,
          linear_velocity(world, i) + angular_velocity(world, i).cross(arm), arm};
}

}  // namespace

Wrench acting_wrench(const World& world, Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  Wrench w{world.mass[k] * world.gravity, Vec3::Zero()};
  if (!world.held[k].is_zero()) w += world.held[k].at(rotation(world, i));
  if (!world.drag.empty()) {
    w.force += drag_force(world.drag[k], linear_velocity(world, i));
    if (world.drag[k].angular > 0) w.torque -= world.drag[k].angular * angular_velocity(world, i);
  }
  if (world.systems.empty() || world.system_of[k] == World::kLone) return w;
  const BodySystem& system = world.systems[static_cast<std::size_t>(world.system_of[k])];
  const int place = world.place_of[k];
  for (const int index : system.springs_of[static_cast<std::size_t>(place)]) {
    const SpringLink& spring = system.springs[static_cast<std::size_t>(index)];
    const SpringEnd a = spring_end(world, system, spring.a, spring.p_a);
    const SpringEnd b = spring_end(world, system, spring.b, spring.p_b);
    const SpringForce f = spring_force(spring, a.x, b.x, a.v, b.v);
    const Vec3 force = f.elastic + f.damping;
    w += spring.a == place ? Wrench{force, a.arm.cross(force)}
                           : Wrench{-force, b.arm.cross(Vec3(-force))};
  }
  return w;
}

double spring_energy(const World& world, const BodySystem& system) {
  double sum = 0;
  for (const SpringLink& spring : system.springs)
    sum += spring_energy(spring, spring_end(world, system, spring.a, spring.p_a).x,
                         spring_end(world, system, spring.b, spring.p_b).x);
  return sum;
}

double spring_energy(const World& world) {
  double sum = 0;
  for (const BodySystem& system : world.systems) sum += spring_energy(world, system);
  return sum;
}

}  // namespace poinsot
