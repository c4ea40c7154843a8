#include "poinsot/presentation/scene_wrenches.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "poinsot/base/check.h"
#include "poinsot/presentation/held_wrenches.h"

namespace poinsot {
namespace {

WrenchCommand to_command(const WrenchDef& def, double frame_rate) {
  WrenchCommand command;
  command.client = kSceneClient;
  command.force = def.force;
  command.torque = def.torque;
  command.axes = def.axes;
  command.point = def.point;
  command.point_frame = def.point_frame;
  command.start_frame = 1 + (def.start > 0 ? frames_of(def.start, frame_rate) : 0);
  command.hold = Hold::until_cleared;
  if (def.duration) {
    command.hold = Hold::duration;
    command.duration_ns = std::max<std::int64_t>(1, std::llround(1e9 * *def.duration));
  }
  return command;
}

}  // namespace

std::vector<WrenchCommand> scene_wrenches(const Scene& scene, const World& world) {
  std::unordered_map<std::string_view, BodyId> bodies;
  for (std::size_t i = 0; i < world.names.size(); ++i) bodies.emplace(world.names[i], world.ids[i]);
  std::vector<WrenchCommand> commands;
  commands.reserve(scene.wrenches.size());
  for (const WrenchDef& def : scene.wrenches) {
    const auto body = bodies.find(def.body);
    POINSOT_CHECK(body != bodies.end());  // validate()
    WrenchCommand& command = commands.emplace_back(to_command(def, scene.presentation.frame_rate));
    command.seq = commands.size();
    command.body = body->second;
  }
  return commands;
}

}  // namespace poinsot
