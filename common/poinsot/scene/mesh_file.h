// Mesh files: Wavefront OBJ, and STL in both forms.
//
// Of an OBJ file `v` and `f` are read; a face of more than three corners must be convex and is cut
// into a fan; lines of texture, normals, groups, materials, points and curves are passed over. Of
// an STL file the corners are read; its normals are not trusted. Which form a file has is told by
// its name's extension, and whether an STL file is binary by its length.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "poinsot/scene/shape.h"

namespace poinsot {

inline constexpr std::size_t kMaxMeshFile = std::size_t{64} << 20U;  // [bytes]

// Throws Error: "file: …" or "file:line: …".
Mesh read_mesh_file(const std::filesystem::path& file);

// `name` begins the messages.
Mesh read_obj(std::string_view text, const std::string& name);
Mesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace poinsot
