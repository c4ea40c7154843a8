#include "poinsot/contact/block_ldlt.h"

#include <algorithm>

namespace poinsot {
namespace {

constexpr int kSide = 6;
constexpr std::size_t kArea = 36;
// [-] of its diagonal: a pivot below is rounding.
constexpr double kLeastPivot = 1e-15;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// target −= left · right, 6 × 6 by columns. Two rows at once: the order of sums is fixed.
using Two = double __attribute__((vector_size(16), aligned(8), may_alias));

void subtract_product(double* target, const double* left, const double* right) {
  for (int c = 0; c < kSide; ++c) {
    Two* t = reinterpret_cast<Two*>(target + kSide * c);
    Two t0 = t[0], t1 = t[1], t2 = t[2];
    for (int k = 0; k < kSide; ++k) {
      const Two* l = reinterpret_cast<const Two*>(left + kSide * k);
      const double factor = right[kSide * c + k];
      t0 -= l[0] * factor;
      t1 -= l[1] * factor;
      t2 -= l[2] * factor;
    }
    t[0] = t0;
    t[1] = t1;
    t[2] = t2;
  }
}

}  // namespace

void BlockLdlt::analyse(int bodies, std::span<const std::array<int, 2>> pairs) {
  if (bodies == bodies_ && std::ranges::equal(pairs, pairs_)) return;
  bodies_ = bodies;
  pairs_.assign(pairs.begin(), pairs.end());
  order_.compute(bodies, pairs);
  place_pairs();
  list_rows();
  diagonal_.resize(kArea * at(bodies));
  pivots_.resize(at(kSide * bodies));
  inverse_.resize(at(kSide * bodies));
  below_.resize(kArea * order_.rows.size());
  slot_.resize(at(bodies));
}

void BlockLdlt::place_pairs() {
  places_.resize(pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int a = order_.position[at(pairs_[p][0])], b = order_.position[at(pairs_[p][1])];
    const int column = std::min(a, b), row = std::max(a, b);
    const auto from = order_.rows.begin() + order_.column_start[at(column)];
    const auto to = order_.rows.begin() + order_.column_start[at(column) + 1];
    const auto found = std::lower_bound(from, to, row);
    places_[p] = {static_cast<int>(found - order_.rows.begin()), a < b};
  }
}

void BlockLdlt::list_rows() {
  const std::size_t n = at(bodies_);
  row_start_.assign(n + 1, 0);
  for (const int row : order_.rows) ++row_start_[at(row) + 1];
  for (std::size_t i = 0; i < n; ++i) row_start_[i + 1] += row_start_[i];
  row_entries_.resize(order_.rows.size());
  row_columns_.resize(order_.rows.size());
  slot_.assign(row_start_.begin(), row_start_.end());
  for (int column = 0; column < bodies_; ++column)
    for (int q = order_.column_start[at(column)]; q < order_.column_start[at(column) + 1]; ++q) {
      const std::size_t place = at(slot_[at(order_.rows[at(q)])]++);
      row_entries_[place] = q;
      row_columns_[place] = column;
    }
}

void BlockLdlt::clear() {
  std::ranges::fill(diagonal_, 0.0);
  std::ranges::fill(below_, 0.0);
}

BlockLdlt::Map BlockLdlt::diagonal(int body) {
  return Map(diagonal_.data() + kArea * at(order_.position[at(body)]));
}

void BlockLdlt::add_coupling(int pair, const Block& block) {
  const Place& place = places_[at(pair)];
  Map target(below_.data() + kArea * at(place.block));
  if (place.transposed)
    target += block.transpose();
  else
    target += block;
}

// Takes from a column what the columns before it have to do with it.
void BlockLdlt::gather(int column) {
  for (int q = order_.column_start[at(column)]; q < order_.column_start[at(column) + 1]; ++q)
    slot_[at(order_.rows[at(q)])] = q;
  double* diagonal = diagonal_.data() + kArea * at(column);
  for (int e = row_start_[at(column)]; e < row_start_[at(column) + 1]; ++e) {
    const int entry = row_entries_[at(e)], other = row_columns_[at(e)];
    const double* block = below_.data() + kArea * at(entry);
    const double* pivots = pivots_.data() + kSide * other;
    double scaled[kArea];  // D Lᵀ of that entry, by columns
    for (int k = 0; k < kSide; ++k)
      for (int c = 0; c < kSide; ++c) scaled[kSide * c + k] = block[kSide * k + c] * pivots[k];
    subtract_product(diagonal, block, scaled);
    for (int q = entry + 1; q < order_.column_start[at(other) + 1]; ++q)
      subtract_product(below_.data() + kArea * at(slot_[at(order_.rows[at(q)])]),
                       below_.data() + kArea * at(q), scaled);
  }
}

// In place: the unit lower triangle; the pivots apart. `original` is the diagonal of the matrix.
void BlockLdlt::factorise_diagonal(int column) {
  double* m = diagonal_.data() + kArea * at(column);
  double* pivots = pivots_.data() + kSide * column;
  double* inverse = inverse_.data() + kSide * column;
  for (int k = 0; k < kSide; ++k) {
    const double original = pivots[k];
    double pivot = m[kSide * k + k];
    if (!(pivot > kLeastPivot * original)) {
      pivot = original > 0 ? original : 1;
      ++replaced_pivots_;
    }
    pivots[k] = pivot;
    inverse[k] = 1 / pivot;
    for (int c = k + 1; c < kSide; ++c) {
      const double factor = m[kSide * k + c] * inverse[k];
      for (int r = c; r < kSide; ++r) m[kSide * c + r] -= m[kSide * k + r] * factor;
    }
    for (int r = k + 1; r < kSide; ++r) m[kSide * k + r] *= inverse[k];
  }
}

// The blocks below the diagonal: A → A L⁻ᵀ D⁻¹.
void BlockLdlt::divide(int column) {
  const double* lower = diagonal_.data() + kArea * at(column);
  const double* inverse = inverse_.data() + kSide * column;
  for (int q = order_.column_start[at(column)]; q < order_.column_start[at(column) + 1]; ++q) {
    double* block = below_.data() + kArea * at(q);
    for (int k = 0; k < kSide; ++k)
      for (int c = k + 1; c < kSide; ++c) {
        const double factor = lower[kSide * k + c];
        for (int r = 0; r < kSide; ++r) block[kSide * c + r] -= block[kSide * k + r] * factor;
      }
    for (int k = 0; k < kSide; ++k)
      for (int r = 0; r < kSide; ++r) block[kSide * k + r] *= inverse[k];
  }
}

void BlockLdlt::factorise() {
  replaced_pivots_ = 0;
  for (int column = 0; column < bodies_; ++column)
    for (int k = 0; k < kSide; ++k)
      pivots_[at(kSide * column + k)] = diagonal_[kArea * at(column) + at(kSide * k + k)];
  for (int column = 0; column < bodies_; ++column) {
    gather(column);
    factorise_diagonal(column);
    divide(column);
  }
}

void BlockLdlt::solve(std::span<double> x) const {
  const auto part = [&](int position) { return x.data() + kSide * order_.order[at(position)]; };
  for (int column = 0; column < bodies_; ++column) {
    double* mine = part(column);
    const double* lower = diagonal_.data() + kArea * at(column);
    for (int k = 0; k < kSide; ++k)
      for (int r = k + 1; r < kSide; ++r) mine[r] -= lower[kSide * k + r] * mine[k];
    for (int q = order_.column_start[at(column)]; q < order_.column_start[at(column) + 1]; ++q) {
      double* other = part(order_.rows[at(q)]);
      const double* block = below_.data() + kArea * at(q);
      for (int k = 0; k < kSide; ++k)
        for (int r = 0; r < kSide; ++r) other[r] -= block[kSide * k + r] * mine[k];
    }
  }
  for (int column = bodies_ - 1; column >= 0; --column) {
    double* mine = part(column);
    const double* lower = diagonal_.data() + kArea * at(column);
    const double* inverse = inverse_.data() + kSide * column;
    for (int k = 0; k < kSide; ++k) mine[k] *= inverse[k];
    for (int q = order_.column_start[at(column)]; q < order_.column_start[at(column) + 1]; ++q) {
      const double* other = part(order_.rows[at(q)]);
      const double* block = below_.data() + kArea * at(q);
      for (int k = 0; k < kSide; ++k) {
        double sum = 0;
        for (int r = 0; r < kSide; ++r) sum += block[kSide * k + r] * other[r];
        mine[k] -= sum;
      }
    }
    for (int k = kSide - 1; k >= 0; --k)
      for (int r = k + 1; r < kSide; ++r) mine[k] -= lower[kSide * k + r] * mine[r];
  }
}

}  // namespace poinsot
