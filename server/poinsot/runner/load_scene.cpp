#include "poinsot/runner/load_scene.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/base/names.h"
#include "poinsot/collision/collision_layer.h"
#include "poinsot/scene/scene_file.h"

namespace poinsot {
namespace {

constexpr const char* kExtension = ".yaml";

std::vector<std::string> shipped_scenes(std::span<const std::filesystem::path> directories) {
  std::vector<std::string> names;
  std::error_code missing;  // a directory that is not there holds no scenes
  for (const auto& directory : directories)
    for (const auto& entry : std::filesystem::directory_iterator(directory, missing))
      if (entry.path().extension() == kExtension) names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string list_of(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "none found" : list;
}

}  // namespace

std::filesystem::path find_scene(const std::string& scene,
                                 std::span<const std::filesystem::path> directories) {
  if (std::filesystem::is_regular_file(scene)) return scene;
  for (const auto& directory : directories)
    if (const auto file = directory / (scene + kExtension); std::filesystem::is_regular_file(file))
      return file;
  const std::vector<std::string> names = shipped_scenes(directories);
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw Error("scene '" + scene + "': no such file and no shipped scene" +
              did_you_mean(scene, candidates) + " (shipped: " + list_of(names) + ")");
}

Scene load_scene(const std::filesystem::path& file) {
  Scene scene = read_scene_file(file);
  if (!scene.allow_overlap)
    if (const auto overlaps = find_overlaps(scene); !overlaps.empty()) throw_faults(overlaps);
  return scene;
}

}  // namespace poinsot
