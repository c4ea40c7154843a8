#include "poinsot/simulation/series_kernels.h"

namespace poinsot {
namespace {

// Four lanes; where the processor has less the compiler takes two registers.
using Lanes = double __attribute__((vector_size(32)));
using Unaligned = double __attribute__((vector_size(32), aligned(8), may_alias));

[[gnu::always_inline]] inline void cross_series(const double* rows, const double* flow, int k,
                                                double* sum) {
  Lanes x = {}, y = {}, z = {};
  for (int j = 0; j <= k; ++j) {
    const double* const n = rows + 12 * j;
    const double* const w = flow + 8 * (k - j) + 4;
    const auto* const at = reinterpret_cast<const Unaligned*>(n);
    const Lanes nx = at[0], ny = at[1], nz = at[2];
    x += w[2] * ny - w[1] * nz;
    y += w[0] * nz - w[2] * nx;
    z += w[1] * nx - w[0] * ny;
  }
  auto* const to = reinterpret_cast<Unaligned*>(sum);
  to[0] = x;
  to[1] = y;
  to[2] = z;
}

[[gnu::always_inline]] inline double dot_series(const double* a, const double* b, int k) {
  Lanes sum = {};
  for (int j = 0; j <= k; ++j) {
    const auto* const p = reinterpret_cast<const Unaligned*>(a + 8 * j);
    const auto* const q = reinterpret_cast<const Unaligned*>(b + 8 * (k - j));
    sum += p[0] * q[0] + p[1] * q[1];
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

void cross_baseline(const double* rows, const double* flow, int k, double* sum) {
  cross_series(rows, flow, k, sum);
}
double dot_baseline(const double* a, const double* b, int k) {
  return dot_series(a, b, k);
}

#ifdef __x86_64__
[[gnu::target("avx")]] void cross_avx(const double* rows, const double* flow, int k, double* sum) {
  cross_series(rows, flow, k, sum);
}
[[gnu::target("avx")]] double dot_avx(const double* a, const double* b, int k) {
  return dot_series(a, b, k);
}
#endif

}  // namespace

SeriesKernels series_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx")) return {cross_avx, dot_avx};
#endif
  return {cross_baseline, dot_baseline};
}

}  // namespace poinsot
