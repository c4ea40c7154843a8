// One body of a scene file: YAML → BodyDef. Reads shapes, masses, pose, velocities, material,
// drag.

#pragma once

#include <string>

#include "poinsot/scene/scene.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

// Faults go to the list; what could not be read keeps a harmless value. `path` is that of the body
// in the scene, "bodies[2]".
BodyDef read_body(const YamlNode& node, const std::string& path, FaultList& faults,
                  YamlReader& reader);

}  // namespace poinsot
