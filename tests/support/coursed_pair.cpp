#include "support/coursed_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "poinsot/collision/proximity.h"

namespace poinsot::test {
namespace {

Scene scene_of(const BodyDef& a, const BodyDef& b, const Vec3& gravity) {
  Scene result = scene({a, b});
  result.bodies[0].name.assign(1, 'a');
  result.bodies[1].name.assign(1, 'b');
  result.simulation.gravity = gravity;
  return result;
}

Collider collider_of(const BodyDef& def, int body) {
  const ShapeDef& shape = def.shapes[0];
  return {body, shape.shape, {shape.pose.c - def.mass_properties.center_of_mass, shape.pose.q}};
}

Course course_of(const World& world, const BodyDef& def, Eigen::Index i, const Flight& flight,
                 double end) {
  const Pose pose{position(world.y, i), orientation(world.y, i)};
  if (def.is_static) return Course::still(pose, 0, end);
  if (def.is_kinematic)
    return Course::uniform(pose, {def.linear_velocity, def.angular_velocity}, 0, end);
  const RotationBound rotation =
      rotation_bound(world.principal_axes[static_cast<std::size_t>(i)], pose.q.toRotationMatrix(),
                     angular_momentum(world.y, i));
  return Course::flight(world, i, flight, rotation, 0, end);
}

Flight flight_of(const World& world, Eigen::Index i) {
  return world.moves(i) ? Flight(world, i) : Flight();
}

}  // namespace

CoursedPair::CoursedPair(const BodyDef& a, const BodyDef& b, double end, const Vec3& gravity)
    : end_(end),
      world_(scene_of(a, b, gravity)),
      colliders_{collider_of(a, 0), collider_of(b, 1)},
      flights_{flight_of(world_, 0), flight_of(world_, 1)},
      courses_{course_of(world_, a, 0, flights_[0], end),
               course_of(world_, b, 1, flights_[1], end)} {}

double CoursedPair::size() const {
  return std::min(colliders_[0].size, colliders_[1].size);
}

double CoursedPair::gap(double t) const {
  const auto at = [&](std::size_t i) { return courses_[i].at(t) * colliders_[i].in_body; };
  return find_gap(colliders_[0], at(0), colliders_[1], at(1)).value;
}

BodyDef moving(const Shape& shape, const Vec3& at, const Vec3& v, const Vec3& omega,
               const Quat& q) {
  BodyDef def = body("body", shape, at);
  def.pose.q = q;
  def.pose.c = at - q * def.mass_properties.center_of_mass;
  def.linear_velocity = v;
  def.angular_velocity = omega;
  return def;
}

FlyBy random_fly_by(int kind_a, int kind_b, double spin, Random& random) {
  const Shape a = random_shape(kind_a, random), b = random_shape(kind_b, random);
  const auto omega = [&] {
    const double speed = random.log_uniform(0.1, spin);
    return Vec3(speed * random.direction());
  };
  if (const auto* wall = std::get_if<HalfSpace>(&b)) {
    FlyBy result;
    const Vec3& n = wall->normal;
    result.b.is_static = true;
    result.b.shapes = {{b, {}}};
    const double height = wall->offset + bounding_radius(a) * random.uniform(1.05, 2.5);
    const Vec3 v = random.in_box(2) - random.uniform(0.5, 4) * n;
    result.a = moving(a, height * n + random.in_box(0.1), v, omega(), random.rotation());
    result.gravity = random.uniform(-9.81, 9.81) * n;
    return result;
  }
  const double reach = bounding_radius(a) + bounding_radius(b);
  const Vec3 ahead = random.direction();
  const Vec3 aside = ahead.cross(random.direction()).normalized();
  const Vec3 from = random.in_box(1), v = random.in_box(2);
  const double distance = reach * random.uniform(1.1, 2), pass = reach * random.uniform(0, 1);
  const double speed = random.log_uniform(0.5, 20);
  return {moving(a, from, v, omega(), random.rotation()),
          moving(b, from + distance * ahead + pass * aside, v - speed * ahead, omega(),
                 random.rotation()),
          random.below(3) == 0 ? Vec3(0, 0, -9.81) : Vec3(Vec3::Zero())};
}

Sampled dense_samples(const CoursedPair& pair, double dt) {
  const CoursePair courses = pair.pair();
  const auto speed = [](const Collider& collider, const Course& course) {
    if (!course.moves()) return 0.0;
    const double v = std::max(course.moving_at(course.start()).velocity.linear.norm(),
                              course.moving_at(course.end()).velocity.linear.norm());
    return v + course.rotation().omega * (collider.in_body.c.norm() + collider.bounding_radius);
  };
  const double closing = speed(courses.a, courses.course_a) + speed(courses.b, courses.course_b);
  Sampled result{std::nullopt, pair.gap(0)};
  const auto root = [&](double apart, double meets) {
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (apart + meets);
      (pair.gap(middle) > 0 ? apart : meets) = middle;
    }
    result.meets = meets;
    return result;
  };
  double t[3] = {0, 0, 0}, g[3] = {result.closest, result.closest, result.closest};
  while (t[2] < pair.end()) {
    std::rotate(t, t + 1, t + 3);
    std::rotate(g, g + 1, g + 3);
    t[2] = std::min(pair.end(), t[1] + std::max(dt, 0.9 * g[1] / closing));
    g[2] = pair.gap(t[2]);
    // A dip between samples: what turning at these speeds can hide.
    if (t[1] > t[0] && g[1] <= g[0] && g[1] <= g[2] && g[1] < closing * dt) {
      double low = t[0], high = t[2];
      for (int i = 0; i < 45; ++i) {
        const double a = low + 0.381966 * (high - low), b = high - 0.381966 * (high - low);
        (pair.gap(a) < pair.gap(b) ? high : low) = pair.gap(a) < pair.gap(b) ? b : a;
      }
      const double least = pair.gap(0.5 * (low + high));
      if (least <= 0) return root(t[0], 0.5 * (low + high));
      result.closest = std::min(result.closest, least);
    }
    result.closest = std::min(result.closest, g[2]);
    if (g[2] <= 0) return root(t[1], t[2]);
  }
  return result;
}

}  // namespace poinsot::test
