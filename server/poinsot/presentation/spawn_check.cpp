#include "poinsot/presentation/spawn_check.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "poinsot/base/limits.h"
#include "poinsot/collision/collision_layer.h"

namespace poinsot {
namespace {

bool has_mesh(const BodyDef& body) {
  return std::ranges::any_of(
      body.shapes, [](const ShapeDef& def) { return std::holds_alternative<Mesh>(def.shape); });
}

// About B's origin [m]; infinite with a half-space.
double reach_of(const BodyDef& body) {
  double reach = 0;
  for (const ShapeDef& def : body.shapes)
    reach = std::max(reach, def.pose.c.norm() + bounding_radius(def.shape));
  return reach;
}

struct Ball {
  Vec3 center;    // [m] in W
  double radius;  // [m]
  bool meets(const Ball& other) const {
    return (center - other.center).norm() <= radius + other.radius;
  }
};

// What find_overlaps() is to look at: the bodies there that are near one of the new ones, where
// they are now, then the new ones.
Scene neighbourhood(const std::vector<BodyDef>& bodies, const Scene& scene, const World& world) {
  Scene near;
  near.collision = scene.collision;
  std::vector<Ball> balls;
  for (const BodyDef& body : bodies)
    if (!has_mesh(body)) balls.push_back({body.pose.c, reach_of(body)});
  for (Eigen::Index i = 0; i < world.size(); ++i) {
    const BodyDef& body = scene.bodies[static_cast<std::size_t>(i)];
    if (body.absent || body.shapes.empty() || has_mesh(body)) continue;
    const Pose pose = body_pose(world, i);
    const Ball ball{pose.c, reach_of(body)};
    if (std::ranges::none_of(balls, [&](const Ball& b) { return b.meets(ball); })) continue;
    near.bodies.push_back(body);
    near.bodies.back().pose = pose;
  }
  return near;
}

void add_rules_of(Scene& near, const Scene& scene) {
  if (scene.pairs.empty()) return;
  std::set<std::string_view> names;
  for (const BodyDef& body : near.bodies) names.insert(body.name);
  for (const PairDef& def : scene.pairs)
    if (names.contains(def.a) && names.contains(def.b)) near.pairs.push_back(def);
}

}  // namespace

std::optional<Refusal> check_names(const std::vector<BodyDef>& bodies, std::size_t bodies_there,
                                   const World& world) {
  std::set<std::string_view> names;
  for (const BodyDef& body : bodies)
    if (world.find(body.name) || !names.insert(body.name).second)
      return Refusal{ResultCode::name_taken, "there is a body '" + body.name + "' already"};
  if (bodies_there + bodies.size() > kMaxBodies)
    return Refusal{ResultCode::operation_failed, std::to_string(bodies_there) +
                                                     " bodies are there, at most " +
                                                     std::to_string(kMaxBodies) + " can be"};
  return std::nullopt;
}

std::optional<Refusal> check_overlaps(const std::vector<BodyDef>& bodies, const Scene& scene,
                                      const World& world) {
  if (scene.allow_overlap) return std::nullopt;
  Scene near = neighbourhood(bodies, scene, world);
  const std::size_t first_new = near.bodies.size();
  for (const BodyDef& body : bodies)
    if (!has_mesh(body)) near.bodies.push_back(body);
  add_rules_of(near, scene);
  // The second body of a fault comes later in the scene: of two that were there it is none of ours.
  for (std::size_t k = first_new; k < near.bodies.size(); ++k)
    near.bodies[k].where = near.bodies[k].name;
  for (std::size_t k = 0; k < first_new; ++k) near.bodies[k].where.clear();
  for (const SceneFault& fault : find_overlaps(near))
    if (!fault.where.empty()) return Refusal{ResultCode::operation_failed, fault.what};
  return std::nullopt;
}

}  // namespace poinsot
