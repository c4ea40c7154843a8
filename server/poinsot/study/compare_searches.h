// The impact searches on the user's own scene: what each costs, and how far it leads from the
// one-sided one, which misses nothing.

#pragma once

#include <cstdint>
#include <vector>

#include "poinsot/study/measure.h"

namespace poinsot {

// Runs the scene for so many frames with each of kImpactSearchNames in the place of its own, all
// else as it is; every `stride` frames are compared. Empty if nothing meets; shorter if the limit
// comes.
std::vector<SearchRow> compare_searches(const Scene& scene, std::uint64_t frames,
                                        std::uint64_t stride, const RunLimit& limit);

}  // namespace poinsot
