// Counts heap allocations of the calling thread: operator new, and Eigen's own through malloc where
// EIGEN_RUNTIME_NO_MALLOC would not see them. Link allocation_counter.cpp, which replaces operator
// new for the whole executable.

#pragma once

#include <cstddef>

namespace poinsot::test {

// Allocations of this thread since it started.
std::size_t allocations();

}  // namespace poinsot::test
