#include "poinsot/simulation/series_kernels.h"

namespace poinsot {
namespace {

// Four lanes; where the processor has less the compiler takes two registers. Functions that take
// them are inlined into their callers: no register crosses a call.
using Lanes = double __attribute__((vector_size(32)));
using Stored = double __attribute__((vector_size(32), aligned(8), may_alias));

#define POINSOT_LANES(p) (*reinterpret_cast<const Stored*>(p))
#define POINSOT_STORE(p, value) (*reinterpret_cast<Stored*>(p) = (value))

// 1/n
constexpr std::array<double, 32> kInverse = [] {
  std::array<double, 32> inverse = {};
  for (int n = 1; n < 32; ++n) inverse[static_cast<std::size_t>(n)] = 1.0 / n;
  return inverse;
}();

[[gnu::always_inline]] inline void push_order(const SeriesBody& body, SeriesBlock* series,
                                              EffortBlock* effort, int k) {
  SeriesBlock& block = series[k];
  const double* const r = block.rows.data();
  const double* const J = body.inv_J.data();
  const Lanes omega =
      POINSOT_LANES(J) * r[3] + POINSOT_LANES(J + 4) * r[7] + POINSOT_LANES(J + 8) * r[11];
  POINSOT_STORE(block.omega.data(), omega);

  const Lanes x = POINSOT_LANES(r), y = POINSOT_LANES(r + 4), z = POINSOT_LANES(r + 8);
  const double scale = kInverse[static_cast<std::size_t>(k) + 1];
  Lanes force = {}, torque = {}, H = {};
  if (body.force_in_B) {  // R F
    force = x * body.force_B[0] + y * body.force_B[1] + z * body.force_B[2];
    force[3] = 0;
  }
  if (body.couple_in_W) {  // Rᵀ τ
    const auto& t = body.couple_W;
    const Lanes w = {t[0], t[1], t[2], 0};
    const Lanes a = x * w, b = y * w, c = z * w;
    torque = Lanes{(a[0] + a[1]) + a[2], (b[0] + b[1]) + b[2], (c[0] + c[1]) + c[2], 0};
  }
  if (body.torque_in_B) {
    H = x * body.torque_B[0] + y * body.torque_B[1] + z * body.torque_B[2];
    H[3] = 0;
  }
  if (body.at_points) {
    // F constant in W is Σ Fᵢ nᵢ in B, its moment at p is Σ Fᵢ p × nᵢ, in W the axial vector of R
    // M.
    const double* const M = body.moment.data();
    for (int i = 0; i < 3; ++i) {
      const double* const p = M + 4 * i;
      const double nx = x[i], ny = y[i], nz = z[i];
      torque += Lanes{p[1] * nz - p[2] * ny, p[2] * nx - p[0] * nz, p[0] * ny - p[1] * nx, 0};
    }
    Lanes rm[3];
    for (int i = 0; i < 3; ++i) rm[i] = x * M[4 * i] + y * M[4 * i + 1] + z * M[4 * i + 2];
    H += Lanes{rm[2][1] - rm[1][2], rm[0][2] - rm[2][0], rm[1][0] - rm[0][1], 0};
  }
  if (k == 0) {
    torque += POINSOT_LANES(body.torque_B.data());
    H += POINSOT_LANES(body.couple_W.data());
  }
  POINSOT_STORE(effort[k].force.data(), force);
  POINSOT_STORE(effort[k].torque.data(), torque);
  POINSOT_STORE(series[k + 1].H.data(), H * scale);
}

[[gnu::always_inline]] inline SeriesSquares integrate_order(const SeriesBody& body,
                                                            SeriesBlock* series,
                                                            const EffortBlock* effort, int k) {
  // n′ = n × ω of four vectors n at once.
  Lanes x = {}, y = {}, z = {};
  for (int j = 0; j <= k; ++j) {
    const double* const n = series[j].rows.data();
    const double* const w = series[k - j].omega.data();
    const Lanes nx = POINSOT_LANES(n), ny = POINSOT_LANES(n + 4), nz = POINSOT_LANES(n + 8);
    x += w[2] * ny - w[1] * nz;
    y += w[0] * nz - w[2] * nx;
    z += w[1] * nx - w[0] * ny;
  }
  const double scale = kInverse[static_cast<std::size_t>(k) + 1];
  const auto& torque = effort[k].torque;
  x += Lanes{0, 0, 0, torque[0]};
  y += Lanes{0, 0, 0, torque[1]};
  z += Lanes{0, 0, 0, torque[2]};
  SeriesBlock& next = series[k + 1];
  x *= scale;
  y *= scale;
  z *= scale;
  POINSOT_STORE(next.rows.data(), x);
  POINSOT_STORE(next.rows.data() + 4, y);
  POINSOT_STORE(next.rows.data() + 8, z);

  Lanes force = POINSOT_LANES(effort[k].force.data());
  if (k == 0) force += POINSOT_LANES(body.steady.data());
  const Lanes v = force * (scale * body.inv_mass);
  POINSOT_STORE(next.v.data(), v);

  // c′ = v; W′ = F·v + τ·ω, where a force constant in W has done F·Δc.
  Lanes c = POINSOT_LANES(series[k].v.data()) * scale;
  const Lanes steady = POINSOT_LANES(body.push.data()) * c;
  double work = (steady[0] + steady[1]) + steady[2];
  if (body.works) {
    Lanes by_force = {}, by_torque = {};
    for (int j = 0; j <= k; ++j) {
      const SeriesBlock& other = series[k - j];
      by_force += POINSOT_LANES(effort[j].force.data()) * POINSOT_LANES(other.v.data());
      by_torque += POINSOT_LANES(effort[j].torque.data()) * POINSOT_LANES(other.omega.data());
    }
    const Lanes power = by_force + by_torque;
    work += scale * ((power[0] + power[1]) + power[2]);
  }
  c[3] = work;
  POINSOT_STORE(next.c_W.data(), c);
  const Lanes rows = x * x + y * y + z * z, speed = v * v;
  return {(rows[0] + rows[1]) + rows[2], (speed[0] + speed[1]) + speed[2], rows[3]};
}

[[gnu::always_inline]] inline SeriesSquares squares_of(const SeriesBlock& block) {
  const double* const r = block.rows.data();
  const Lanes x = POINSOT_LANES(r), y = POINSOT_LANES(r + 4), z = POINSOT_LANES(r + 8);
  const Lanes rows = x * x + y * y + z * z;
  const Lanes speed = POINSOT_LANES(block.v.data()) * POINSOT_LANES(block.v.data());
  return {(rows[0] + rows[1]) + rows[2], (speed[0] + speed[1]) + speed[2], rows[3]};
}

[[gnu::always_inline]] inline void evaluate_at(const SeriesBlock* series, int order, double h,
                                               SeriesBlock& sum) {
  constexpr int kLanes = sizeof(SeriesBlock) / sizeof(Lanes);
  static_assert(sizeof(SeriesBlock) == kLanes * sizeof(Lanes));
  Lanes value[kLanes];
  for (int i = 0; i < kLanes; ++i) value[i] = POINSOT_LANES(series[order].rows.data() + 4 * i);
  for (int k = order - 1; k >= 0; --k)
    for (int i = 0; i < kLanes; ++i)
      value[i] = POINSOT_LANES(series[k].rows.data() + 4 * i) + h * value[i];
  for (int i = 0; i < kLanes; ++i) POINSOT_STORE(sum.rows.data() + 4 * i, value[i]);
}

#define POINSOT_KERNELS(suffix, target)                                                          \
  target void push_##suffix(const SeriesBody& body, SeriesBlock* series, EffortBlock* effort,    \
                            int k) {                                                             \
    push_order(body, series, effort, k);                                                         \
  }                                                                                              \
  target SeriesSquares integrate_##suffix(const SeriesBody& body, SeriesBlock* series,           \
                                          const EffortBlock* effort, int k) {                    \
    return integrate_order(body, series, effort, k);                                             \
  }                                                                                              \
  target SeriesSquares step_##suffix(const SeriesBody& body, SeriesBlock* series,                \
                                     EffortBlock* effort, int k) {                               \
    push_order(body, series, effort, k);                                                         \
    return integrate_order(body, series, effort, k);                                             \
  }                                                                                              \
  target SeriesSquares squares_##suffix(const SeriesBlock& block) {                              \
    return squares_of(block);                                                                    \
  }                                                                                              \
  target void evaluate_##suffix(const SeriesBlock* series, int order, double h,                  \
                                SeriesBlock& sum) {                                              \
    evaluate_at(series, order, h, sum);                                                          \
  }                                                                                              \
  constexpr SeriesKernels kKernels_##suffix = {push_##suffix, integrate_##suffix, step_##suffix, \
                                               squares_##suffix, evaluate_##suffix};

POINSOT_KERNELS(baseline, )
#ifdef __x86_64__
POINSOT_KERNELS(avx, [[gnu::target("avx")]])
#endif

}  // namespace

SeriesKernels series_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx")) return kKernels_avx;
#endif
  return kKernels_baseline;
}

}  // namespace poinsot
