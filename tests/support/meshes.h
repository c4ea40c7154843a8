// Meshes for tests.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "poinsot/scene/mesh.h"

namespace poinsot::test {

// The rectangle −half … half in x and y, cut into n × n squares of two triangles each; height(x,
// y).
template <class Height>
Mesh terrain(double half, int n, Height&& height) {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = half * (2.0 * i / n - 1), y = half * (2.0 * j / n - 1);
      vertices.push_back({x, y, height(x, y)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  return make_mesh(vertices, triangles);
}

inline Mesh plane_mesh(double half, int n) {
  return terrain(half, n, [](double, double) { return 0.0; });
}

// The surface of a convex polyhedron, its faces cut into fans.
inline Mesh surface_of(const Convex& convex) {
  std::vector<std::array<int, 3>> triangles;
  for (const Convex::Face& face : convex.faces)
    for (std::size_t k = 2; k < face.loop.size(); ++k)
      triangles.push_back({face.loop[0], face.loop[k - 1], face.loop[k]});
  return make_mesh(convex.vertices, triangles);
}

// Turned inside out.
inline Mesh turned(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace poinsot::test
