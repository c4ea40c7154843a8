#include "poinsot/math/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();

// |computed − exact| in units in the last place of the exact value, which is taken in 64 bits.
double ulps(double computed, long double exact) {
  const double rounded = std::abs(static_cast<double>(exact));
  const double spacing = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs(static_cast<long double>(computed) - exact)) / spacing;
}

TEST(SinCos, AgreesWithTheCLibraryToOneUlp) {
  for (int i = -200000; i <= 200000; ++i) {
    const double x = 1e-3 * i * 1.0000001;
    const auto [s, c] = sin_cos(x);
    EXPECT_NEAR(s, std::sin(x), kUlp) << x;
    EXPECT_NEAR(c, std::cos(x), kUlp) << x;
  }
}

TEST(SinCos, KeepsAccuracyNearMultiplesOfHalfPi) {
  const double x = 1.5707963267948966;  // the double nearest to π/2
  EXPECT_NEAR(sin_cos(x).cos / 6.123233995736766e-17, 1.0, 1e-12);
  EXPECT_NEAR(sin_cos(2 * x).sin / 1.2246467991473532e-16, 1.0, 1e-12);
}

TEST(SinCos, IsExactAtZero) {
  EXPECT_EQ(sin_cos(0.0).sin, 0.0);
  EXPECT_EQ(sin_cos(0.0).cos, 1.0);
}

TEST(Exponential, IsWithinOneAndAHalfUlp) {
  double worst = 0;
  for (int i = -200000; i <= 200000; ++i) {
    const double x = 3.4987654e-3 * i;  // −699.8 … 699.8
    worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
  }
  for (int i = -1000; i <= 1000; ++i) {  // close to zero, where the answer is 1
    const double x = std::ldexp(1.0 + 1e-3 * std::abs(i), -std::abs(i) / 20) * (i < 0 ? -1 : 1);
    worst = std::max(worst, ulps(exponential(x), std::exp(static_cast<long double>(x))));
  }
  EXPECT_LE(worst, 1.5);
  RecordProperty("worst_ulp", std::to_string(worst));
}

TEST(Exponential, IsExactAtZero) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(0.0L), 1.0L);
}

// Its promise: 2 ulp or 1e-16, whichever is larger (close to 1 the logarithm is close to zero).
TEST(Logarithm, IsWithinTwoUlpOr1e16) {
  double worst_ulp = 0, worst_near_one = 0;
  const auto look = [&](double x) {
    const long double exact = std::log(static_cast<long double>(x));
    const double error =
        static_cast<double>(std::abs(static_cast<long double>(logarithm(x)) - exact));
    if (std::abs(exact) > 0.25L)
      worst_ulp = std::max(worst_ulp, ulps(logarithm(x), exact));
    else
      worst_near_one = std::max(worst_near_one, error);
  };
  for (int i = 1; i <= 200000; ++i) look(1e-5 * i * 1.0000001);
  for (int e = -1020; e <= 1020; ++e)
    for (int k = 0; k < 50; ++k) look(std::ldexp(1 + 0.01999 * k, e));
  EXPECT_LE(worst_ulp, 2.0);
  EXPECT_LE(worst_near_one, 1e-16);
  EXPECT_EQ(logarithm(1.0), 0.0);
  RecordProperty("worst_ulp", std::to_string(worst_ulp));
  RecordProperty("worst_near_one", std::to_string(worst_near_one * 1e16));
}

// e^(y ln x): the rounding of y ln x, one ulp of up to |y ln x|, and the logarithm's two become
// relative errors of the power.
TEST(Power, LosesWhatTheProductLoses) {
  for (int i = 1; i <= 2000; ++i)
    for (const double y : {-3.0, -0.25, 0.1, 1.0 / 7, 0.5, 2.0, 10.0}) {
      const double x = std::ldexp(1 + 1e-3 * i, (i % 61) - 30);
      const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
      const double argument = std::abs(y * std::log(x));
      const double error =
          std::abs(static_cast<double>((static_cast<long double>(power(x, y)) - exact) / exact));
      EXPECT_LE(error, kUlp * (1.5 + 3 * argument)) << x << "^" << y;
    }
  EXPECT_EQ(power(7.0, 0.0), 1.0);
}

// The reduction by ln 2 in two parts of 53 and 64 bits, and 64 bits of sum.
TEST(LongExponential, IsWithin4e19) {
  long double worst = 0;
  for (int i = -100000; i <= 100000; ++i) {
    const long double x = 0.1099L * i;  // −10990 … 10990
    const long double exact = std::exp(x);
    worst = std::max(worst, std::abs(exponential(x) / exact - 1));
  }
  for (int i = -1000; i <= 1000; ++i) {
    const long double x = 1e-3L * i;
    worst = std::max(worst, std::abs(exponential(x) / std::exp(x) - 1));
  }
  EXPECT_LE(worst, 4e-19L);
  RecordProperty("worst_1e-19", std::to_string(static_cast<double>(worst * 1e19L)));
}

}  // namespace
}  // namespace poinsot
