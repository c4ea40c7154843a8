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

using Series = std::array<Quad, kMaxOrder + 1>;
using Series3 = std::array<Series, 3>;

// Coefficient k of a·b.
inline Quad product(const Series& a, const Series& b, int k) {
  Quad sum = 0;
  for (int j = 0; j <= k; ++j)
    sum += a[static_cast<std::size_t>(j)] * b[static_cast<std::size_t>(k - j)];
  return sum;
}

// Value after the time h of the polynomial of the given order.
inline Quad value(const Series& a, int order, Quad h) {
  Quad sum = a[static_cast<std::size_t>(order)];
  for (int k = order - 1; k >= 0; --k) sum = sum * h + a[static_cast<std::size_t>(k)];
  return sum;
}

// |x| of a vector of series, for t ≥ 0. A vector that starts from zero is t^shift times one that
// does not, and so is its length.
class Length {
 public:
  void extend(const Series3& x, int k) {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    if (shift_ < 0) {
      if (x[0][at(k)] == 0 && x[1][at(k)] == 0 && x[2][at(k)] == 0) return;
      shift_ = k;
    }
    const int n = k - shift_;
    Quad square = 0;  // coefficient n of |x|² / t^(2 shift)
    for (const Series& component : x)
      for (int j = 0; j <= n; ++j)
        square += component[at(shift_ + j)] * component[at(shift_ + n - j)];
    if (n == 0) {
      series_[at(k)] = sqrtq(square);
      return;
    }
    for (int j = 1; j < n; ++j) square -= series_[at(shift_ + j)] * series_[at(shift_ + n - j)];
    series_[at(k)] = square / (2 * series_[at(shift_)]);
  }

  const Series& series() const { return series_; }

 private:
  Series series_{};
  int shift_ = -1;  // index of the first coefficient of x that is not zero; none so far: −1
};

}  // namespace poinsot::test
