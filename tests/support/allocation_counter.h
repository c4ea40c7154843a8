// Counts heap allocations of the calling thread. Link allocation_counter.cpp: it puts a counting
// malloc in front of the C library's, so that operator new and Eigen's own allocations both count.
// Sanitizers bring their own malloc: there nothing is counted.

#pragma once

#include <cstddef>

namespace poinsot::test {

bool can_count_allocations();

// Allocations of this thread since it started.
std::size_t allocations();

}  // namespace poinsot::test
