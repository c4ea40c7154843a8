#include "poinsot/math/elementary.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

TEST(SinCos, AgreesWithTheCLibraryToOneUlp) {
  constexpr double ulp = std::numeric_limits<double>::epsilon();
  for (int i = -200000; i <= 200000; ++i) {
    const double x = 1e-3 * i * 1.0000001;
    const auto [s, c] = sin_cos(x);
    EXPECT_NEAR(s, std::sin(x), ulp) << x;
    EXPECT_NEAR(c, std::cos(x), ulp) << x;
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

}  // namespace
}  // namespace poinsot
