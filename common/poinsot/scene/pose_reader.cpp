#include "poinsot/scene/pose_reader.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "poinsot/math/rotation.h"

namespace poinsot {
namespace {

constexpr double kNormSlack = 1e-3;  // [-] a quaternion written with three digits is well meant
constexpr double kMaxAngle = 1e5;    // [rad] beyond, sin_cos loses digits; see math/elementary.h

void read_roll_pitch_yaw(const YamlNode& node, Quat& q, FaultList& faults, YamlReader& reader) {
  const auto rpy = reader.vector(node, "rpy");
  if (!rpy) return;
  if (rpy->cwiseAbs().maxCoeff() > kMaxAngle)
    faults.add(node, "rpy must be angles in rad, at most 1e5");
  else
    q = from_roll_pitch_yaw(*rpy);
}

void read_quaternion(const YamlNode& node, const Fields& keys, Quat& q, FaultList& faults,
                     YamlReader& reader) {
  constexpr std::array<std::string_view, 4> names = {"x", "y", "z", "w"};
  Eigen::Vector4d xyzw;
  bool complete = true;
  for (int i = 0; i < 4; ++i) {
    const std::string_view name = names[static_cast<std::size_t>(i)];
    const YamlNode* value = reader.required(keys, node, "orientation", name);
    const auto number = value ? reader.number(*value, name) : std::nullopt;
    complete = complete && number;
    xyzw[i] = number.value_or(0);
  }
  if (!complete) return;
  const double norm = xyzw.stableNorm();
  if (std::abs(norm - 1) <= kNormSlack) {
    q = Quat(Eigen::Vector4d(xyzw / norm));
    return;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", norm);
  faults.add(node, norm > 0 ? std::string("orientation must have norm 1, has ") + text
                            : "orientation must not be the zero quaternion");
}

void read_orientation(const YamlNode& node, Quat& q, FaultList& faults, YamlReader& reader) {
  if (node.kind == YamlNode::Kind::list) {
    faults.add(node,
               "orientation must be {x, y, z, w} or {rpy: [roll, pitch, yaw]}: a bare list does "
               "not tell the order");
    return;
  }
  const auto keys = reader.fields(node, "orientation", kOrientationTable);
  if (!keys) return;
  const YamlNode* rpy = keys->find("rpy");
  if (rpy && keys->entries.size() > 1)
    faults.add(node, "orientation must have either rpy or x, y, z, w");
  else if (rpy)
    read_roll_pitch_yaw(*rpy, q, faults, reader);
  else
    read_quaternion(node, *keys, q, faults, reader);
}

}  // namespace

bool read_number(const Fields& fields, std::string_view key, const std::string& path, double& value,
                 FaultList& faults, YamlReader& reader) {
  const YamlNode* node = fields.find(key);
  if (!node) return true;
  faults.place(std::string(path).append(".").append(key), *node);
  const auto number = reader.number(*node, key);
  value = number.value_or(value);
  return number.has_value();
}

bool read_vector(const Fields& fields, std::string_view key, const std::string& path, Vec3& value,
                 FaultList& faults, YamlReader& reader) {
  const YamlNode* node = fields.find(key);
  if (!node) return true;
  faults.place(std::string(path).append(".").append(key), *node);
  const auto vector = reader.vector(*node, key);
  value = vector.value_or(value);
  return vector.has_value();
}

void read_pose(const Fields& fields, const std::string& path, Pose& pose, FaultList& faults,
               YamlReader& reader) {
  read_vector(fields, "position", path, pose.c, faults, reader);
  if (const YamlNode* node = fields.find("orientation"))
    read_orientation(*node, pose.q, faults, reader);
}

}  // namespace poinsot
