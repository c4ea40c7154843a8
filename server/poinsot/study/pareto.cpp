#include "poinsot/study/pareto.h"

#include <algorithm>

namespace poinsot {

void mark_pareto(StudyResult& result) {
  const auto error = [&](const Row& row) { return known_error(row, result.reference).larger(); };
  const auto beats = [&](const Row& a, const Row& b) {
    const double cost_a = a.cost.simulation, cost_b = b.cost.simulation;
    return error(a) <= error(b) && cost_a <= cost_b && (error(a) < error(b) || cost_a < cost_b);
  };
  // A setting that froze a body has moved something else: it beats nobody and is no choice.
  for (Row& row : result.rows)
    row.pareto = row.quarantined == 0 &&
                 std::none_of(result.rows.begin(), result.rows.end(), [&](const Row& other) {
                   return other.quarantined == 0 && beats(other, row);
                 });
}

const Row* cheapest(const StudyResult& result, double wanted) {
  const Row* best = nullptr;
  for (const Row& row : result.rows) {
    if (row.quarantined > 0 || known_error(row, result.reference).larger() > wanted) continue;
    if (best == nullptr || row.cost.simulation < best->cost.simulation) best = &row;
  }
  return best;
}

}  // namespace poinsot
