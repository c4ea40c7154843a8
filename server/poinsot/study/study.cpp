#include "poinsot/study/study.h"

#include <algorithm>

namespace poinsot {

PoseError largest(const PoseError& a, const PoseError& b) {
  return {std::max(a.position, b.position), std::max(a.orientation, b.orientation)};
}

PoseError known_error(const Row& row, const ReferenceInfo& reference) {
  return largest(row.measured, reference.certificate);
}

}  // namespace poinsot
