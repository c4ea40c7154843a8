// A tree of boxes over the triangles of a mesh. Lengths in metres, in the frame of the mesh.
//
// FCL builds it, in mesh_bvh.cpp; it is walked here, because FCL's own walks answer with contacts
// and distances that are not exact. Does not change after it was built; may be asked by many
// threads at once. The depth is at most twice log2 of the number of triangles.

#pragma once

#include <array>
#include <span>
#include <vector>

#include "poinsot/math/types.h"

namespace poinsot {

class MeshBvh {
 public:
  struct Node {
    Vec3 low, high;   // [m] box of all triangles below
    int left, right;  // nodes; −1: a leaf
    int triangle;     // of a leaf
  };

  MeshBvh() = default;
  MeshBvh(std::span<const Vec3> vertices, std::span<const std::array<int, 3>> triangles);

  const Node& root() const { return nodes_[0]; }

  // Calls visit(triangle) for those whose boxes overlap the box low … high, in no order to rely on.
  template <class Visit>
  void overlapping(const Vec3& low, const Vec3& high, Visit&& visit) const {
    overlapping(0, low, high, visit);
  }

  // Calls visit(triangle) → a distance [m], nearest boxes first, until all other triangles' boxes
  // are farther from the box low … high than the least distance that a visit returned. Starts with
  // `least`, returns the least.
  template <class Visit>
  double nearest(const Vec3& low, const Vec3& high, double least, Visit&& visit) const {
    visit_nearest(0, low, high, least, visit);
    return least;
  }

 private:
  const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  static double distance2(const Node& node, const Vec3& low, const Vec3& high) {
    return (node.low - high).cwiseMax(low - node.high).cwiseMax(0).squaredNorm();
  }

  template <class Visit>
  void overlapping(int i, const Vec3& low, const Vec3& high, Visit& visit) const {
    const Node& n = node(i);
    if (!((n.low.array() <= high.array()) && (low.array() <= n.high.array())).all()) return;
    if (n.left < 0) return visit(n.triangle);
    overlapping(n.left, low, high, visit);
    overlapping(n.right, low, high, visit);
  }

  template <class Visit>
  void visit_nearest(int i, const Vec3& low, const Vec3& high, double& least, Visit& visit) const {
    const Node& n = node(i);
    // An overlapping box is always looked into: depths are below any distance of boxes.
    const double box2 = distance2(n, low, high);
    if (box2 > 0 && (least <= 0 || box2 > least * least)) return;
    if (n.left < 0) {
      least = std::min(least, visit(n.triangle));
      return;
    }
    const bool left_first =
        distance2(node(n.left), low, high) <= distance2(node(n.right), low, high);
    visit_nearest(left_first ? n.left : n.right, low, high, least, visit);
    visit_nearest(left_first ? n.right : n.left, low, high, least, visit);
  }

  std::vector<Node> nodes_;
};

}  // namespace poinsot
