// Triangle meshes: from a soup of triangles to a Mesh.

#pragma once

#include <array>
#include <span>

#include "poinsot/scene/shape.h"

namespace poinsot {

// Corners at the same place become one, triangles without an area (thinner than 1e-12 of their
// longest side, squared) are left out and counted, vertices that no triangle uses are dropped; the
// order of what is kept stays. Throws Error for corners that are not finite or beyond 1e9 m, for
// indices out of range, for more than fits on the bus, and if no triangle is left.
Mesh make_mesh(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles);

}  // namespace poinsot
