// The study as text for people: at most 100 columns.

#pragma once

#include <string>

#include "poinsot/study/study.h"

namespace poinsot {

// What was studied, the reference and how far it goes, the table, what is left out and why.
std::string to_text(const StudyResult& result);

// What the reference is and where it ends; why there is none if the horizon is 0.
std::string reference_text(const StudyResult& result);

// Names the cheapest setting for an error of `wanted` in m and in rad, or says that there is none.
std::string cheapest_text(const StudyResult& result, double wanted);

}  // namespace poinsot
