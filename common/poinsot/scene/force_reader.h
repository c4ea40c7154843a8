// Springs and wrenches of a scene file: YAML → SpringDef, WrenchDef.
//
// Faults go to the list; what could not be read keeps a harmless value. `path` is that of the entry
// in the scene, "springs[2]". `names_known`: all bodies' names could be read, so that a name that
// is not among them is a fault.

#pragma once

#include <string>

#include "poinsot/scene/scene.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

SpringDef read_spring(const YamlNode& node, const std::string& path, bool names_known,
                      FaultList& faults, YamlReader& reader);

WrenchDef read_wrench(const YamlNode& node, const std::string& path, bool names_known,
                      FaultList& faults, YamlReader& reader);

}  // namespace poinsot
