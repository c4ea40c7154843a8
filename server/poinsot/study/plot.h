// The study as a picture: error over CPU time on log axes, a curve per integrator, the Pareto front
// ringed and joined, the certificate as a line below which nothing is known.

#pragma once

#include <string>

#include "poinsot/study/study.h"

namespace poinsot {

// A gnuplot script that writes SVG to its standard output. Needs a row.
std::string plot_script(const StudyResult& result);

}  // namespace poinsot
