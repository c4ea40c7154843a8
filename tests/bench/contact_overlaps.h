// How deep the bodies of a contact scene overlap one another, the walls and the ground, by the
// gaps of Poinsot's own narrow phase.

#pragma once

#include <vector>

#include "contact_cases.h"

namespace poinsot::bench {

struct Overlaps {
  double largest = 0;  // [m]
  double mean = 0;     // [m] over the pairs that touch or overlap
};

// Poses of the bodies that move; one that is not finite, or far away, overlaps nothing.
Overlaps find_overlaps(const ContactScene& scene, const std::vector<Pose>& poses);

}  // namespace poinsot::bench
