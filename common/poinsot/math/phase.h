// A phase that grows evenly for a long time, without loss: turns(t) = start + rate·t, reduced to
// −½ … ½ turn.
//
// rate and start carry a second double, and the product is formed exactly (Dekker), so that the
// fraction of a turn is right to about 1e-16 + 1e-19 |rate·t| however many turns have passed.
// Source: Dekker, A floating-point technique for extending the available precision, 1971.

#pragma once

#include <cmath>

namespace poinsot {

struct Reduced {
  double fraction;  // [turn] −½ … ½
  double turns;     // whole turns that were taken off
};

class Phase {
 public:
  Phase() = default;
  // rate [turn/s], start [turn].
  Phase(long double rate, long double start)
      : rate_(static_cast<double>(rate)),
        rate_low_(static_cast<double>(rate - static_cast<long double>(rate_))),
        start_(static_cast<double>(start)),
        start_low_(static_cast<double>(start - static_cast<long double>(start_))) {}

  Reduced at(double t) const {
    const double product = rate_ * t;
    const double low = product_error(rate_, t, product) + (rate_low_ * t + start_low_);
    const double sum = product + start_;
    const double back = sum - product;
    const double sum_error = (product - (sum - back)) + (start_ - back);
    const double turns = std::nearbyint(sum);
    return {(sum - turns) + (sum_error + low), turns};
  }

  double rate() const { return rate_; }  // [turn/s]

  template <class Archive>
  void archive(Archive& with) {
    with(rate_, rate_low_, start_, start_low_);
  }

 private:
  // a·b − fl(a·b), exactly, by splitting both factors in halves.
  static double product_error(double a, double b, double product) {
    constexpr double kSplit = 134217729;  // 2²⁷ + 1
    const double a_wide = kSplit * a, b_wide = kSplit * b;
    const double a_high = a_wide - (a_wide - a), b_high = b_wide - (b_wide - b);
    const double a_low = a - a_high, b_low = b - b_high;
    return a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
  }

  double rate_ = 0, rate_low_ = 0, start_ = 0, start_low_ = 0;
};

}  // namespace poinsot
