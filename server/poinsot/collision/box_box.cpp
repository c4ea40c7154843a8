#include "poinsot/collision/box_box.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace poinsot {
namespace {

// An edge axis must part the boxes by this much more than the best face, relative to the scale.
constexpr double kEdgeAdvantage = 1e-6;
// Edges more parallel than this span no axis; the faces cover that case.
constexpr double kParallelEdges = 1e-6;

struct Axis {
  double gap = -std::numeric_limits<double>::infinity();  // [m]
  Vec3 normal = Vec3::UnitZ();                            // from B to A
  int edge_a = -1, edge_b = -1;                           // box axes of the edges; −1 for a face
};

// Best of the 15, or nothing as soon as one parts the boxes by more than the margin.
std::optional<Axis> best_axis(const ConvexPair& pair, const Vec3& half_a, const Vec3& half_b,
                              double margin) {
  const Mat3& R = pair.R;
  const Mat3 absR = R.cwiseAbs();
  const Vec3 c_B = R.transpose() * pair.c;
  Axis best;
  for (int i = 0; i < 3; ++i) {
    const double gap = std::abs(pair.c[i]) - half_a[i] - absR.row(i).dot(half_b);
    if (gap > margin) return std::nullopt;
    if (gap > best.gap) best = {gap, (pair.c[i] > 0 ? -1 : 1) * Vec3(Vec3::Unit(i)), -1, -1};
  }
  for (int j = 0; j < 3; ++j) {
    const double gap = std::abs(c_B[j]) - half_b[j] - absR.col(j).dot(half_a);
    if (gap > margin) return std::nullopt;
    if (gap > best.gap) best = {gap, (c_B[j] > 0 ? -1 : 1) * Vec3(R.col(j)), -1, -1};
  }
  const double face_gap = best.gap;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 cross = Vec3::Unit(i).cross(R.col(j));
      const double length = cross.norm();
      if (length < kParallelEdges) continue;
      const Vec3 l = cross / length;
      const double along = pair.c.dot(l);
      const double gap =
          std::abs(along) - l.cwiseAbs().dot(half_a) - (R.transpose() * l).cwiseAbs().dot(half_b);
      if (gap > margin) return std::nullopt;
      if (gap > best.gap && gap > face_gap + kEdgeAdvantage * pair.scale)
        best = {gap, along > 0 ? Vec3(-l) : l, i, j};
    }
  }
  return best;
}

// The middle of the edge along `axis` that lies most along d, in the box's own frame.
Vec3 edge_middle(const Vec3& half, int axis, const Vec3& d) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = k == axis ? 0.0 : (d[k] < 0 ? -half[k] : half[k]);
  return p;
}

Witness crossing_edges(const ConvexPair& pair, const Vec3& half_a, const Vec3& half_b,
                       const Axis& axis) {
  const Vec3 p = edge_middle(half_a, axis.edge_a, -axis.normal);
  const Vec3 q =
      pair.c + pair.R * edge_middle(half_b, axis.edge_b, pair.R.transpose() * axis.normal);
  const Vec3 u = Vec3::Unit(axis.edge_a), v = pair.R.col(axis.edge_b);
  const double uv = u.dot(v), det = 1 - uv * uv;
  const Vec3 d = q - p;
  const double s = (d.dot(u) - uv * d.dot(v)) / det, t = (uv * d.dot(u) - d.dot(v)) / det;
  return {axis.normal, p + std::clamp(s, -half_a[axis.edge_a], half_a[axis.edge_a]) * u,
          q + std::clamp(t, -half_b[axis.edge_b], half_b[axis.edge_b]) * v, axis.gap};
}

}  // namespace

void box_box(const ConvexPair& pair, double margin, Manifold& manifold) {
  manifold.clear();
  const Vec3 half_a = 0.5 * std::get<Box>(pair.a.shape).size;
  const Vec3 half_b = 0.5 * std::get<Box>(pair.b.shape).size;
  const std::optional<Axis> axis = best_axis(pair, half_a, half_b, margin);
  if (!axis) return;
  if (axis->edge_a >= 0) {
    build_manifold(pair, crossing_edges(pair, half_a, half_b, *axis), margin, manifold);
    return;
  }
  // Only the plane is known: which corners touch, the clipping finds.
  const Vec3& n = axis->normal;
  const Vec3 on_a = pair.support_a(-n), on_b = pair.support_b(n);
  build_manifold(pair, {n, on_a, on_b, axis->gap, false}, margin, manifold);
}

}  // namespace poinsot
