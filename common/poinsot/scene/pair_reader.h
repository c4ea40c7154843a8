// Pairs of a scene file: YAML → PairDef. Faults, `path` and `names_known` as in force_reader.h.

#pragma once

#include <string>

#include "poinsot/scene/scene.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

PairDef read_pair(const YamlNode& node, const std::string& path, bool names_known,
                  FaultList& faults, YamlReader& reader);

}  // namespace poinsot
