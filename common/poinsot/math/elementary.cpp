#include "poinsot/math/elementary.h"

#include <cmath>

namespace poinsot {
namespace {

// Minimax on |x| ≤ π/4; coefficients of fdlibm (Sun Microsystems, 1993), k_sin.c and k_cos.c.
double sin_kernel(double x, double tail) {
  const double z = x * x;
  const double v = z * x;
  const double r = 8.33333333332248946124e-03 +
                   z * (-1.98412698298579493134e-04 +
                        z * (2.75573137070700676789e-06 +
                             z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  return x - ((z * (0.5 * tail - v * r) - tail) - v * -1.66666666666666324348e-01);
}

double cos_kernel(double x, double tail) {
  const double z = x * x;
  const double r =
      z * (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return w + (((1.0 - w) - half) + (z * r - x * tail));
}

}  // namespace

SinCos sin_cos(double x) {
  // π/2 = kHigh + kMiddle + kLow + …: the first two parts end in zeros, so n·part is exact.
  constexpr double kTwoOverPi = 6.36619772367581382433e-01;
  constexpr double kHigh = 1.57079632673412561417e+00;
  constexpr double kMiddle = 6.07710050630396597660e-11;
  constexpr double kLow = 2.02226624879595063154e-21;

  const double n = std::nearbyint(x * kTwoOverPi);
  const double high = x - n * kHigh;
  const double middle = n * kMiddle;
  const double t = high - middle;
  const double low = n * kLow - ((high - t) - middle);
  const double reduced = t - low;
  const double tail = (t - reduced) - low;

  const double s = sin_kernel(reduced, tail);
  const double c = cos_kernel(reduced, tail);
  const double quarter = n - 4.0 * std::floor(n * 0.25);
  if (quarter == 0.0) return {s, c};
  if (quarter == 1.0) return {c, -s};
  if (quarter == 2.0) return {-s, -c};
  return {-c, s};
}

namespace {

// eʳ − 1 = r (1 + r/2 (1 + r/3 (…))) up to degree `N`; |r| ≤ ln 2 / 2.
template <int N, class Real>
Real exp_series(Real r) {
  Real sum = 1;
  for (int n = N; n >= 2; --n) sum = 1 + r * sum * (Real(1) / Real(n));
  return 1 + r * sum;
}

}  // namespace

double exponential(double x) {
  // ln 2 = kHigh + kLow; n·kHigh is exact.
  constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10;
  const double n = std::nearbyint(x * 1.44269504088896338700e+00);
  const double r = (x - n * kHigh) - n * kLow;
  return std::ldexp(exp_series<13>(r), static_cast<int>(n));
}

double logarithm(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // ½ … 1
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  // ln m = 2 artanh s, |s| < 0.172
  const double s = (m - 1) / (m + 1), z = s * s;
  double sum = 0;
  for (int n = 21; n >= 3; n -= 2) sum = z * (1.0 / n + sum);
  constexpr double kHigh = 6.93147180369123816490e-01, kLow = 1.90821492927058770002e-10;
  return exponent * kHigh + (2 * s + (2 * s * sum + exponent * kLow));
}

double power(double x, double y) {
  return exponential(y * logarithm(x));
}

long double exponential(long double x) {
  constexpr long double kHigh = 6.93147180369123816490e-01L, kLow = 1.90821492927058781614e-10L;
  const long double n = std::nearbyint(x * 1.442695040888963407359924681L);
  const long double r = (x - n * kHigh) - n * kLow;
  return std::ldexp(exp_series<18>(r), static_cast<int>(n));
}

}  // namespace poinsot
