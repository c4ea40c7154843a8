// The kernels of this processor against plain loops that sum in the same order: the same bits.

#include "poinsot/simulation/series_kernels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr std::size_t kOrders = 20;

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

template <class A, class B>
void expect_same_bits(const A& a, const B& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t e = 0; e < a.size(); ++e) ASSERT_EQ(bits(a[e]), bits(b[e])) << e;
}

// Numbers of very different sizes, so that another order of summing would round differently.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  double next() { return std::ldexp(normal_(random_), exponent_(random_)); }
  template <std::size_t N>
  void fill(std::array<double, N>& values, bool padded) {
    for (std::size_t e = 0; e < N; ++e) values[e] = padded && e % 4 == 3 ? 0 : next();
  }

  SeriesBlock block() {
    SeriesBlock block;
    fill(block.rows, false);
    fill(block.v, true);
    fill(block.omega, true);
    fill(block.c_W, false);
    fill(block.H, true);
    return block;
  }
  EffortBlock effort() {
    EffortBlock effort;
    fill(effort.force, true);
    fill(effort.torque, true);
    return effort;
  }
  SeriesBody body() {
    SeriesBody body = {};
    fill(body.inv_J, true);
    body.inv_mass = next();
    for (auto* a : {&body.steady, &body.push, &body.couple_W, &body.force_B, &body.torque_B})
      fill(*a, true);
    fill(body.moment, true);
    body.couple_in_W = body.force_in_B = body.torque_in_B = body.at_points = body.works = true;
    return body;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_int_distribution<int> exponent_{-30, 30};
};

struct Sample {
  explicit Sample(unsigned seed) {
    Numbers numbers(seed);
    body = numbers.body();
    for (std::size_t k = 0; k < kOrders; ++k) {
      series.push_back(numbers.block());
      effort.push_back(numbers.effort());
    }
  }
  SeriesBody body;
  std::vector<SeriesBlock> series;
  std::vector<EffortBlock> effort;
};

double sum3(const std::array<double, 4>& a) {
  return (a[0] + a[1]) + a[2];
}

// Component after component; each is one sum from the first term to the last.
SeriesSquares integrate_by_loop(Sample& s, std::size_t k) {
  std::array<double, 12> sum = {};
  std::array<double, 4> by_force = {}, by_torque = {};
  for (std::size_t j = 0; j <= k; ++j) {
    const auto& n = s.series[j].rows;
    const auto& w = s.series[k - j].omega;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const double x = n[lane], y = n[4 + lane], z = n[8 + lane];
      sum[lane] += w[2] * y - w[1] * z;
      sum[4 + lane] += w[0] * z - w[2] * x;
      sum[8 + lane] += w[1] * x - w[0] * y;
      by_force[lane] += s.effort[j].force[lane] * s.series[k - j].v[lane];
      by_torque[lane] += s.effort[j].torque[lane] * s.series[k - j].omega[lane];
    }
  }
  const double scale = 1.0 / static_cast<double>(k + 1);
  SeriesBlock& next = s.series[k + 1];
  SeriesSquares squares = {};
  std::array<double, 4> rows = {}, speed = {}, steady = {}, power = {};
  for (std::size_t lane = 0; lane < 4; ++lane) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      next.rows[4 * axis + lane] =
          (sum[4 * axis + lane] + (lane == 3 ? s.effort[k].torque[axis] : 0.0)) * scale;
    const double force = s.effort[k].force[lane];
    next.v[lane] = (k == 0 ? force + s.body.steady[lane] : force) * (scale * s.body.inv_mass);
    next.c_W[lane] = s.series[k].v[lane] * scale;
    steady[lane] = s.body.push[lane] * next.c_W[lane];
    power[lane] = by_force[lane] + by_torque[lane];
    const double x = next.rows[lane], y = next.rows[4 + lane], z = next.rows[8 + lane];
    rows[lane] = x * x + y * y + z * z;
    speed[lane] = next.v[lane] * next.v[lane];
  }
  next.c_W[3] = sum3(steady) + scale * sum3(power);
  squares = {sum3(rows), sum3(speed), rows[3]};
  return squares;
}

void expect_same(const SeriesSquares& a, const SeriesSquares& b) {
  ASSERT_EQ(bits(a.R), bits(b.R));
  ASSERT_EQ(bits(a.v), bits(b.v));
  ASSERT_EQ(bits(a.m), bits(b.m));
}

void expect_same(const SeriesBlock& a, const SeriesBlock& b) {
  expect_same_bits(a.rows, b.rows);
  expect_same_bits(a.v, b.v);
  expect_same_bits(a.omega, b.omega);
  expect_same_bits(a.c_W, b.c_W);
  expect_same_bits(a.H, b.H);
}

TEST(SeriesKernels, IntegrateToTheBitsOfAPlainLoop) {
  const SeriesKernels kernels = series_kernels();
  for (unsigned seed = 0; seed < 40; ++seed)
    for (std::size_t k = 0; k + 1 < kOrders; ++k) {
      Sample fast(seed), plain(seed);
      const SeriesSquares squares =
          kernels.integrate(fast.body, fast.series.data(), fast.effort.data(), static_cast<int>(k));
      expect_same(squares, integrate_by_loop(plain, k));
      expect_same(fast.series[k + 1], plain.series[k + 1]);
      expect_same(kernels.squares(fast.series[k + 1]), squares);
    }
}

TEST(SeriesKernels, EvaluateToTheBitsOfHornersRule) {
  const SeriesKernels kernels = series_kernels();
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Sample s(seed);
    const double h = 0.1 * (1 + seed);
    constexpr int kOrder = 15;
    SeriesBlock sum, plain = s.series[kOrder];
    kernels.evaluate(s.series.data(), kOrder, h, sum);
    for (int k = kOrder - 1; k >= 0; --k) {
      const SeriesBlock& block = s.series[static_cast<std::size_t>(k)];
      const auto add = [h](auto& value, const auto& coefficient) {
        for (std::size_t e = 0; e < value.size(); ++e) value[e] = coefficient[e] + h * value[e];
      };
      add(plain.rows, block.rows);
      add(plain.v, block.v);
      add(plain.omega, block.omega);
      add(plain.c_W, block.c_W);
      add(plain.H, block.H);
    }
    expect_same(sum, plain);
  }
}

TEST(SeriesKernels, StepAsTheyPushAndIntegrate) {
  const SeriesKernels kernels = series_kernels();
  for (unsigned seed = 0; seed < 40; ++seed)
    for (int k = 0; k < 10; ++k) {
      Sample both(seed), one_by_one(seed);
      const SeriesSquares squares =
          kernels.step(both.body, both.series.data(), both.effort.data(), k);
      kernels.push(one_by_one.body, one_by_one.series.data(), one_by_one.effort.data(), k);
      expect_same(squares, kernels.integrate(one_by_one.body, one_by_one.series.data(),
                                             one_by_one.effort.data(), k));
      const auto i = static_cast<std::size_t>(k);
      expect_same(both.series[i], one_by_one.series[i]);
      expect_same(both.series[i + 1], one_by_one.series[i + 1]);
    }
}

// Linear in R: what each push is in its other frame, at order 0 where R is R.
TEST(SeriesKernels, PushAsTheTextbookSays) {
  Sample s(7);
  const double c = 0.6, d = 0.8;
  s.series[0].rows = {c, d, 0, 1, -d, c, 0, 2, 0, 0, 1, 3};  // R about z by columns; m = 1 2 3
  s.body.inv_J = {1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.25, 0};
  s.body.force_B = {1, 2, 3, 0};
  s.body.couple_W = {0.5, -1, 2, 0};
  s.body.torque_B = {4, 5, 6, 0};
  s.body.moment = {0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 0, 0};  // p = e₃, F = 7 e₁
  series_kernels().push(s.body, s.series.data(), s.effort.data(), 0);
  const auto near = [](const std::array<double, 4>& a, double x, double y, double z) {
    EXPECT_NEAR(a[0], x, 1e-14);
    EXPECT_NEAR(a[1], y, 1e-14);
    EXPECT_NEAR(a[2], z, 1e-14);
  };
  near(s.series[0].omega, 1, 1, 0.75);
  near(s.effort[0].force, c - 2 * d, d + 2 * c, 3);
  // Rᵀ τ_W + τ_B + e₃ × Rᵀ 7 e₁, where Rᵀ e₁ = (c, −d, 0)
  near(s.effort[0].torque, 0.5 * c - d + 4 + 7 * d, -0.5 * d - c + 5 + 7 * c, 2 + 6);
  // τ_W + R τ_B + e₃ × 7 e₁
  near(s.series[1].H, 0.5 + 4 * c - 5 * d, -1 + 4 * d + 5 * c + 7, 2 + 6);
}

}  // namespace
}  // namespace poinsot
