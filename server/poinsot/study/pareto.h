// What is worth having: rows that no other row beats, and the cheapest that is good enough.
//
// Errors are compared by the larger of metres and radians, no smaller than the certificate; costs
// by the CPU time of simulation, the one that the settings choose: all share the contacts.

#pragma once

#include "poinsot/study/study.h"

namespace poinsot {

// Sets Row::pareto: no other row is at least as good in both error and cost and better in one.
void mark_pareto(StudyResult& result);

// The row with the lowest cost of those whose errors are at most `wanted`, in m and in rad. Null if
// there is none.
const Row* cheapest(const StudyResult& result, double wanted);

}  // namespace poinsot
