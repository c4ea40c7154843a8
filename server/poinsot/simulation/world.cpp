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
    motion.push_back(body.is_static ? Motion::fixed : Motion::dynamic);
    mass.push_back(body.is_static ? 0.0 : m.mass);
    inv_mass.push_back(body.is_static ? 0.0 : 1.0 / m.mass);
    J_B.push_back(body.is_static ? Mat3(Mat3::Zero()) : m.J);
    inv_J_B.push_back(body.is_static ? Mat3(Mat3::Zero()) : Mat3(m.J.inverse()));

    position(y, i) = body.pose * m.center_of_mass;
    orientation(y, i) = body.pose.q;
    momentum(y, i) = mass[k] * body.linear_velocity;
    const Mat3 R = body.pose.q.toRotationMatrix();
    angular_momentum(y, i) = R * (J_B[k] * (R.transpose() * body.angular_velocity));
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

Mat3 rotation(const World& world, Eigen::Index i) {
  return orientation(world.y, i).toRotationMatrix();
}

Mat3 inv_J_W(const World& world, Eigen::Index i) {
  const Mat3 R = rotation(world, i);
  return R * world.inv_J_B[static_cast<std::size_t>(i)] * R.transpose();
}

Vec3 linear_velocity(const World& world, Eigen::Index i) {
  return world.inv_mass[static_cast<std::size_t>(i)] * momentum(world.y, i);
}

Vec3 angular_velocity(const World& world, Eigen::Index i) {
  const Mat3 R = rotation(world, i);
  return R * (world.inv_J_B[static_cast<std::size_t>(i)] *
              (R.transpose() * angular_momentum(world.y, i)));
}

Pose body_pose(const World& world, Eigen::Index i) {
  const Quat q = orientation(world.y, i);
  return {position(world.y, i) - q * world.center_of_mass[static_cast<std::size_t>(i)], q};
}

}  // namespace poinsot
