#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "poinsot/collision/broad_phase.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/collision/collision_state.h"
#include "poinsot/collision/proximity.h"
#include "poinsot/scene/pair_rules.h"

namespace poinsot {
namespace {

std::string depth_in_words(double depth) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g m", depth);
  return text;
}

}  // namespace

std::vector<SceneFault> find_overlaps(const Scene& scene) {
  const std::vector<Collider> colliders = make_colliders(scene);
  std::vector<Pose> poses;
  BroadPhase broad_phase(colliders);
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    const BodyDef& body = scene.bodies[static_cast<std::size_t>(colliders[i].body)];
    const Pose of_center{body.pose * body.mass_properties.center_of_mass, body.pose.q};
    poses.push_back(of_center * colliders[i].in_body);
    const auto k = static_cast<int>(i);
    broad_phase.set_moves(k, !body.is_static && !body.is_kinematic);
    if (!std::isinf(colliders[i].size)) broad_phase.set(k, bounds(colliders[i], poses[i]));
  }

  // The deepest of each pair of bodies.
  std::map<std::pair<Eigen::Index, Eigen::Index>, double> depths;
  const PairRules rules(scene);
  for (const auto& [i, j] : broad_phase.pairs()) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    if (!rules.collide(colliders[a].body, colliders[b].body)) continue;
    const double depth = -find_gap(colliders[a], poses[a], colliders[b], poses[b]).value;
    if (depth <= scene.collision.overlap * std::min(colliders[a].size, colliders[b].size)) continue;
    double& deepest = depths[{colliders[a].body, colliders[b].body}];
    deepest = std::max(deepest, depth);
  }
  std::vector<SceneFault> faults;
  for (const auto& [pair, depth] : depths) {
    const BodyDef& first = scene.bodies[static_cast<std::size_t>(pair.first)];
    const BodyDef& second = scene.bodies[static_cast<std::size_t>(pair.second)];
    faults.push_back({second.where,
                      "body '" + second.name + "' overlaps '" + first.name + "' by " +
                          depth_in_words(depth) + "; move it, or set allow_overlap: true",
                      "bodies[" + std::to_string(pair.second) + "]"});
  }
  return faults;
}

}  // namespace poinsot
