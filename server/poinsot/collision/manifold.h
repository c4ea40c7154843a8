// Where two shapes touch or nearly touch: a plane and up to four points.
//
// Gaps are signed distances along the normal: positive apart, negative penetrating. Points nearer
// than the margin are kept, not only penetrating ones, so that a manifold does not flicker when a
// face tilts by 1e-3 rad. Points lie midway between the two surfaces.

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "poinsot/collision/collider.h"
#include "poinsot/collision/gjk.h"

namespace poinsot {

// What makes a point: a number that stays while the same corners, edges and faces meet, whichever
// way the pair is asked for, and that no other point of the manifold has. Either the nearest point
// of the pair, which is nothing in particular, or a corner of one shape, or an edge of one cut by a
// side of the other's face; crossed edges count as the latter.
inline constexpr std::uint32_t kNearestFeature = 0;
constexpr std::uint32_t corner_of(bool a, std::uint32_t corner) {
  return (a ? 0x80000000u : 0x40000000u) | (corner & 0x7fffu);
}
constexpr std::uint32_t edge_cut(std::uint32_t edge, std::uint32_t side, bool leaving) {
  return (edge & 0xc0007fffu) | (leaving ? 0x8000u : 0u) | (((side + 1) & 0x3fffu) << 16);
}

struct ManifoldPoint {
  Vec3 point;      // [m]
  double gap = 0;  // [m]
  std::uint32_t feature = kNearestFeature;
};

struct Manifold {
  static constexpr int kMaxPoints = 4;

  Vec3 normal = Vec3::UnitZ();  // unit, from B to A
  std::array<ManifoldPoint, kMaxPoints> points;
  int count = 0;

  void clear() { count = 0; }
};

// Where a query found the cores nearest or deepest, in A's frame.
struct Witness {
  Vec3 normal;      // unit, from B to A
  Vec3 on_a, on_b;  // [m] on the cores
  double gap = 0;   // [m] of the shapes: radii taken off
};

// The manifold about a witness, in A's frame: the features of both cores that face each other are
// clipped against one another. A pair without facing features, such as crossed edges, keeps the
// witness alone. The least gap is the witness's, or above it by less than kSameGap of the smaller
// body.
// Source: support-face clipping (Sutherland and Hodgman 1974).
void build_manifold(const ConvexPair& pair, const Witness& witness, double margin,
                    Manifold& manifold);

class PointSet;
// The points of such a manifold before they are reduced. Without `keep_witness` only what features
// that face each other have in common.
PointSet gather_points(const ConvexPair& pair, const Witness& witness, double margin,
                       bool keep_witness);

inline constexpr double kSameGap = 1e-7;  // [-] of the smaller body: gaps that count as equal

// A candidate for a manifold: its place in the contact plane, in any two perpendicular axes, and
// its gap, all in metres.
struct Candidate {
  double u, v, gap;
  std::uint32_t feature = kNearestFeature;
};

// Which up to four candidates span a manifold best: the deepest, the farthest from it, the one that
// spans the largest triangle with both, and the farthest beyond that triangle; of points on a line
// its ends and the deepest. Of candidates equally deep to within `same_gap` [m] it
// starts with a corner of theirs: with the same one, whatever the last bits of a resting body.
struct Choice {
  std::array<std::size_t, Manifold::kMaxPoints> index;
  int count = 0;
};
Choice choose_points(std::span<const Candidate> candidates, double same_gap);

// Candidates in space, gathered for one manifold.
class PointSet {
 public:
  static constexpr int kCapacity = 40;

  PointSet(const Vec3& normal, double same_gap);

  void add(const Vec3& point, double gap,
           std::uint32_t feature = kNearestFeature);  // when full, the shallowest gives way
  int count() const { return count_; }
  double least_gap() const;
  const Vec3& normal() const { return normal_; }
  const Vec3& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  double gap(int i) const { return candidates_[static_cast<std::size_t>(i)].gap; }
  void reduce_into(Manifold& manifold) const;

 private:
  Vec3 normal_, u_, v_;
  double same_gap_;
  std::array<Vec3, static_cast<std::size_t>(kCapacity)> points_;
  std::array<Candidate, static_cast<std::size_t>(kCapacity)> candidates_;
  int count_ = 0;
};

}  // namespace poinsot
