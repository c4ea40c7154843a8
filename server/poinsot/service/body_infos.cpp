#include "poinsot/service/body_infos.h"

namespace poinsot {

std::vector<BodyInfo> body_infos(const Scene& scene, const World& world, std::uint64_t session) {
  std::vector<BodyInfo> infos;
  infos.reserve(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const BodyDef& body = scene.bodies[i];
    infos.push_back({.session = session,
                     .id = world.ids[i],
                     .index = static_cast<std::uint32_t>(i),
                     .revision = 1,
                     .name = body.name,
                     .is_static = body.is_static,
                     .is_kinematic = body.is_kinematic,
                     .mass_properties = body.mass_properties,
                     .pose = body.pose,
                     .material = body.material,
                     .shapes = body.shapes});
  }
  return infos;
}

}  // namespace poinsot
