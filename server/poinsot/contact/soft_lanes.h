// Four doubles side by side, and vectors of them: the arithmetic of the soft step's kernels. Lanes
// never mix but where they are transposed, and nothing is fused: every register width gives the
// same bits. All of it is inlined into kernels that are compiled for one width each.

#pragma once

#include <cmath>
#include <cstdint>

// No such value crosses a call: what its convention would be does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace poinsot {

constexpr int kLanes = 4;
using Lanes = double __attribute__((vector_size(32), aligned(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32), aligned(32)));

#define POINSOT_INLINE [[gnu::always_inline]] inline

POINSOT_INLINE Lanes all_lanes(double x) {
  return Lanes{x, x, x, x};
}
POINSOT_INLINE Lanes positive_part(Lanes x) {
  return x > 0.0 ? x : Lanes{};
}
POINSOT_INLINE Lanes smaller(Lanes x, Lanes y) {
  return x < y ? x : y;
}
POINSOT_INLINE Lanes larger(Lanes x, Lanes y) {
  return x > y ? x : y;
}
POINSOT_INLINE Lanes magnitude(Lanes x) {
  return x < 0.0 ? -x : x;
}
// By halves: std::sqrt would call a function where an argument is negative.
POINSOT_INLINE Lanes root(Lanes x) {
#ifdef __x86_64__
  using Half = double __attribute__((vector_size(16)));
  const Half low = __builtin_ia32_sqrtpd(Half{x[0], x[1]});
  const Half high = __builtin_ia32_sqrtpd(Half{x[2], x[3]});
  return Lanes{low[0], low[1], high[0], high[1]};
#else
  return Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

struct Vec3Lanes {
  Lanes x, y, z;
};

POINSOT_INLINE Vec3Lanes operator+(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
POINSOT_INLINE Vec3Lanes operator-(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
POINSOT_INLINE Vec3Lanes operator*(const Vec3Lanes& a, Lanes s) {
  return {a.x * s, a.y * s, a.z * s};
}
POINSOT_INLINE Lanes dot(const Vec3Lanes& a, const Vec3Lanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
POINSOT_INLINE Vec3Lanes cross(const Vec3Lanes& a, const Vec3Lanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A symmetric matrix: xx xy xz yy yz zz.
struct Sym3Lanes {
  Lanes xx, xy, xz, yy, yz, zz;
};

POINSOT_INLINE Vec3Lanes operator*(const Sym3Lanes& m, const Vec3Lanes& a) {
  return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
          m.xz * a.x + m.yz * a.y + m.zz * a.z};
}

// Four rows of four become four columns.
POINSOT_INLINE void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shuffle(a, b, LaneMask{0, 4, 2, 6});
  const Lanes ab_odd = __builtin_shuffle(a, b, LaneMask{1, 5, 3, 7});
  const Lanes cd_even = __builtin_shuffle(c, d, LaneMask{0, 4, 2, 6});
  const Lanes cd_odd = __builtin_shuffle(c, d, LaneMask{1, 5, 3, 7});
  a = __builtin_shuffle(ab_even, cd_even, LaneMask{0, 1, 4, 5});
  b = __builtin_shuffle(ab_odd, cd_odd, LaneMask{0, 1, 4, 5});
  c = __builtin_shuffle(ab_even, cd_even, LaneMask{2, 3, 6, 7});
  d = __builtin_shuffle(ab_odd, cd_odd, LaneMask{2, 3, 6, 7});
}

}  // namespace poinsot
