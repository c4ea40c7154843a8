#include "poinsot/math/elliptic.h"

#include <cmath>
#include <numbers>

namespace poinsot {

long double complete_elliptic_k(long double k_complement) {
  long double a = 1, b = k_complement;
  // Quadratic convergence: the last difference is squared once more by the mean that is returned.
  while (std::abs(a - b) > 1e-10L * a) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return std::numbers::pi_v<long double> / (a + b);
}

long double carlson_rf(long double x, long double y) {
  long double z = 1;
  long double mean = (x + y + z) / 3;
  long double dx = mean - x, dy = mean - y, scale = 1;
  // The series below is cut after its terms of degree 7: its error is about |difference/mean|⁸/50.
  while (std::fmax(std::fmax(std::abs(dx), std::abs(dy)), std::abs(dx + dy)) * scale >
         5e-3L * mean) {
    const long double sx = std::sqrt(x), sy = std::sqrt(y), sz = std::sqrt(z);
    const long double lambda = sx * sy + (sx + sy) * sz;
    x = (x + lambda) / 4;
    y = (y + lambda) / 4;
    z = (z + lambda) / 4;
    mean = (mean + lambda) / 4;
    scale /= 4;
  }
  const long double X = dx * scale / mean, Y = dy * scale / mean, Z = -(X + Y);
  const long double e2 = X * Y - Z * Z, e3 = X * Y * Z;
  const long double series = 1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 -
                             5 * e2 * e2 * e2 / 208 + 3 * e3 * e3 / 104 + e2 * e2 * e3 / 16;
  return series / std::sqrt(mean);
}

}  // namespace poinsot
