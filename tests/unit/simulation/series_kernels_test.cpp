// The kernels of this processor against plain loops that sum in the same order: the same bits.

#include "poinsot/simulation/series_kernels.h"

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr int kMost = 18;

std::vector<double> numbers(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> exponent(-40, 40);
  std::vector<double> result(n);
  for (double& x : result) x = std::ldexp(normal(random), exponent(random));
  return result;
}

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

// Component after component; each is one sum from the first term to the last.
std::array<double, 12> cross_by_loop(const double* rows, const double* flow, int k) {
  std::array<double, 12> sum = {};
  for (int j = 0; j <= k; ++j) {
    const double* const n = rows + 12 * j;
    const double* const w = flow + 8 * (k - j) + 4;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const double x = n[lane], y = n[4 + lane], z = n[8 + lane];
      sum[lane] += w[2] * y - w[1] * z;
      sum[4 + lane] += w[0] * z - w[2] * x;
      sum[8 + lane] += w[1] * x - w[0] * y;
    }
  }
  return sum;
}

double dot_by_loop(const double* a, const double* b, int k) {
  std::array<double, 4> sum = {};
  for (int j = 0; j <= k; ++j)
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const double* const p = a + 8 * j + lane;
      const double* const q = b + 8 * (k - j) + lane;
      sum[lane] += p[0] * q[0] + p[4] * q[4];
    }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

TEST(SeriesKernels, GiveTheBitsOfAPlainLoop) {
  const SeriesKernels kernels = series_kernels();
  for (unsigned seed = 0; seed < 50; ++seed) {
    // One double off any alignment: the kernels promise none.
    const std::vector<double> rows = numbers(12 * (kMost + 1) + 1, 3 * seed);
    const std::vector<double> flow = numbers(8 * (kMost + 1) + 1, 3 * seed + 1);
    const std::vector<double> effort = numbers(8 * (kMost + 1) + 1, 3 * seed + 2);
    for (int k = 0; k <= kMost; ++k) {
      std::array<double, 13> sum = {};
      kernels.cross(rows.data() + 1, flow.data() + 1, k, sum.data() + 1);
      const std::array<double, 12> expected = cross_by_loop(rows.data() + 1, flow.data() + 1, k);
      for (std::size_t e = 0; e < 12; ++e) ASSERT_EQ(bits(sum[e + 1]), bits(expected[e])) << k;
      ASSERT_EQ(bits(kernels.dot(effort.data() + 1, flow.data() + 1, k)),
                bits(dot_by_loop(effort.data() + 1, flow.data() + 1, k)));
    }
  }
}

TEST(SeriesKernels, FormTheSeriesOfACrossProduct) {
  // n = e₁ + e₂ t in the first lane, ω = e₃ t: n × ω = −e₂ t + e₁ t².
  std::vector<double> rows(12 * 3), flow(8 * 3);
  rows[0] = 1;       // x of order 0
  rows[12 + 4] = 1;  // y of order 1
  flow[8 + 6] = 1;   // ω_z of order 1
  std::array<double, 12> sum = {};
  const SeriesKernels kernels = series_kernels();
  kernels.cross(rows.data(), flow.data(), 1, sum.data());
  EXPECT_EQ(sum[4], -1);
  EXPECT_EQ(sum[0], 0);
  kernels.cross(rows.data(), flow.data(), 2, sum.data());
  EXPECT_EQ(sum[0], 1);
  EXPECT_EQ(sum[4], 0);
}

}  // namespace
}  // namespace poinsot
