#include "poinsot/simulation/world.h"

#include <algorithm>

namespace poinsot {

World::World(const Scene& scene) : gravity(scene.simulation.gravity) {
  const std::size_t n = scene.bodies.size();
  y = StateArray::Zero(13, static_cast<Eigen::Index>(n));
  for (const BodyDef& body : scene.bodies) {
    append();
    fill(static_cast<Eigen::Index>(ids.size() - 1), body);
  }
  for (std::size_t k = 0; k < n; ++k)
    if (!names[k].empty()) columns_by_name.push_back(static_cast<Eigen::Index>(k));
  std::ranges::stable_sort(columns_by_name, {}, [this](Eigen::Index i) { return name_of(i); });
  systems = make_systems(scene, *this);
  number_systems();
}

void World::number_systems() {
  scene_systems = systems.size();
  system_of.clear();
  place_of.clear();
  if (systems.empty()) return;
  system_of.assign(ids.size(), kLone);
  place_of.assign(ids.size(), 0);
  for (std::size_t s = 0; s < systems.size(); ++s)
    for (std::size_t j = 0; j < systems[s].columns.size(); ++j) {
      const auto k = static_cast<std::size_t>(systems[s].columns[j]);
      system_of[k] = static_cast<int>(s);
      place_of[k] = static_cast<int>(j);
    }
}

// An absent column at the end of everything but y.
void World::append() {
  ids.emplace_back();
  names.emplace_back();
  motion.push_back(Motion::absent);
  mass.push_back(0);
  inv_mass.push_back(0);
  center_of_mass.emplace_back(Vec3::Zero());
  J_B.emplace_back(Mat3::Zero());
  inv_J_B.emplace_back(Mat3::Zero());
  principal_axes.emplace_back();
  held.emplace_back();
  if (!drag.empty()) drag.emplace_back();
  if (!kinematic.empty()) kinematic.emplace_back();
  if (systems.empty()) return;
  system_of.push_back(kLone);
  place_of.push_back(0);
}

void World::fill(Eigen::Index i, const BodyDef& body) {
  const auto k = static_cast<std::size_t>(i);
  const MassProperties& m = body.mass_properties;
  const bool heavy = body.absent || body.is_static || body.is_kinematic;  // nothing moves it
  ids[k] = {static_cast<std::uint32_t>(k), body.generation};
  names[k] = body.absent ? std::string() : body.name;
  motion[k] = body.absent         ? Motion::absent
              : body.is_static    ? Motion::fixed
              : body.is_kinematic ? Motion::kinematic
                                  : Motion::dynamic;
  center_of_mass[k] = m.center_of_mass;
  mass[k] = heavy ? 0.0 : m.mass;
  inv_mass[k] = heavy ? 0.0 : 1.0 / m.mass;
  J_B[k] = heavy ? Mat3(Mat3::Zero()) : m.J;
  principal_axes[k] = heavy ? PrincipalAxes{} : poinsot::principal_axes(m.J);
  inv_J_B[k] = heavy ? Mat3(Mat3::Zero()) : inverse_inertia(principal_axes[k]);
  held[k] = {};
  const bool dragged = body.drag.linear > 0 || body.drag.quadratic > 0 || body.drag.angular > 0;
  if (dragged) drag.resize(ids.size());
  if (!drag.empty()) drag[k] = body.drag;
  if (body.is_kinematic) kinematic.resize(ids.size());
  if (!kinematic.empty()) kinematic[k] = {};
  set_state(i, body.pose, {body.linear_velocity, body.angular_velocity});
}

Eigen::Index World::add(const BodyDef& body) {
  const auto place = std::ranges::find(motion, Motion::absent);
  const auto i = static_cast<Eigen::Index>(place - motion.begin());
  if (place == motion.end()) {
    append();
    y.conservativeResize(Eigen::NoChange, i + 1);
    y.col(i).setZero();
  }
  fill(i, body);
  const auto after = std::ranges::upper_bound(columns_by_name, std::string_view(body.name), {},
                                              [this](Eigen::Index j) { return name_of(j); });
  columns_by_name.insert(after, i);
  return i;
}

void World::remove(Eigen::Index i) {
  std::erase(columns_by_name, i);
  BodyDef none;
  none.absent = true;
  none.generation = ids[static_cast<std::size_t>(i)].generation;
  fill(i, none);
}

void World::set_state(Eigen::Index i, const Pose& pose, const Velocity& v) {
  const auto k = static_cast<std::size_t>(i);
  if (motion[k] == Motion::frozen) thaw(i);
  position(y, i) = pose * center_of_mass[k];
  orientation(y, i) = pose.q;
  momentum(y, i) = mass[k] * v.linear;
  const Mat3 R = pose.q.toRotationMatrix();
  angular_momentum(y, i) = R * (J_B[k] * (R.transpose() * v.angular));
  if (is_kinematic(i)) kinematic[k] = {v, {position(y, i), orientation(y, i)}, time};
  if (motion[k] == Motion::fixed) move_anchors(*this, i);
}

std::optional<Eigen::Index> World::find(BodyId id) const {
  const auto i = static_cast<std::size_t>(id.slot);
  if (i >= ids.size() || ids[i] != id || motion[i] == Motion::absent) return std::nullopt;
  return static_cast<Eigen::Index>(i);
}

std::optional<Eigen::Index> World::find(std::string_view name) const {
  const auto found = std::ranges::lower_bound(columns_by_name, name, {},
                                              [this](Eigen::Index i) { return name_of(i); });
  if (found == columns_by_name.end() || name_of(*found) != name) return std::nullopt;
  return *found;
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
