#include "poinsot/math/phase.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace poinsot {
namespace {

__extension__ using Quad = __float128;

struct Seen {
  double fraction = 0, turns = 0;  // errors
};

// What start + rate·t is in 113 bits, without its whole turns: both inputs have 64, t 53.
Seen error_of(long double rate, long double start, double t) {
  const Reduced reduced = Phase(rate, start).at(t);
  const Quad exact = Quad(rate) * Quad(t) + Quad(start);
  const Quad off = Quad(reduced.turns) + Quad(reduced.fraction) - exact;
  return {std::abs(static_cast<double>(off)),
          std::abs(reduced.turns - std::nearbyint(reduced.turns))};
}

TEST(Phase, IsRightToARoundingHoweverManyTurnsHavePassed) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const long double rate = static_cast<long double>(100 * unit(random)) * (1 + 1e-17L * i);
    const long double start = static_cast<long double>(unit(random)) / 3;
    const double t = std::pow(10.0, 9 * std::abs(unit(random)));  // 1 … 1e9 s
    const Seen seen = error_of(rate, start, t);
    EXPECT_EQ(seen.turns, 0);
    // The header's promise.
    const double bound = 1.2e-16 + 1e-19 * std::abs(static_cast<double>(rate) * t);
    EXPECT_LE(seen.fraction, bound) << static_cast<double>(rate) << " " << t;
    worst = std::max(worst, seen.fraction / bound);
  }
  RecordProperty("worst_over_bound", std::to_string(worst));
}

TEST(Phase, FormsTheProductExactly) {
  // Factors of 53 bits each: the product has 106, of which the fraction of a turn keeps the last.
  const double rate = 1 + 0x1p-52, t = 0x1p30 * (1 + 0x1p-52);
  const Reduced reduced = Phase(rate, 0).at(t);
  EXPECT_EQ(reduced.turns, 0x1p30);
  EXPECT_EQ(reduced.fraction, 0x1p-21 + 0x1p-74);
}

// But for the rounding of the turns before the fraction is known.
TEST(Phase, StaysWithinHalfATurn) {
  const Phase phase(0.123456789L, 0.25L);
  for (int i = -10000; i <= 10000; ++i) {
    const Reduced reduced = phase.at(1e5 * i);
    ASSERT_LE(std::abs(reduced.fraction), 0.5 + 1.2e-16 * (1 + std::abs(reduced.turns)));
  }
}

TEST(Phase, StartsAtItsStart) {
  EXPECT_EQ(Phase(3, 0.25L).at(0).fraction, 0.25);
  EXPECT_EQ(Phase(3, 0.25L).at(0).turns, 0);
  EXPECT_EQ(Phase().at(5).fraction, 0);
  EXPECT_EQ(Phase(3, 0.25L).rate(), 3);
}

}  // namespace
}  // namespace poinsot
