// Power series in time with coefficients of 113 bits (__float128), to build Taylor recurrences
// from.
//
// A recurrence extends all series of a system by one coefficient after another: each function here
// gives or appends coefficient k and reads only coefficients up to k of its arguments. Source:
// Hairer, Nørsett, Wanner, Solving ODEs I, I.8; Jorba, Zou, Experimental Mathematics 14 (2005).

#pragma once

#include <array>
#include <quadmath.h>

namespace poinsot::test {

__extension__ typedef __float128 Quad;

inline constexpr int kMaxOrder = 40;

template <typename Real>
using Series = std::array<Real, kMaxOrder + 1>;
template <typename Real>
using Series3 = std::array<Series<Real>, 3>;

inline Quad square_root(Quad x) {
  return sqrtq(x);
}
inline long double square_root(long double x) {
  return std::sqrt(x);
}

// Coefficient k of a·b.
template <typename Real>
Real product(const Series<Real>& a, const Series<Real>& b, int k) {
  Real sum = 0;
  for (int j = 0; j <= k; ++j)
    sum += a[static_cast<std::size_t>(j)] * b[static_cast<std::size_t>(k - j)];
  return sum;
}

// Change over the time h of the polynomial of the given order.
template <typename Real>
Real change(const Series<Real>& a, int order, Real h) {
  Real sum = a[static_cast<std::size_t>(order)];
  for (int k = order - 1; k >= 1; --k) sum = sum * h + a[static_cast<std::size_t>(k)];
  return sum * h;
}

// |x| of a vector of series, for t ≥ 0. A vector that starts from zero is t^shift times one that
// does not, and so is its length.
template <typename Real>
class Length {
 public:
  void extend(const Series3<Real>& x, int k) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    if (shift_ < 0) {
      if (x[0][at(k)] == 0 && x[1][at(k)] == 0 && x[2][at(k)] == 0) return;
      shift_ = k;
    }
    const int n = k - shift_;
    Real square = 0;  // coefficient n of |x|² / t^(2 shift)
    for (const Series<Real>& component : x)
      for (int j = 0; j <= n; ++j)
        square += component[at(shift_ + j)] * component[at(shift_ + n - j)];
    if (n == 0) {
      series_[at(k)] = square_root(square);
      return;
    }
    for (int j = 1; j < n; ++j) square -= series_[at(shift_ + j)] * series_[at(shift_ + n - j)];
    series_[at(k)] = square / (2 * series_[at(shift_)]);
  }

  const Series<Real>& series() const { return series_; }

 private:
  Series<Real> series_{};
  int shift_ = -1;  // index of the first coefficient of x that is not zero; none so far: −1
};

}  // namespace poinsot::test
