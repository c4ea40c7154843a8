#include "poinsot/collision/collision_state.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace poinsot {

std::vector<Collider> make_colliders(Eigen::Index column, const BodyDef& body) {
  std::vector<Collider> colliders;
  for (const ShapeDef& def : body.shapes)
    colliders.emplace_back(column, def.shape,
                           Pose{def.pose.c - body.mass_properties.center_of_mass, def.pose.q});
  return colliders;
}

std::vector<Collider> make_colliders(const Scene& scene) {
  std::vector<Collider> colliders;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    std::ranges::move(make_colliders(static_cast<Eigen::Index>(k), scene.bodies[k]),
                      std::back_inserter(colliders));
  return colliders;
}

CollisionState::CollisionState(const Scene& scene)
    : def(scene.collision),
      simulation(scene),
      colliders(make_colliders(scene)),
      arm(scene.bodies.size(), 0),
      has_corners(scene.bodies.size(), 0),
      least_size(scene.bodies.size(), 0),
      pairs(scene.bodies.size()),
      stamp(scene.bodies.size(), 1),
      body_time(scene.bodies.size(), 0),
      courses(scene.bodies.size()),
      course_stamp(scene.bodies.size(), 0),
      bounds_until(scene.bodies.size(), 0),
      asleep(scene.bodies.size(), 0),
      bound(colliders.size()) {
  first_collider.assign(scene.bodies.size() + 1, 0);
  for (const Collider& collider : colliders)
    ++first_collider[static_cast<std::size_t>(collider.body) + 1];
  for (std::size_t k = 1; k < first_collider.size(); ++k)
    first_collider[k] += first_collider[k - 1];
  for (Eigen::Index i = 0; i < world().size(); ++i) measure_shapes(i);
}

void CollisionState::measure_shapes(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  arm[k] = 0;
  has_corners[k] = 0;
  least_size[k] = std::numeric_limits<double>::infinity();
  for (const Collider& collider : colliders_of(i)) {
    if (poinsot::has_corners(collider)) has_corners[k] = 1;
    least_size[k] = std::min(least_size[k], collider.size);
    arm[k] = std::max(arm[k], collider.in_body.c.norm() + collider.bounding_radius);
  }
}

Eigen::Index CollisionState::add(const BodyDef& body) {
  const Eigen::Index i = simulation.add(body);
  const auto k = static_cast<std::size_t>(i);
  if (k == stamp.size()) {
    first_collider.push_back(first_collider.back());
    arm.push_back(0);
    has_corners.push_back(0);
    least_size.push_back(0);
    pairs.add_body();
    stamp.push_back(0);
    body_time.push_back(0);
    courses.emplace_back();
    course_stamp.push_back(0);
    bounds_until.push_back(0);
    asleep.push_back(0);
    for (std::size_t j = 0; j < k; ++j)
      if (courses[j].kind() == Course::Kind::flight)
        courses[j].use(simulation.flight(static_cast<Eigen::Index>(j)));
  }
  std::vector<Collider> its = make_colliders(i, body);
  const int first = first_collider[k], count = static_cast<int>(its.size());
  pairs.insert_colliders(first, count);
  colliders.insert(colliders.begin() + first, std::make_move_iterator(its.begin()),
                   std::make_move_iterator(its.end()));
  bound.insert(bound.begin() + first, its.size(), Aabb{});
  for (std::size_t j = k + 1; j < first_collider.size(); ++j) first_collider[j] += count;
  measure_shapes(i);
  begin_anew(i);
  return i;
}

bool CollisionState::remove(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  const bool sprung = simulation.remove(i);
  const int first = first_collider[k], count = first_collider[k + 1] - first;
  pairs.erase_colliders(first, count);
  colliders.erase(colliders.begin() + first, colliders.begin() + first + count);
  bound.erase(bound.begin() + first, bound.begin() + first + count);
  for (std::size_t j = k + 1; j < first_collider.size(); ++j) first_collider[j] -= count;
  measure_shapes(i);
  begin_anew(i);
  return sprung;
}

void CollisionState::set_state(Eigen::Index i, const Pose& pose, const Velocity& velocity) {
  simulation.set_state(i, pose, velocity);
  for (const int r : pairs.of(i)) pairs.forget(pairs[r]);
  begin_anew(i);
}

void CollisionState::begin_anew(Eigen::Index i) {
  const auto k = static_cast<std::size_t>(i);
  change_course(i);
  body_time[k] = world().time;
  bounds_until[k] = world().time;
}

std::span<const Collider> CollisionState::colliders_of(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  return {colliders.data() + first_collider[k], colliders.data() + first_collider[k + 1]};
}

const Course& CollisionState::course(Eigen::Index i, double to, bool in_contact,
                                     SimulationWorker& worker) {
  const auto k = static_cast<std::size_t>(i);
  Course& course = courses[k];
  if (course_stamp[k] == stamp[k] && course.end() >= to) {
    if (course.kind() == Course::Kind::driven) course.use(worker);
    return course;
  }
  const bool rests = asleep[k] != 0 || (!world().moves(i) && !world().is_kinematic(i));
  course = rests ? Course::still({position(world().y, i), orientation(world().y, i)}, body_time[k],
                                 std::numeric_limits<double>::infinity())
                 : simulation.course(i, body_time[k], to, in_contact, worker);
  course_stamp[k] = stamp[k];
  return course;
}

MovingPose CollisionState::moving_pose(Eigen::Index i, double t, bool in_contact,
                                       SimulationWorker& worker) {
  const auto k = static_cast<std::size_t>(i);
  if (body_time[k] == t || !world().moves(i) || asleep[k] != 0) {
    if (!world().is_kinematic(i))
      return {{position(world().y, i), orientation(world().y, i)},
              {linear_velocity(world(), i), angular_velocity(world(), i)}};
  }
  return course(i, t, in_contact, worker).moving_at(t);
}

void CollisionState::bring(Eigen::Index i, double t, SimulationWorker& worker, Tally& tally) {
  const auto k = static_cast<std::size_t>(i);
  if (body_time[k] == t || !is_awake(i)) return;
  const int system = world().systems.empty() ? World::kLone : world().system_of[k];
  if (system == World::kLone) {
    simulation.advance({&i, 1}, body_time[k], t, false, worker, tally);
    body_time[k] = t;
    return;
  }
  const auto& columns = world().systems[static_cast<std::size_t>(system)].columns;
  simulation.advance(columns, body_time[k], t, false, worker, tally);
  for (const Eigen::Index j : columns) {  // their courses begin where they are now
    body_time[static_cast<std::size_t>(j)] = t;
    change_course(j);
  }
}

double CollisionState::touch(const PairRecord& record) const {
  const auto a = static_cast<Eigen::Index>(record.a), b = static_cast<Eigen::Index>(record.b);
  const double reach = std::min(position(world().y, a).norm() + arm[static_cast<std::size_t>(a)],
                                position(world().y, b).norm() + arm[static_cast<std::size_t>(b)]);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * reach;
  return std::max(def.contact_band * record.size, std::isfinite(rounding) ? rounding : 0.0);
}

}  // namespace poinsot
