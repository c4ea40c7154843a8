// Checks of our own assumptions: a failure is our bug, is printed, and ends the process.
//
//   POINSOT_CHECK(condition)   always compiled in
//   POINSOT_ASSERT(condition)  in debug builds only
//
// Bad input is not our bug: it throws poinsot::Error while loading and is data while running.

#pragma once

#include <cstdio>
#include <cstdlib>

namespace poinsot {

[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: check failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace poinsot

#define POINSOT_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::poinsot::check_failed(#condition, __FILE__, __LINE__))

#ifdef NDEBUG
#define POINSOT_ASSERT(condition) static_cast<void>(0)
#else
#define POINSOT_ASSERT(condition) POINSOT_CHECK(condition)
#endif
