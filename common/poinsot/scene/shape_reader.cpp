#include "poinsot/scene/shape_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/scene/mesh_file.h"
#include "poinsot/scene/pose_reader.h"

namespace poinsot {
namespace {

std::optional<Shape> read_sphere(const YamlNode& node, FaultList&, YamlReader& reader) {
  const auto radius = reader.number(node, "sphere");
  return radius ? std::optional<Shape>(Sphere{*radius}) : std::nullopt;
}

std::optional<Shape> read_box(const YamlNode& node, FaultList&, YamlReader& reader) {
  const auto size = reader.vector(node, "box");
  return size ? std::optional<Shape>(Box{*size}) : std::nullopt;
}

std::optional<Shape> read_ellipsoid(const YamlNode& node, FaultList&, YamlReader& reader) {
  const auto semi_axes = reader.vector(node, "ellipsoid");
  return semi_axes ? std::optional<Shape>(Ellipsoid{*semi_axes}) : std::nullopt;
}

// Capsule, cylinder and cone have the same two keys.
template <class Round, std::size_t kIndex>
std::optional<Shape> read_round(const YamlNode& node, FaultList&, YamlReader& reader) {
  constexpr std::string_view kind = kShapeNames[kIndex];
  const auto fields = reader.fields(node, kind, kRoundTable);
  if (!fields) return std::nullopt;
  const YamlNode* radius_node = reader.required(*fields, node, kind, "radius");
  const YamlNode* length_node = reader.required(*fields, node, kind, "length");
  const auto radius = radius_node ? reader.number(*radius_node, "radius") : std::nullopt;
  const auto length = length_node ? reader.number(*length_node, "length") : std::nullopt;
  if (!radius || !length) return std::nullopt;
  return Round{*radius, *length};
}

// True: the shape has the key `file`, and its text may name none.
bool refuse_file(const YamlNode& node, FaultList& faults, const YamlReader& reader) {
  if (reader.may_name_files()) return false;
  const auto found = std::ranges::find_if(
      node.entries, [](const YamlNode::Entry& entry) { return entry.first->text == "file"; });
  if (found == node.entries.end()) return false;
  faults.add(*found->first, "a fragment may name no file");
  return true;
}

std::optional<Shape> read_convex(const YamlNode& node, FaultList& faults, YamlReader& reader) {
  if (refuse_file(node, faults, reader)) return std::nullopt;
  const auto fields = reader.fields(node, "convex", kConvexTable);
  if (!fields) return std::nullopt;
  if (fields->entries.size() < node.entries.size()) return std::nullopt;  // a key was refused
  const YamlNode* points_node = reader.required(*fields, node, "convex", "points");
  const auto* items = points_node ? reader.list(*points_node, "points") : nullptr;
  if (!items) return std::nullopt;
  std::vector<Vec3> points;
  for (const YamlNode* item : *items)
    if (const auto point = reader.vector(*item, "a point")) points.push_back(*point);
  if (points.size() < items->size()) return std::nullopt;
  try {
    return convex_hull(points);
  } catch (const Error& error) {
    faults.add(*points_node, error.what());
    return std::nullopt;
  }
}

std::optional<Shape> read_half_space(const YamlNode& node, FaultList& faults, YamlReader& reader) {
  const auto fields = reader.fields(node, "half_space", kHalfSpaceTable);
  if (!fields) return std::nullopt;
  const YamlNode* normal_node = reader.required(*fields, node, "half_space", "normal");
  const YamlNode* offset_node = fields->find("offset");
  const auto normal = normal_node ? reader.vector(*normal_node, "normal") : std::nullopt;
  const auto offset = offset_node ? reader.number(*offset_node, "offset") : 0.0;
  if (!normal || !offset) return std::nullopt;
  const double length = normal->stableNorm();
  if (length > 0 && std::isfinite(length)) return HalfSpace{*normal / length, *offset};
  faults.add(*normal_node, "normal must not be zero");
  return std::nullopt;
}

std::optional<Shape> read_mesh(const YamlNode& node, FaultList& faults, YamlReader& reader) {
  if (refuse_file(node, faults, reader)) return std::nullopt;
  const auto fields = reader.fields(node, "mesh", kMeshTable);
  if (!fields) return std::nullopt;
  if (fields->entries.size() < node.entries.size()) return std::nullopt;  // a key was refused
  const YamlNode* file_node = reader.required(*fields, node, "mesh", "file");
  const auto file = file_node ? reader.text(*file_node, "file") : std::nullopt;
  if (!file) return std::nullopt;
  Mesh mesh;
  try {
    // Relative to the scene file; an absolute path stays as it is.
    mesh = read_mesh_file(std::filesystem::path(faults.file()).parent_path() / *file);
  } catch (const Error& error) {
    faults.add(*file_node, error.what());
    return std::nullopt;
  }
  reader.count(*file_node, 3 * (mesh.vertices.size() + mesh.triangles.size()));
  return mesh;
}

// In the order of the variant, like kShapeNames.
using Read = std::optional<Shape> (*)(const YamlNode&, FaultList&, YamlReader&);
constexpr std::array<Read, kShapeNames.size()> kReaders = {read_sphere,
                                                           read_box,
                                                           read_round<Capsule, 2>,
                                                           read_round<Cylinder, 3>,
                                                           read_round<Cone, 4>,
                                                           read_ellipsoid,
                                                           read_convex,
                                                           read_half_space,
                                                           read_mesh};

std::optional<std::size_t> kind_of(const YamlNode::Entry& entry) {
  const auto name = std::ranges::find(kShapeNames, entry.first->text);
  if (name == kShapeNames.end()) return std::nullopt;
  return static_cast<std::size_t>(name - kShapeNames.begin());
}

// The one key that names a kind of shape.
const YamlNode::Entry* find_kind(const YamlNode& node, const Fields& fields, FaultList& faults) {
  const auto is_kind = [](const YamlNode::Entry& entry) { return kind_of(entry).has_value(); };
  const auto kinds = std::ranges::count_if(fields.entries, is_kind);
  if (kinds == 1) return &*std::ranges::find_if(fields.entries, is_kind);
  const bool refused = fields.entries.size() < node.entries.size();  // misspelt, say, and reported
  if (kinds == 0 && refused) return nullptr;
  std::string names;
  for (const std::string_view name : kShapeNames)
    names.append(names.empty() ? "" : ", ").append(name);
  faults.add(node, "a shape must have exactly one of " + names);
  return nullptr;
}

}  // namespace

ShapeEntry read_shape(const YamlNode& node, std::string_view what, const std::string& path,
                      FaultList& faults, YamlReader& reader) {
  ShapeEntry entry;
  entry.def.shape = Sphere{1};
  faults.place(path, node);
  const auto fields = reader.fields(node, what, kShapeTable);
  if (!fields) return entry;
  if (const YamlNode::Entry* kind = find_kind(node, *fields, faults)) {
    faults.place(path + ".shape", *kind->second);
    const auto shape = kReaders[*kind_of(*kind)](*kind->second, faults, reader);
    entry.sound = shape && shape_fault(*shape).empty();
    if (shape) entry.def.shape = *shape;
  }
  read_pose(*fields, path, entry.def.pose, faults, reader);
  if (const YamlNode* density = fields->find("density")) {
    const auto value = reader.positive(*density, "density", "kg/m³");
    entry.has_density = true;
    entry.density = value.value_or(0);
    entry.sound = entry.sound && value;
  }
  return entry;
}

}  // namespace poinsot
