#include "poinsot/collision/box_box.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace poinsot {
namespace {

// Edges more parallel than this span no axis; the faces cover that case.
constexpr double kParallelEdges = 1e-6;
// An edge axis this near a face normal keeps the face's manifold; cos(0.02 rad).
constexpr double kNearFace = 0.9998;

struct Halves {
  Vec3 a, b;  // [m] half-lengths
};

struct Axis {
  double gap = -std::numeric_limits<double>::infinity();  // [m]
  Vec3 normal = Vec3::UnitZ();                            // unit, from B to A, in A
  bool of_a = true;                                       // a face's
  Eigen::Index i = 0;                                     // of the face, or of A's edge
  Eigen::Index j = -1;                                    // of B's edge; −1 for a face
};

// Best of the six faces; any of them may exceed the margin, which ends the search.
Axis best_face(const ConvexPair& pair, const Halves& half, const Mat3& abs_R) {
  const Vec3 c_B = pair.R.transpose() * pair.c;
  const Vec3 gap_a = pair.c.cwiseAbs() - half.a - abs_R * half.b;
  const Vec3 gap_b = c_B.cwiseAbs() - half.b - abs_R.transpose() * half.a;
  Axis best;
  const double a = gap_a.maxCoeff(&best.i);
  best.gap = a;
  Eigen::Index j = 0;
  const double b = gap_b.maxCoeff(&j);
  if (b > a + kEdgeAdvantage * pair.small)
    best = {b, pair.R.col(j), false, j, -1};
  else
    best.normal = Vec3::Unit(best.i);
  if (best.normal.dot(pair.c) > 0) best.normal = -best.normal;
  return best;
}

// Improves on a face by the nine crossed edges; stops as soon as one exceeds the margin.
void improve_by_edges(const ConvexPair& pair, const Halves& half, const Mat3& abs_R, double margin,
                      Axis& best) {
  const Mat3& R = pair.R;
  const double to_beat = best.gap + kEdgeAdvantage * pair.small;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (Eigen::Index j = 0; j < 3; ++j) {
      const Eigen::Index j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      // The axis is e_i × R_j, which has no part along e_i.
      const double u = -R(i2, j), v = R(i1, j), length2 = u * u + v * v;
      if (length2 < kParallelEdges * kParallelEdges) continue;
      const double along = pair.c[i1] * u + pair.c[i2] * v;
      const double reach = half.a[i1] * abs_R(i2, j) + half.a[i2] * abs_R(i1, j) +
                           half.b[j1] * abs_R(i, j2) + half.b[j2] * abs_R(i, j1);
      const double length = std::sqrt(length2), gap = (std::abs(along) - reach) / length;
      if (gap <= to_beat || gap <= best.gap) continue;
      const double sign = (along > 0 ? -1 : 1) / length;
      best = {gap, Vec3::Zero(), false, i, j};
      best.normal[i1] = sign * u;
      best.normal[i2] = sign * v;
      if (gap > margin) return;
    }
  }
}

// The middle of the edge along `axis` that lies most along d, in the box's own frame.
Vec3 edge_middle(const Vec3& half, Eigen::Index axis, const Vec3& d) {
  Vec3 p;
  for (Eigen::Index k = 0; k < 3; ++k) p[k] = k == axis ? 0.0 : (d[k] < 0 ? -half[k] : half[k]);
  return p;
}

// Of the twelve edges, the one along `axis` that lies most along d.
std::uint32_t edge_number(Eigen::Index axis, const Vec3& d) {
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  return static_cast<std::uint32_t>(axis) * 4 + (d[u] < 0 ? 0 : 1) + (d[v] < 0 ? 0 : 2);
}

// The nearest points of the two edges; false if they lie beyond an end.
bool crossing_edges(const ConvexPair& pair, const Halves& half, const Axis& axis,
                    Witness& witness) {
  const Vec3 p = edge_middle(half.a, axis.i, -axis.normal);
  const Vec3 q = pair.c + pair.R * edge_middle(half.b, axis.j, pair.R.transpose() * axis.normal);
  const Vec3 u = Vec3::Unit(axis.i), v = pair.R.col(axis.j);
  const double uv = u.dot(v), det = u.cross(v).squaredNorm();
  const Vec3 d = q - p;
  const double s = (d.dot(u) - uv * d.dot(v)) / det, t = (uv * d.dot(u) - d.dot(v)) / det;
  witness = {axis.normal, p + s * u, q + t * v, axis.gap};
  const double slack = pair.rounding() / det;
  return std::abs(s) <= half.a[axis.i] + slack && std::abs(t) <= half.b[axis.j] + slack;
}

// Corners of the incident face seen from the reference face: beside its middle, above its plane.
using Corner = Candidate;
using Corners =
    std::array<Corner, 12>;  // a quadrilateral cut by four sides has eight; and to spare

// Keeps the part with sign·(u or v) ≤ limit. `side`: the number of what cuts.
template <double Corner::*kAlong>
int cut(const Corners& from, int count, double sign, double limit, std::uint32_t side,
        Corners& to) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const Corner& p = from[static_cast<std::size_t>(i)];
    const Corner& q = from[static_cast<std::size_t>(i + 1 == count ? 0 : i + 1)];
    const double dp = sign * p.*kAlong - limit, dq = sign * q.*kAlong - limit;
    if (dp <= 0) to[static_cast<std::size_t>(kept++)] = p;
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      const double t = dp / (dp - dq);
      to[static_cast<std::size_t>(kept++)] = {p.u + t * (q.u - p.u), p.v + t * (q.v - p.v),
                                              p.gap + t * (q.gap - p.gap),
                                              edge_cut(p.feature, side, dq > 0)};
    }
  }
  return kept;
}

// A face of one box and the most opposed face of the other, in the frame of the first.
struct FacePair {
  Eigen::Index axis, u, v;  // of the reference box: across its face, and within it
  double side;              // of the reference face on its axis
  Vec3 half;                // [m] of the reference box
  Corners incident;

  // R, c: the incident box in the frame of the reference box. `side`: of the face that touches.
  FacePair(const Vec3& half_, const Vec3& other_half, const auto& R, const Vec3& c,
           Eigen::Index axis_, double side_, bool incident_is_a)
      : axis(axis_), u((axis_ + 1) % 3), v((axis_ + 2) % 3), side(side_), half(half_) {
    Eigen::Index k = 0;
    R.row(axis).cwiseAbs().maxCoeff(&k);
    const Eigen::Index k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const double facing = side * R(axis, k) > 0 ? -1 : 1;
    const Vec3 middle = c + facing * other_half[k] * R.col(k);
    const Vec3 x = other_half[k1] * R.col(k1), y = other_half[k2] * R.col(k2);
    const std::uint32_t low = facing > 0 ? 1u << k : 0u, bit1 = 1u << k1, bit2 = 1u << k2;
    incident[0] = seen(middle + x + y, corner_of(incident_is_a, low + bit1 + bit2));
    incident[1] = seen(middle - x + y, corner_of(incident_is_a, low + bit2));
    incident[2] = seen(middle - x - y, corner_of(incident_is_a, low));
    incident[3] = seen(middle + x - y, corner_of(incident_is_a, low + bit1));
  }
  Corner seen(const Vec3& p, std::uint32_t feature) const {
    return {p[u], p[v], side * p[axis] - half[axis], feature};
  }

  // Cuts the incident face to the outline of the reference face; how many corners are left.
  int clip(double slack) {
    Corners other;
    const std::uint32_t first = static_cast<std::uint32_t>(axis) * 8 + (side > 0 ? 4 : 0);
    int n = cut<&Corner::u>(incident, 4, 1, half[u] + slack, first, other);
    n = cut<&Corner::u>(other, n, -1, half[u] + slack, first + 1, incident);
    n = cut<&Corner::v>(incident, n, 1, half[v] + slack, first + 2, other);
    return cut<&Corner::v>(other, n, -1, half[v] + slack, first + 3, incident);
  }
  // Midway between the two surfaces, in the frame of the reference box.
  Vec3 middle(const Corner& corner) const {
    Vec3 p;
    p[axis] = side * (half[axis] + 0.5 * corner.gap);
    p[u] = corner.u;
    p[v] = corner.v;
    return p;
  }
};

// False if nothing lies above the face as deep as the axis says.
bool clip_faces(const ConvexPair& pair, const Halves& half, const Axis& axis, double margin,
                Manifold& manifold) {
  const Vec3& n = axis.normal;
  const Mat3& R = pair.R;
  FacePair faces = axis.of_a ? FacePair(half.a, half.b, R, pair.c, axis.i, -n[axis.i], false)
                             : FacePair(half.b, half.a, R.transpose(), -(R.transpose() * pair.c),
                                        axis.i, n.dot(R.col(axis.i)), true);
  int count = 0;
  double least = std::numeric_limits<double>::infinity();
  const int clipped = faces.clip(pair.rounding());
  for (int i = 0; i < clipped; ++i) {
    const Corner corner = faces.incident[static_cast<std::size_t>(i)];
    if (corner.gap > margin) continue;
    least = std::min(least, corner.gap);
    faces.incident[static_cast<std::size_t>(count++)] = corner;
  }
  if (least > axis.gap + 2 * kEdgeAdvantage * pair.small) return false;
  const Choice choice = choose_points({faces.incident.data(), static_cast<std::size_t>(count)},
                                      kSameGap * std::min(pair.a.size, pair.b.size));
  manifold.normal = n;
  manifold.count = choice.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(choice.count); ++k) {
    const Corner& corner = faces.incident[choice.index[k]];
    const Vec3 p = faces.middle(corner);
    manifold.points[k] = {axis.of_a ? p : Vec3(pair.c + R * p), corner.gap, corner.feature};
  }
  return true;
}

// Whether an edge axis is all but normal to a face: then many points touch, not one.
bool near_a_face(const ConvexPair& pair, const Vec3& n) {
  return std::max(n.cwiseAbs().maxCoeff(), (pair.R.transpose() * n).cwiseAbs().maxCoeff()) >=
         kNearFace;
}

}  // namespace

bool box_box(const ConvexPair& pair, double margin, Manifold& manifold) {
  manifold.clear();
  const Halves half = {0.5 * std::get<Box>(pair.a.shape).size,
                       0.5 * std::get<Box>(pair.b.shape).size};
  const Mat3 abs_R = pair.R.cwiseAbs();
  Axis axis = best_face(pair, half, abs_R);
  if (axis.gap > margin) return true;
  improve_by_edges(pair, half, abs_R, margin, axis);
  if (axis.gap > margin) return true;
  if (axis.j < 0) return clip_faces(pair, half, axis, margin, manifold);
  Witness witness;
  if (!crossing_edges(pair, half, axis, witness)) return false;
  if (near_a_face(pair, axis.normal)) {
    build_manifold(pair, witness, margin, manifold);
    return true;
  }
  manifold.normal = axis.normal;
  const std::uint32_t edge_a = edge_number(axis.i, -axis.normal),
                      edge_b = edge_number(axis.j, pair.R.transpose() * axis.normal);
  manifold.points[0] = {0.5 * (witness.on_a + witness.on_b), witness.gap,
                        edge_cut(corner_of(true, edge_a), edge_b, false)};
  manifold.count = 1;
  return true;
}

}  // namespace poinsot
