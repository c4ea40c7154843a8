// Where a pair touches: its points found, or moved along with its bodies, and what they remember.
//
// While a pair of polyhedra turned and shifted by less than 1e-5 of its size since its points were
// last found, they are moved along: their gaps are then wrong by no more than 1e-10 of the size.

#pragma once

#include "poinsot/collision/collision_state.h"

namespace poinsot {

// Brings the points of the record's contact to where its bodies are now: those nearer than
// `margin` [m], and some beyond. A point that continues an old one keeps its impulses, scaled to a
// sub-step of h [s], and its approach.
void measure_pair(CollisionState& state, PairRecord& record, double margin, double h);

}  // namespace poinsot
