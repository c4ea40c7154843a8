// Gnuplot as a child process: a script in, what it draws out. The one place that starts it.

#pragma once

#include <cstdio>
#include <string>

namespace poinsot {

// Throws Error that names the package if there is no gnuplot.
void require_gnuplot();

// Runs the script; its output (set terminal, no set output) goes to the open file. Gnuplot's own
// complaints go to stderr. Throws Error without gnuplot, std::runtime_error if it fails.
void run_gnuplot(const std::string& script, std::FILE* output);

}  // namespace poinsot
