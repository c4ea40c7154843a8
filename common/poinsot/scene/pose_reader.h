// Numbers, vectors, orientations and poses of a scene file. Faults go to the list; what could not
// be read keeps its value. `path` is that of the table around it in the scene,
// "bodies[2].shapes[0]".

#pragma once

#include <string>
#include <string_view>

#include "poinsot/math/pose.h"
#include "poinsot/scene/yaml_reader.h"

namespace poinsot {

// These return false if the key is there and its value could not be read.
bool read_number(const Fields& fields, std::string_view key, const std::string& path, double& value,
                 FaultList& faults, YamlReader& reader);
bool read_vector(const Fields& fields, std::string_view key, const std::string& path, Vec3& value,
                 FaultList& faults, YamlReader& reader);

// The keys `position` [m] and `orientation` ({x, y, z, w} or {rpy: [rad]}, normalised).
void read_pose(const Fields& fields, const std::string& path, Pose& pose, FaultList& faults,
               YamlReader& reader);

}  // namespace poinsot
