// Scene files: YAML → Scene. The keys, their units and defaults are listed in README.md beside this
// file; unknown, duplicate or misplaced keys are errors that name file:line:col and the nearest
// valid key. All semantic errors of a file are reported in one Error; a syntax error alone.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "poinsot/scene/scene.h"

namespace poinsot {

// Throws Error when the file cannot be read or is not a valid scene.
Scene read_scene_file(const std::filesystem::path& file);

// The same for text in memory; `name` stands for the file in messages and names the world if the
// text does not.
Scene read_scene_text(std::string_view text, const std::string& name);

}  // namespace poinsot
