// From what a user typed to a scene that can run: finds the file, reads it, and looks for bodies
// that overlap.

#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "poinsot/scene/scene.h"

namespace poinsot {

// The file of a scene that is given as a path or as the name of a shipped scene. Shipped scenes are
// <name>.yaml in one of the directories; a file of that name in the working directory goes first.
// Throws Error that lists the shipped scenes, with the nearest.
std::filesystem::path find_scene(const std::string& scene,
                                 std::span<const std::filesystem::path> directories);

// Throws Error with all faults of the file, each with its place; overlapping bodies are faults
// unless the scene allows them.
Scene load_scene(const std::filesystem::path& file);

}  // namespace poinsot
