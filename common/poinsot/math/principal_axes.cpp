#include "poinsot/math/principal_axes.h"

#include <cmath>
#include <utility>

namespace poinsot {
namespace {

using Row = std::array<long double, 3>;
using Matrix = std::array<Row, 3>;

// Turns the plane (p, q) so that a[p][q] becomes zero.
void annihilate(Matrix& a, Matrix& v, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const long double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const long double t =
      (theta >= 0 ? 1.0L : -1.0L) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const long double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const std::size_t r = 3 - p - q;
  const long double apq = a[p][q], arp = a[r][p], arq = a[r][q];
  a[p][p] -= t * apq;
  a[q][q] += t * apq;
  a[p][q] = a[q][p] = 0;
  a[r][p] = a[p][r] = c * arp - s * arq;
  a[r][q] = a[q][r] = s * arp + c * arq;
  for (Row& row : v) {
    const long double vp = row[p], vq = row[q];
    row[p] = c * vp - s * vq;
    row[q] = s * vp + c * vq;
  }
}

void swap_axes(PrincipalAxes& p, std::size_t i, std::size_t j) {
  std::swap(p.moments[i], p.moments[j]);
  for (Row& row : p.axes) {
    std::swap(row[i], row[j]);
    row[j] = -row[j];  // keeps the rotation proper
  }
}

}  // namespace

PrincipalAxes principal_axes(const Mat3& J) {
  Matrix a = {}, v = {};
  for (std::size_t i = 0; i < 3; ++i) {
    v[i][i] = 1;
    for (std::size_t j = 0; j < 3; ++j)
      a[i][j] = (static_cast<long double>(J(static_cast<int>(i), static_cast<int>(j))) +
                 static_cast<long double>(J(static_cast<int>(j), static_cast<int>(i)))) /
                2;
  }
  constexpr int kSweeps = 30;  // quadratic convergence: about six are used
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (a[0][1] == 0 && a[0][2] == 0 && a[1][2] == 0) break;
    annihilate(a, v, 0, 1);
    annihilate(a, v, 0, 2);
    annihilate(a, v, 1, 2);
  }
  PrincipalAxes result{{a[0][0], a[1][1], a[2][2]}, v};
  if (result.moments[0] > result.moments[1]) swap_axes(result, 0, 1);
  if (result.moments[1] > result.moments[2]) swap_axes(result, 1, 2);
  if (result.moments[0] > result.moments[1]) swap_axes(result, 0, 1);
  return result;
}

Mat3 inverse_inertia(const PrincipalAxes& body) {
  Mat3 inverse;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      long double sum = 0;
      for (std::size_t k = 0; k < 3; ++k)
        sum += body.axes[i][k] * body.axes[j][k] / body.moments[k];
      inverse(static_cast<int>(i), static_cast<int>(j)) = static_cast<double>(sum);
    }
  return inverse;
}

}  // namespace poinsot
