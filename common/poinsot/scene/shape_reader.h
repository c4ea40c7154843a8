// One shape of a scene file: `{box: [1, 1, 1], position: …, orientation: …, density: …}`.

#pragma once

#include <string>
#include <string_view>

#include "poinsot/scene/scene.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

struct ShapeEntry {
  ShapeDef def;
  bool has_density = false;
  double density = 0;  // [kg/m³] its own, if it has one
  bool sound = false;  // read without a fault: mass properties may be asked for
};

// Faults go to the list; a shape that could not be read is not sound and is some sphere. `path` is
// that of the shape in the scene, "bodies[2].shapes[0]".
ShapeEntry read_shape(const YamlNode& node, std::string_view what, const std::string& path,
                      FaultList& faults, YamlReader& reader);

}  // namespace poinsot
