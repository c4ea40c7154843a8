#include "poinsot/scene/mesh.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "poinsot/base/error.h"
#include "poinsot/base/hash.h"
#include "poinsot/base/limits.h"
#include "poinsot/scene/fault_text.h"

namespace poinsot {
namespace {

constexpr double kThin = 1e-12;  // [-] least double area of a triangle, of its longest side squared

struct PlaceHash {
  std::size_t operator()(const Vec3& v) const {
    Hash64 hash;
    for (const double x : v) hash.add(x + 0.0);  // −0 and 0 are one place
    return static_cast<std::size_t>(hash.value());
  }
};

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest2 =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > kThin * longest2;
}

// Gives each place a number, in the order in which places come.
class Welder {
 public:
  int operator()(const Vec3& place) {
    const auto [found, is_new] = numbers_.emplace(place, static_cast<int>(places_.size()));
    if (is_new) places_.push_back(place);
    return found->second;
  }
  std::vector<Vec3> take() { return std::move(places_); }

 private:
  std::unordered_map<Vec3, int, PlaceHash> numbers_;
  std::vector<Vec3> places_;
};

}  // namespace

Mesh make_mesh(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!is_within(vertices[i], kMaxPoint))
      throw Error("vertex " + std::to_string(i + 1) + " of a mesh must be finite and at most " +
                  digits(kMaxPoint) + " m");
  Mesh mesh;
  Welder weld;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const int vertex = triangles[k][i];
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices.size())
        throw Error("triangle " + std::to_string(k + 1) + " of a mesh names vertex " +
                    std::to_string(vertex + 1LL) + " of " + std::to_string(vertices.size()));
      corner[i] = vertices[static_cast<std::size_t>(vertex)];
    }
    if (has_area(corner[0], corner[1], corner[2]))
      mesh.triangles.push_back({weld(corner[0]), weld(corner[1]), weld(corner[2])});
    else
      ++mesh.left_out;
  }
  mesh.vertices = weld.take();
  if (mesh.triangles.empty()) throw Error("a mesh needs a triangle that has an area");
  if (mesh.triangles.size() > kMaxTriangles || mesh.vertices.size() > kMaxMeshVertices)
    throw Error("a mesh has at most " + std::to_string(kMaxTriangles) + " triangles and " +
                std::to_string(kMaxMeshVertices) + " vertices, this one " +
                std::to_string(mesh.triangles.size()) + " and " +
                std::to_string(mesh.vertices.size()));
  return mesh;
}

}  // namespace poinsot
