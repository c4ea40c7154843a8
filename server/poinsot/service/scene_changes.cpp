#include "poinsot/service/scene_changes.h"

#include <utility>

#include "poinsot/presentation/presentation_layer.h"

namespace poinsot {
namespace {

BodyInfo info_of(const BodyDef& body, BodyId id, std::uint32_t revision) {
  return {.id = id,
          .index = id.slot,
          .revision = revision,
          .name = body.name,
          .is_static = body.is_static,
          .is_kinematic = body.is_kinematic,
          .mass_properties = body.mass_properties,
          .pose = body.pose,
          .material = body.material,
          .shapes = body.shapes};
}

bool same(const Pose& a, const Pose& b) {
  return a.c == b.c && a.q.coeffs() == b.q.coeffs();
}

}  // namespace

SceneChange SceneChanges::since_last(const PresentationLayer& layer) {
  SceneChange change;
  const std::uint32_t revision = layer.scene_revision();
  const bool anew = std::exchange(epoch_, layer.epoch()) != layer.epoch();
  if (std::exchange(revision_, revision) == revision) return change;
  const std::vector<BodyDef>& bodies = layer.scene().bodies;
  for (std::size_t i = bodies.size(); i < told_.size(); ++i)
    if (told_[i].id) change.removed.push_back(told_[i].id);
  told_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyDef& body = bodies[i];
    const BodyId id = body.absent ? BodyId{} : layer.world().ids[i];
    Told& told = told_[i];
    if (told.id && told.id != id) change.removed.push_back(told.id);
    const bool moved = body.is_static && !same(told.pose, body.pose);
    if (id && (anew || told.id != id || moved)) change.added.push_back(info_of(body, id, revision));
    told = {id, body.pose};
  }
  return change;
}

}  // namespace poinsot
